"""Detectors that answer through the Python module `assay`: the built-in detector, and plug-ins.

`vectors.py run --arithmetic WORD` and `--detector NAME` use them (README.md).
"""
from vectors import Wrong, want

try:
    import assay
except ImportError as problem:
    assay, why_absent = None, problem


def demand_module():
    want(assay, "PYTHONPATH", "the module assay is missing, or built for another Python "
         f"(reports/python/README.md): {why_absent if not assay else ''}")


class BuiltIn:
    """The built-in detector with all pairs, in one arithmetic.

    Only `exact` and `bounded`, which prove answers, answer limits; only `exact` answers distances.
    """

    def __init__(self, arithmetic):
        self.arithmetic = arithmetic
        self.product = {"name": "Assay", "version": assay.__version__,
                        "settings": f"arithmetic {arithmetic}"}

    def end(self):
        pass

    def answers(self, case):
        serves = {"contact": True, "limit": self.arithmetic in ("exact", "bounded"),
                  "distance": self.arithmetic == "exact"}
        if not serves[case.question]:
            return [{"answer": "unsupported"}] * len(case.steps)
        if case.triangles is None:
            return [self.query(case, case.steps[0])]
        try:
            frame = case.json["frames"][0]
            detector = assay.Detector(case.triangles, frame, arithmetic=self.arithmetic)
        except assay.InputError:
            return [{"answer": "error"}] * len(case.steps)
        return [self.step(detector, case, i) for i in range(len(case.steps))]

    def query(self, case, step):
        ask = assay.vertex_face if case.features == "vertex-face" else assay.edge_edge
        found = ask([step.t0], [step.t1], arithmetic=self.arithmetic,
                    separation=case.distance or 0)
        if not found.hit[0]:
            return {"answer": "free"}
        return {"answer": "collision", "time": [float(found.lo[0]), float(found.hi[0])]}

    @staticmethod
    def step(detector, case, i):
        step = case.steps[i]
        try:
            if case.question == "limit":
                return {"answer": "share", "share": detector.limit(step.t0, step.t1).share}
            commits = case.json["steps"][i].get("commit", True)
            result = (detector.step if commits else detector.evaluate)(step.t0, step.t1)
        except assay.InputError:
            return {"answer": "error"}
        if result.answer != "collision":
            return {"answer": result.answer}
        return {"answer": "collision", "time": list(result.first), "pairs": result.pairs.tolist()}


class PlugIn:
    """A plug-in: a library, or a class in Python with the name "python:MODULE:CLASS"."""

    def __init__(self, detector, seconds):
        try:
            self.detector = assay.Plugin(detector, seconds=seconds)
        except (ValueError, assay.AssayError) as problem:
            raise Wrong(str(problem)) from None
        self.product = {"name": self.detector.name, "version": self.detector.version,
                        "settings": ""}

    def end(self):
        pass

    def answers(self, case):
        try:
            given = self.detector.answers(case_file_of(case), separation=case.distance or 0,
                                          limits=case.question == "limit")
        except (ValueError, RuntimeError) as problem:
            raise Wrong(f"case {case.id}: {problem}") from None
        return given or [{"answer": "unsupported"}] * len(case.steps)


def case_file_of(case):
    """Returns a case of a set in the form of a case file (corpus/README.md)."""
    file = {"schema": "assay-case/1", "id": case.id, "about": case.about,
            "source": case.json["source"], "options": {}, "expected": {"steps": []}, "pending": {}}
    if case.triangles is None:
        file["options"]["query"] = case.features
        file["triangles"] = [[0, 1, 2], [1, 3, 2]]
        file["frames"] = [case.steps[0].t0, case.steps[0].t1]
        return file
    steps = [[s["from"], s["to"], "commit" if s.get("commit", True) else "evaluate"]
             for s in case.json["steps"]]
    return {**file, "triangles": case.triangles, "frames": case.json["frames"], "script": steps}
