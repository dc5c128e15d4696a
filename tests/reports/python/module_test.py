"""Tests what a user sees of the module before the first call, and results as lists and arrays."""

import inspect
import os
import pickle
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

import assay
from assay.places import program

CAMPAIGN = """{"schema": "assay-campaign/1", "name": "few", "seconds": null, "laws_every": 0,
  "strata": [{"family": "closed-degenerate", "cases": 4, "bound": 0.9}]}"""

BLIND = """
    class Blind:
        name = "blind"
        claims = ["free-sound"]
        def create(self, triangles, positions):
            pass
        def evaluate(self, x_t0, x_t1):
            return None
"""


def printed_by(words, **options):
    return subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True, **options).stdout


def test_it_has_the_version_of_the_program():
    assert printed_by([program(), "--version"]).startswith(f"assay {assay.__version__} (")
    stated = Path(__file__).resolve().parents[3] / "detector" / "VERSION"
    assert assay.__version__ == stated.read_text().strip()


def test_what_is_for_users_is_listed_and_nothing_else():
    assert set(dir(assay)) == {*assay.__all__, "__version__", "__doc__", "__file__"}
    for name in assay.__all__:
        assert not inspect.ismodule(getattr(assay, name))
    imported = {
        name
        for name, value in vars(assay).items()
        if not name.startswith("_") and not inspect.ismodule(value) and name != "List"
    }
    assert imported == set(assay.__all__)


def test_the_module_is_run_as_the_program():
    version = printed_by([program(), "--version"])
    assert printed_by([sys.executable, "-m", "assay", "--version"]) == version
    ended = subprocess.run([sys.executable, "-m", "assay", "no-verb"], stderr=subprocess.PIPE)
    assert ended.returncode == 2
    missing = dict(os.environ, ASSAY_PROGRAM="/nowhere/assay")
    ended = subprocess.run(
        [sys.executable, "-m", "assay"], env=missing, stderr=subprocess.PIPE, text=True
    )
    assert ended.stderr.count("\n") == 1 and "are not beside the package" in ended.stderr


def test_signatures_are_read_at_a_glance():
    for name in assay.__all__:
        value = getattr(assay, name)
        if not callable(value) or isinstance(value, type) and issubclass(value, (Exception, dict)):
            continue
        of_one = str(inspect.signature(value)).split(", ")
        assert max(map(len, of_one)) <= 60, name


def test_what_comes_back_shows_itself_in_a_line(pair, cloud):
    detector = assay.Detector(pair.triangles, pair.x_t0)
    assert repr(detector) == "<assay.Detector: 8 triangles, culling auto, arithmetic exact>"
    assert repr(assay.Detector(pair.triangles, pair.x_t0, "bvh", pairs="first", separation=0.5)) == (
        "<assay.Detector: 8 triangles, culling bvh, pairs first, arithmetic exact, separation 0.5>"
    )
    result = detector.step(pair.x_t0, pair.x_t1)
    assert repr(result).startswith("<assay.StepResult: collision, first (0.")
    assert repr(result).endswith(f", {len(result.pairs)} pairs>")
    assert repr(detector.step(pair.x_t1, pair.x_t1 + 0)).startswith("<assay.StepResult: ")
    still = assay.judge(pair.triangles, pair.x_t0, pair.x_t0)
    assert repr(still) == "<assay.Judgement: free>"
    assert repr(detector.limit(pair.x_t0, pair.x_t0)) == "<assay.Limit: 1.0 of the step, first None>"
    frames = pair.triangles, [pair.x_t0, pair.x_t1]
    assert repr(assay.check(frames)) == "<assay.CheckReport: holds, 1 steps>"
    assert repr(assay.check(frames, separation=0.1)) == "<assay.SeparationReport: near, 1 steps>"
    assert repr(assay.Frames(*frames)) == "<assay.Frames: 2 frames of 8 triangles>"
    queries = np.zeros((3, 4, 3))
    assert repr(assay.vertex_face(queries, queries)).startswith("<assay.Contacts: 3 of 3 meet>")
    assert max(len(repr(part)) for part in (result, still, detector)) < 110


@pytest.fixture
def mine(tmp_path, monkeypatch):
    (tmp_path / "mine.py").write_text(textwrap.dedent(BLIND))
    (tmp_path / "few.json").write_text(CAMPAIGN)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_progress_goes_to_stderr_line_by_line(mine, pair, capfd):
    report = assay.check((pair.triangles, [pair.x_t0, pair.x_t1]), progress=True)
    assert capfd.readouterr() == ("", report.text)
    outcome = assay.run("few.json", "python:mine:Blind", out="judged", progress=True)
    assert capfd.readouterr() == ("", outcome.text)


