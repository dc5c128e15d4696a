"""Tests corpus/vectors with the module: subjects that answer the set, and groups made from case files."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import assay

ROOM = Path(__file__).resolve().parents[3] / "corpus" / "vectors"
MINI = ROOM.parents[1] / "tests" / "corpus" / "vectors" / "mini_set"
sys.path.insert(0, str(ROOM))
import hosted  # noqa: E402
import make_group  # noqa: E402
import vectors  # noqa: E402

STORED = sorted((ROOM / "results").glob("*.json"))
PACKAGED = ("bullet_", "cubic_", "fcl_", "sampled_")  # peers that are built without sources of others


@pytest.fixture(scope="module")
def committed():
    return vectors.VectorSet()


def run(script, *words, **options):
    done = subprocess.run(
        [sys.executable, ROOM / script, *map(str, words)], text=True, capture_output=True, **options
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("file", STORED, ids=[file.stem for file in STORED])
def test_the_stored_results_come_out_again(committed, file):
    stored = vectors.read_results(file, committed)
    if file.stem.startswith("assay_"):
        asked = hosted.BuiltIn(file.stem[len("assay_"):])
    else:
        library = Path(os.environ["ASSAY_BUILD_DIR"]) / "peers" / f"{file.stem}.so"
        required = os.environ.get("CI") == "true" and file.stem.startswith(PACKAGED)
        if not library.exists() and not required:
            pytest.skip(f"{library} was not built: what it needs is not installed")
        asked = hosted.PlugIn(str(library), 10)
    results = vectors.ask_all(asked, committed)
    assert results["answers"] == stored["answers"]
    if not file.stem.startswith("assay_"):
        assert results["product"] == stored["product"]


MINE = """
    import os
    import assay

    class Steps:
        name, version = "steps", "2"
        claims = ["free-sound", "all-pairs", "total"]
        def create(self, triangles, positions):
            self.detector = assay.Detector(triangles, positions)
        def evaluate(self, x_t0, x_t1):
            return self.detector.evaluate(x_t0, x_t1)

    class Silent(Steps):
        claims = ["free-sound"]
        contract = {"reports": "no-pairs"}
        def evaluate(self, x_t0, x_t1):
            return {"answer": "collision"} if x_t1.min() < 0 else None

    class Dies(Steps):
        def evaluate(self, x_t0, x_t1):
            os._exit(7)

    class Raises(Steps):
        def evaluate(self, x_t0, x_t1):
            return 1 / 0

    class Limits:
        claims = ["commit-free"]
        def create(self, triangles, positions):
            self.detector = assay.Detector(triangles, positions)
        def limit(self, x_t0, x_t1):
            return self.detector.limit(x_t0, x_t1)

    class Within:
        claims = ["free-sound", "total"]
        contract = {"separation": 1.0, "adjacency": "no-shared-vertex"}
        @staticmethod
        def query(kind, x_t0, x_t1):
            ask = assay.vertex_face if kind == "vertex-face" else assay.edge_edge
            found = ask([x_t0], [x_t1], separation=1.0)
            return {"first": (found.lo[0], found.hi[0])} if found.hit[0] else None
