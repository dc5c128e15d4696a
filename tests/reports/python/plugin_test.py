"""Tests detectors in Python, judged in separate processes, and campaigns and pages by the program."""

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
import wrong_detectors

import assay
from assay import hosting
from assay.places import program

SOURCE = """
    import os, sys
    import numpy as np
    import assay

    class Right:
        name, version = "right", "3"
        claims = ["free-sound", "all-pairs", "first-time", "deterministic", "total"]
        def create(self, triangles, positions):
            self.detector = assay.Detector(triangles, positions)
        def evaluate(self, x_t0, x_t1):
            return self.detector.evaluate(x_t0, x_t1)

    class Raises(Right):
        def evaluate(self, x_t0, x_t1):
            print("so far so good")
            return 1 / 0

    class RaisesInCreate(Right):
        def create(self, triangles, positions):
            raise RuntimeError("no room")

    class Refuses(Right):
        def create(self, triangles, positions):
            raise assay.Refused("too many triangles")

    class Full(Right):
        contract = {"capacity_triangles": 7}
        def evaluate(self, x_t0, x_t1):
            raise assay.BeyondCapacity("8 is one too many")

    class FullTooEarly(Full):
        contract = {"capacity_triangles": 8}

    class FullInCreate(Right):
        contract = {"capacity_triangles": 7}
        def create(self, triangles, positions):
            raise assay.BeyondCapacity("8 is one too many")

    class OutOfMemory(Right):
        def evaluate(self, x_t0, x_t1):
            raise MemoryError

    class Blind(Right):
        claims = ["total"]
        def evaluate(self, x_t0, x_t1):
            return None

    class Exits(Right):
        def evaluate(self, x_t0, x_t1):
            os._exit(7)

    class Nonsense(Right):
        def evaluate(self, x_t0, x_t1):
            return {"answer": "perhaps"}

    class WrongClaim(Right):
        claims = ["fast"]

    class WrongContract(Right):
        contract = {"colour": 1}

    class Writes(Right):
        def evaluate(self, x_t0, x_t1):
            open("trace", "w")

    class Parts:
        claims = ["free-sound", "candidates"]
        contract = {"adjacency": "no-shared-vertex", "margin": 0.5}
        def create(self, triangles, positions):
            self.count = len(triangles)
        def candidates(self, x_t0, x_t1):
            return np.argwhere(np.triu(np.ones((self.count, self.count)), 1))

    class Limits:
        claims = ["commit-free", "path-free", "progress", "whole-when-safe", "total"]
        contract = {"progress": 0.9}
        def create(self, triangles, positions):
            self.detector = assay.Detector(triangles, positions, "bvh")
        def limit(self, x_t0, x_t1):
            return self.detector.limit(x_t0, x_t1)

    class Halves(Limits):
        def limit(self, x_t0, x_t1):
            return 0.5, x_t0 + 0.5 * (x_t1 - x_t0)

    class PositionsAlone(Limits):
        claims = ["commit-free"]
        contract = {}
        def limit(self, x_t0, x_t1):
            return {"positions": x_t0.copy()}

    class Queries:
        claims = ["free-sound", "not-late", "first-time", "no-spurious", "total"]
        @staticmethod
        def query(kind, x_t0, x_t1):
            ask = assay.vertex_face if kind == "vertex-face" else assay.edge_edge
            contacts = ask(x_t0[None], x_t1[None])
            return {"first": (contacts.lo[0], contacts.hi[0])} if contacts.hit[0] else None

    class NotCreated:
        claims = ["deterministic"]
        def evaluate(self, x_t0, x_t1):
            return None
"""


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """Writes a module `mine` into a folder, and makes this the current folder."""
    (tmp_path / "mine.py").write_text(textwrap.dedent(SOURCE))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def frames(pair):
    return pair.triangles, [pair.x_t0, pair.x_t1]


def test_a_right_detector_holds(mine, frames):
    report = assay.check(frames, "python:mine:Right")
    assert (report.outcome, report.code) == ("holds", 0)
    assert report.json["detector"]["name"] == "right"
    assert report.json["detector"]["library"] == "python:mine:Right"
    assert "all claims hold" in report.text
    report = assay.check(frames, "python:mine:Right", isolation="limits")
    assert report.json["detector"]["isolation"] == "limits alone"