def test_errors_stand_beside_times_in_a_picture(mine):
    pytest.importorskip("matplotlib").use("svg")
    outcome = assay.run("few.json", "python:mine:Blind", out="judged")
    figure = assay.plot(outcome, outcome)
    missed, alarms = figure.axes
    assert missed.get_xscale() == "log" and missed.get_title() == "a contact, answered free"
    assert [drawn.get_label() for drawn in missed.containers] == ["blind 0", "blind 0"]
    (stratum,) = outcome.strata
    assert stratum["measures"]["answered_free"]["of"] >= 1
    (time,), (share,) = missed.containers[0].lines[0].get_data()
    assert time > 0 and share == 100 * stratum["measures"]["answered_free"]["share"]
    figure.savefig("errors.svg")
    assert "answered collision" in Path("errors.svg").read_text()
    with pytest.raises(ValueError, match="name an outcome"):
        assay.plot()
    with pytest.raises(ValueError, match="a detector of yours"):
        assay.plot(assay.run("few.json", out="shipped"))


def test_without_matplotlib_a_plot_names_the_package(mine, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=r"^assay.plot needs matplotlib \(Debian: python3-matplotlib"):
        assay.plot()


def test_a_run_has_its_strata_and_failures_as_lists(mine):
    outcome = assay.run("few.json", "python:mine:Blind", out="judged")
    assert repr(outcome) == "<assay.Outcome: defect, judged>"
    (stratum,) = outcome.strata
    assert (stratum["family"], stratum["trials"]) == ("closed-degenerate", 4)
    assert stratum["with_defect"] >= 1
    assert outcome.failures
    for failure in outcome.failures:
        assert isinstance(failure, dict) and failure["claim"] == "free-sound"
        frames = failure.frames()
        assert frames.triangles.shape == (failure["after"]["triangles"], 3)
        assert len(frames) == failure["after"]["steps"] + 1
        x_t0, x_t1 = frames.positions[:2]
        assert x_t0.shape == x_t1.shape == (failure["after"]["vertices"], 3)
        # The smallest mesh shows what failed: there is a contact.
        assert assay.judge(frames.triangles, x_t0, x_t1).answer == "collision"
        assert pickle.loads(pickle.dumps(failure)) == failure


def test_a_run_without_failures_has_none_and_a_replay_has_no_strata(mine):
    assert assay.run("few.json", out="right", jobs=2).failures == []
    with pytest.raises(ValueError, match="only outcomes of run"):
        assay.replay("quick:1:closed-generic:5").strata


JUDGES_AT_ONCE = """
    import assay

    triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    frames = triangles, [[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, z]] for z in (1, -1)]

    class Right:
        claims = ["free-sound", "total"]
        def create(self, triangles, positions):
            self.detector = assay.Detector(triangles, positions)
        def evaluate(self, x_t0, x_t1):
            return self.detector.evaluate(x_t0, x_t1)

    print(assay.check(frames, Right).outcome)
    print(assay.run("few.json", Right, out="run").outcome)
"""


def test_a_class_of_a_script_without_a_guard_is_judged(mine):
    (mine / "script.py").write_text(textwrap.dedent(JUDGES_AT_ONCE))
    assert printed_by([sys.executable, "script.py"]) == "holds\nholds\n"


def test_a_class_that_a_script_defines_after_it_judged_another_is_refused_in_a_line(mine):
    text = JUDGES_AT_ONCE + """
    class Late(Right):
        pass

    try:
        assay.check(frames, Late)
    except ValueError as error:
        print(error)
"""
    (mine / "script.py").write_text(textwrap.dedent(text))
    last = printed_by([sys.executable, "script.py"]).splitlines()[2:]
    assert len(last) == 1
    assert "script has no class Late: the module judges a detector before" in last[0]


def test_a_class_of_a_notebook_is_refused_in_a_line():
    cell = "import assay\nclass Mine:\n  claims = []\ntry:\n  assay.check(([], []), Mine)\n"
    cell += "except ValueError as error:\n  print(error)\n"
    (line,) = printed_by([sys.executable, "-c", cell]).splitlines()
    assert line.startswith("Mine: a class of a notebook or a prompt") and "%%writefile" in line