"""


@pytest.fixture
def answers(tmp_path, monkeypatch):
    """Returns a function that returns the answers of a class of MINE to the mini set."""
    (tmp_path / "mine.py").write_text(textwrap.dedent(MINE))
    out = tmp_path / "out.json"

    def of(name):
        path = os.pathsep.join([str(tmp_path), os.environ["PYTHONPATH"]])
        code, text, errors = run(
            "vectors.py", "run", "--set", MINI, "--out", out, "--detector", f"python:mine:{name}",
            env={**os.environ, "PYTHONPATH": path},
        )
        assert errors == ""
        results = json.loads(out.read_text())
        assert results["product"]["name"] == ("steps" if name not in ("Limits", "Within") else name)
        told = results["answers"]
        words = {i: [one.pop("answer") for one in a.get("steps", [a])] for i, a in told.items()}
        return code, words, told

    return of


def test_steps_are_asked_in_their_order(answers):
    code, words, told = answers("Steps")
    assert code == 0
    assert words["st-d-0001"] == ["free", "collision", "free"]
    assert told["st-d-0001"]["steps"][1] == {"time": [0.5, 0.5], "pairs": [[0, 1]]}
    assert {i for i, w in words.items() if "unsupported" not in w} == {"st-d-0001"}


def test_what_is_not_told_is_not_stated(answers):
    code, words, told = answers("Silent")
    assert words["st-d-0001"][1] == "collision" and told["st-d-0001"]["steps"][1] == {}


def test_what_goes_wrong_has_its_word(answers):
    assert answers("Dies")[1]["st-d-0001"] == ["crash"] * 3
    assert answers("Raises")[1]["st-d-0001"] == ["error"] * 3


def test_limits_are_shares(answers):
    code, words, told = answers("Limits")
    assert code == 0 and words["lm-d-0001"] == ["share"]
    assert 0 < told["lm-d-0001"]["steps"][0]["share"] < 0.5
    assert {i for i, w in words.items() if w != ["unsupported"] * len(w)} == {"lm-d-0001"}


def test_a_distance_is_asked_of_who_states_it(answers):
    code, words, _ = answers("Within")
    assert code == 0
    asked = {i: w for i, w in words.items() if w != ["unsupported"] * len(w)}
    assert asked == {"vd-f-0002": ["collision"]}


def test_what_cannot_answer_is_refused_in_a_line(tmp_path):
    for words, line in (
        (["--detector", tmp_path / "none.so"], "none.so"),
        (["--arithmetic", "half"], "one of"),
        (["--arithmetic", "exact", "--detector", "x"], "who answers?"),
        ([], "who answers?"),
    ):
        code, text, errors = run("vectors.py", "run", "--set", MINI, *words, cwd=tmp_path)
        assert (code, text, errors.count("\n")) == (2, "", 1), errors
        assert line in errors
    without = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    code, _, errors = run(
        "vectors.py", "run", "--set", MINI, "--arithmetic", "exact", cwd=tmp_path, env=without
    )
    assert code in (0, 2), errors
    if code == 2:  # the module is not installed
        assert errors.count("\n") == 1 and "module assay" in errors


def test_a_query_with_wrong_options_is_refused():
    case = next(c for c in vectors.VectorSet(MINI).cases if c.id == "vf-d-0001")
    with pytest.raises(ValueError):
        assay.vertex_face([case.steps[0].t0], [case.steps[0].t1], arithmetic="half")
    with pytest.raises(ValueError):
        assay.vertex_face([case.steps[0].t0], [case.steps[0].t1], arithmetic="float", separation=1)
    with pytest.raises(ValueError):
        assay.judge([[0, 1, 2]], case.steps[0].t0[:3], separation=(1.0, -2.0))


KEPT = ("result", "first_time", "distance", "least_distance", "t0", "t1", "triangles", "frames")
# Flags that the script leaves to the author. Flags of meshes depend on the first contact; none is compared.
FLAGS = {"Tangential", "SplitInvariant", "DoubleRoot", "ParallelEdges", "TouchAtEnd", "NoArea"}


def test_a_group_made_of_case_files_has_the_facts_of_the_set(committed, tmp_path):
    """Makes a part of each group again, and checks the set of all these groups."""
    taken = 0
    for group in committed.groups:
        cases = [case for case in committed.cases if case.group == group["group"]][::20]
        files = []
        for case in cases:
            files.append(tmp_path / f"{case.id}.json")
            files[-1].write_text(json.dumps(hosted.case_file_of(case)))
        words = ["--float"] if group["precision"] == "float32" else []
        words += ["--limit"] if group["question"] == "limit" else []
        if group["question"] == "distance":  # a group has one distance
            files, cases = files[:1], cases[:1]
            words += ["--distance", repr(cases[0].distance)]
        words += ["--name", group["group"], "--out", str(tmp_path / "set")]
        make_group.main([*map(str, files), *words])
        taken += len(cases)
    made = {case.id: case.json for case in vectors.check(tmp_path / "set").cases}
    assert len(made) == taken > 50
    for case in committed.cases:
        if case.id not in made:
            continue
        own, stored = made[case.id], case.json
        assert {k: own.get(k) for k in KEPT if k in stored or k != "least_distance"} == {
            k: stored.get(k) for k in KEPT if k in stored or k != "least_distance"
        }, case.id
        for a, b in zip(own.get("steps", []), stored.get("steps", [])):
            assert {**a, "polynomial": 0} == {**b, "polynomial": 0}
        if case.triangles is None:
            assert set(own["flags"]) == set(stored["flags"]) - FLAGS, case.id


def test_polynomials_and_flags_of_all_queries_are_found_again(committed):
    precision = {group["group"]: group["precision"] for group in committed.groups}
    contacts = 0
    for case in committed.cases:
        if case.triangles is not None:
            continue
        query = query_of(case)
        stated, distance = case.json, case.distance or 0
        flags = make_group.query_flags(query, stated, precision[case.group] == "float32")
        assert flags == set(stated["flags"]) - FLAGS, case.id
        if "polynomial" not in stated:
            continue
        contacts += 1
        events = query.within(distance) if distance else query.events()
        known = [[0, 1], *(vectors.primitive(event) for event in events)]
        assert [int(c) for c in stated["polynomial"]] in known, case.id
    assert contacts > 250


def query_of(case):
    step = case.steps[0]
    return make_group.Features(1 if case.features == "vertex-face" else 2, step.t0, step.t1)


def test_a_case_that_fits_no_group_is_refused_in_a_line(committed, tmp_path):
    files = []
    for name in ("vertex-face-double", "steps-double"):
        case = next(case for case in committed.cases if case.group == name)
        files.append(tmp_path / f"{name}.json")
        files[-1].write_text(json.dumps(hosted.case_file_of(case)))
    for words, line in (
        (files, "its kind is not vertex-face"),
        ([ROOM / "set.json"], "assay-case/1"),
        ([tmp_path / "none.json"], "No such file"),
        ([files[0], "--flags", "Odd"], "no flag Odd"),
        ([files[0], "--limit"], 'question "limit" is only for meshes'),
        ([files[0], files[0]], "occurs twice"),
    ):
        with pytest.raises(vectors.Wrong, match=line):
            make_group.main([*map(str, words), "--name", "g", "--out", str(tmp_path / "set")])
    assert not (tmp_path / "set").exists() or not list((tmp_path / "set").iterdir())
    odd = json.loads(files[0].read_text())
    for name, change, line in (
        ("frames", {"frames": odd["frames"] * 2}, "two frames"),
        ("query", {"options": {"query": "foo"}}, "its option query is unknown: foo"),
        ("index", {"triangles": [[0, 1, 9]]}, "triangles"),
        ("list", None, ""),
    ):
        file = tmp_path / f"{name}.json"
        file.write_text(json.dumps({**odd, **change} if change else [odd]))
        with pytest.raises(vectors.Wrong, match=line):
            make_group.main([str(file), "--name", "g", "--out", str(tmp_path / "set")])
    for distance in ("-1", "nan", "inf"):
        with pytest.raises(vectors.Wrong, match="a finite number"):
            make_group.main([str(files[0]), "--name", "g", "--out", "set", "--distance", distance])
    words = [str(files[0]), "--out", str(tmp_path / "set"), "--name"]
    make_group.main([*words, "g"])
    make_group.main([*words, "g"])  # replaces the group
    with pytest.raises(vectors.Wrong, match="occurs twice"):
        make_group.main([*words, "h"])
    for name in ("a b", "set"):  # an error leaves the set unchanged
        with pytest.raises(vectors.Wrong):
            make_group.main([*words, name])
    assert len(vectors.check(tmp_path / "set").cases) == 1
    code, text, errors = run("make_group.py", "none.json", "--name", "g", "--out", tmp_path / "set")
    assert (code, text, errors.count("\n")) == (2, "", 1) and "make_group.py: none.json" in errors


def test_passing_and_touching_are_told_apart():
    face = [[-1, -1, 0], [3, -1, 0], [-1, 3, 0]]
    for from_, to, result in (
        ([0, 0, 1], [0, 0, -1], "collision"),
        ([1, 1, 1], [1, 1, -1], "collision"),  # through an edge
        ([0, 0, 1], [0, 0, 0], "acceptable"),
        ([-4, 0, 0], [4, 0, 0], "acceptable"),  # in the plane
        ([4, 4, 1], [4, 4, -1], "free"),
    ):
        query = make_group.Features(1, [from_, *face], [to, *face])
        assert make_group.query_facts(query)["result"] == result