def test_a_miss_is_told_though_it_breaks_no_claim(mine, frames):
    report = assay.check(frames, "python:mine:Blind")
    assert report.outcome == "holds" and report.steps[0].diff.wrong_answer
    assert "no claim is broken, and the contact of step 1 is missed" in report.text


def test_an_exception_is_an_error_with_its_traceback(mine, frames):
    report = assay.check(frames, "python:mine:Raises")
    assert report.outcome == "defect"
    assert report.steps[0].answer == "error"
    assert report.steps[0].diff.broken == ("total",)
    assert "ZeroDivisionError: division by zero (" in report.json["detector_ended"]
    assert "mine.py:17, in evaluate" in report.json["detector_ended"]
    printed = report.json["detector"]["printed"]
    assert "so far so good" in printed and "Traceback (most recent call last)" in printed
    assert "return 1 / 0" in printed


def test_a_refusal_beyond_the_capacity_breaks_nothing(mine, frames):
    report = assay.check(frames, "python:mine:Full")
    assert (report.outcome, report.code) == ("holds", 0), report.text
    assert report.json["steps"][0]["diff"]["outcome"] == "refused: capacity"
    assert "1 step refused: capacity" in report.text and "8 is one too many" in report.text
    assert report.json["detector"]["contract"]["capacity_triangles"] == 7
    early = assay.check(frames, "python:mine:FullTooEarly")
    assert early.outcome == "defect" and early.steps[0].diff.broken == ("total",)
    assert assay.check(frames, "python:mine:FullInCreate").outcome == "not judged"


@pytest.mark.parametrize(
    "name, outcome, text",
    [
        ("RaisesInCreate", "defect", "RuntimeError: no room"),
        ("Refuses", "defect", "too many triangles"),
        ("OutOfMemory", "undecided", "undecided"),
        ("Exits", "defect", "exited with code 7"),
        ("Nonsense", "defect", "'perhaps' is none of free, collision, undecided"),
        ("NotCreated", "undecided", "no attribute 'create'"),
    ],
)
def test_what_goes_wrong_is_told(mine, frames, name, outcome, text):
    report = assay.check(frames, f"python:mine:{name}")
    assert text in report.text
    assert report.outcome == outcome


@pytest.mark.parametrize(
    "word, text",
    [
        ("python:mine:WrongClaim", "'fast' is none of free-sound"),
        ("python:mine:WrongContract", "'colour' is not a member"),
        ("python:mine:Absent", "mine has no class Absent"),
        ("python:absent:Mine", "no module absent: put its folder on PYTHONPATH"),
        ("python:mine", "write python:MODULE:CLASS"),
        ("python:mi-ne:X", "write python:MODULE:CLASS"),
        ("python:mine:Queries", "assay check QUERIES.csv"),
    ],
)
def test_what_is_no_detector_is_refused_in_a_line(mine, frames, word, text):
    with pytest.raises(ValueError, match=text) as error:
        assay.check(frames, word)
    assert "\n" not in str(error.value)


def test_it_is_shut_in(mine, frames):
    report = assay.check(frames, "python:mine:Writes")
    if report.json["detector"]["isolation"] != "bubblewrap":
        pytest.skip("bubblewrap does not work here")
    assert "OSError: [Errno 30] Read-only file system" in report.text and not (mine / "trace").exists()


def test_a_broad_phase_alone_is_judged(mine, frames):
    report = assay.check(frames, "python:mine:Parts")
    assert report.outcome == "holds"
    assert report.json["detector"]["contract"]["margin"] == 0.5
    assert report.json["steps"][0]["diff"]["candidates"]["given"] == 28


def test_a_limiter_alone_is_judged(mine, frames):
    report = assay.check(frames, "python:mine:Limits")
    assert report.outcome == "holds", report.text
    limit = report.json["steps"][0]["diff"]["limit"]
    assert 0.9 * limit["ahead"][0] <= limit["share"] < limit["ahead"][0]
    halves = assay.check(frames, "python:mine:Halves")
    share = halves.json["steps"][0]["diff"]["limit"]["share"]
    assert share == 0.5 and halves.outcome == "defect", halves.text
    stays = assay.check(frames, "python:mine:PositionsAlone")
    assert stays.outcome == "holds" and "stalls" in stays.text


