"""Wrappers of assay.Detector, wrong in eleven ways. tests/plugins/wrong_wrapper.cpp has them in C++."""

from dataclasses import replace

import numpy as np

import assay


def later(times):
    return np.minimum(1, np.nextafter(times, 2))


class Wrapper:
    claims = [
        "free-sound", "not-late", "first-time", "first-pairs", "all-pairs", "no-spurious",
        "deterministic", "total",
    ]  # fmt: skip

    def create(self, triangles, positions):
        try:
            self.detector = assay.Detector(triangles, positions)
        except assay.InputError as error:
            raise assay.Refused(str(error))
        self.triangles = triangles

    def evaluate(self, x_t0, x_t1):
        result = self.detector.evaluate(x_t0, x_t1)
        return self.spoiled(result) if result.answer == "collision" else None

    def commit(self):
        self.detector.commit()

    def spoiled(self, result):
        return result


class DropAPair(Wrapper):
    def spoiled(self, result):
        return replace(result, pairs=result.pairs[1:], times=None)


class LateByAnUlp(Wrapper):
    def spoiled(self, result):
        return replace(result, first=later(result.first))


class LatePairs(Wrapper):
    def spoiled(self, result):
        return replace(result, times=later(result.times))


class ForgetCommit(Wrapper):
    def create(self, triangles, positions):
        super().create(triangles, positions)
        self.start = positions

    def evaluate(self, x_t0, x_t1):
        return super().evaluate(self.start, x_t1)


class FreeWhenFew(Wrapper):
    def spoiled(self, result):
        return result if len(result.pairs) >= 3 else None


class DropNeighbours(Wrapper):
    def spoiled(self, result):
        a, b = self.triangles[result.pairs.T]
        apart = (a[:, :, None] != b[:, None, :]).all(axis=(1, 2))
        return replace(result, pairs=result.pairs[apart], times=result.times[apart])


class RoundToFloat(Wrapper):
    def evaluate(self, x_t0, x_t1):
        return super().evaluate(x_t0.astype(np.float32), x_t1.astype(np.float32))


class FreeAtStart(Wrapper):
    def spoiled(self, result):
        return result if result.first[0] > 0 else None


class AddAPair(Wrapper):
    def spoiled(self, result):
        if len(self.triangles) < 2 or [0, 1] in result.pairs.tolist():
            return result
        pairs = np.vstack([result.pairs, [[0, 1]]])
        return replace(result, pairs=pairs, times=np.vstack([result.times, result.first]))


class HalfAStep(Wrapper):
    def evaluate(self, x_t0, x_t1):
        return super().evaluate(x_t0, (x_t0 + x_t1) / 2)


class OrderOfASet(Wrapper):
    """Depends on the order of a set of strings, which differs from process to process."""

    def spoiled(self, result):
        names = list({f"name {i}" for i in range(40)})
        lo, hi = result.first
        return replace(result, first=(lo * (1 + names.index("name 0")) / 40, hi))
