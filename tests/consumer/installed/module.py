"""Tries the Python module that is installed below the named folder: the detector, the judge, and the
judging of a class; also a campaign, if few.json and its proof exist."""

import sys
from pathlib import Path

import assay
from assay.places import program

triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
frames = triangles, [[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, z]] for z in (1.0, -1.0)]


class Mine:
    claims = ["free-sound", "total"]

    def create(self, triangles, positions):
        self.detector = assay.Detector(triangles, positions)

    def evaluate(self, x_t0, x_t1):
        return self.detector.evaluate(x_t0, x_t1)


if __name__ == "__main__":
    folder = Path(sys.argv[1]).resolve()
    for place in (assay.__file__, program()):
        assert folder in Path(place).resolve().parents, f"{place} is not below {folder}"
    assert assay.judge(triangles, *frames[1]).answer == "collision"
    assert assay.check(frames, Mine).outcome == "holds"
    if Path("few.json").exists():
        ran = assay.run("few.json", Mine, out="python", power="proof")
        assert ran.outcome == "holds" and ran.strata and not ran.failures, ran.text
    print(assay.__version__, program())