def test_queries_alone_are_judged(mine):
    queries = Path(__file__).resolve().parents[3] / "corpus" / "queries" / "example_vf.csv"
    command = [program(), "check", str(queries), "--detector", "python:mine:Queries"]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_a_class_stands_for_its_module(frames):
    assert assay.check(frames, wrong_detectors.Wrapper).outcome == "holds"
    report = assay.check(frames, wrong_detectors.DropAPair)
    assert report.outcome == "defect"
    assert [contact.triangles for contact in report.steps[0].diff.missing] == [(2, 4)]


def test_a_class_without_a_module_of_its_own_is_refused(frames):
    class Local(wrong_detectors.Wrapper):
        pass

    with pytest.raises(ValueError, match="top of its module"):
        assay.check(frames, Local)
    with pytest.raises(ValueError, match="stands in no file"):
        assay.check(frames, type("Nowhere", (), {"__module__": "__nowhere__"}))


def test_a_script_judges_its_own_class(tmp_path):
    (tmp_path / "script.py").write_text(
        textwrap.dedent(SOURCE)
        + textwrap.dedent(
            """
            if __name__ == "__main__":
                x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
                triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
                print(assay.check((triangles, [x, x + 1]), Right).outcome)
            """
        )
    )
    command = [sys.executable, tmp_path / "script.py"]
    ended = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ended.stdout == "holds\n"


def test_a_changed_module_is_another_detector(mine):
    campaign = mine / "few.json"
    campaign.write_text(
        '{"schema": "assay-campaign/1", "name": "few", "about": "few", "seconds": null,'
        ' "strata": [{"family": "closed-generic", "cases": 3, "bound": 0.9}], "laws_every": 0}'
    )
    told = []
    ended = assay.run(str(campaign), "python:mine:Right", out="out", progress=told.append, seed=3)
    assert ended.out.is_dir() and ended.text == "".join(line + "\n" for line in told)
    assert any("seed 3" in line for line in told)
    again = assay.run(str(campaign), "python:mine:Right", out="out", seed=3)
    assert again.outcome == ended.outcome
    (mine / "mine.py").write_text(textwrap.dedent(SOURCE) + "\n# changed\n")
    with pytest.raises(assay.AssayError, match="another") as error:
        assay.run(str(campaign), "python:mine:Right", out="out", seed=3)
    assert error.value.code == 2
    page = assay.report("out")
    assert page.out.stat().st_size > 10_000
    assert page._repr_html_().startswith('<iframe srcdoc="&lt;!')


def test_a_case_is_replayed(tmp_path):
    ended = assay.replay("quick:1:closed-generic:5", why="0,5")
    assert ended.outcome == "holds" and "oracle: never in contact" in ended.text
    with pytest.raises(assay.AssayError, match="nowhere"):
        assay.replay(tmp_path / "nowhere.json")
    with pytest.raises(assay.AssayError):
        assay.run("no such campaign", out=tmp_path)


def test_answers_are_read_in_all_their_forms():
    free = hosting.parts_of(None)
    assert free[:3] == (0, 0.0, 0.0) and free[3].shape == (0, 2) and free[4] is None
    assert hosting.parts_of({"answer": "undecided"})[0] == 2
    assert hosting.parts_of({})[:3] == (1, 0.0, 1.0)
    assert hosting.parts_of({"first": 0.25})[1:3] == (0.25, 0.25)
    parts = hosting.parts_of({"first": (0.25, 0.5), "pairs": [(0, 1)], "times": [0.25]})
    assert parts[3].tolist() == [[0, 1]] and parts[4].tolist() == [[0.25, 0.25]]
    for wrong in (
        {"answer": "yes"},
        {"pairs": [1, 2]},
        {"pairs": [[0.5, 1]]},
        {"pairs": [[0, 1]], "times": [[0, 1], [0, 1]]},
    ):
        with pytest.raises(ValueError):
            hosting.parts_of(wrong)
