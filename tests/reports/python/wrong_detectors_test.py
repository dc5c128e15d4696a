"""Tests that wrong detectors in Python are found, by meshes no larger than for the same detectors in C++."""

import json
import os
from pathlib import Path

import pytest
import wrong_detectors as wrong

import assay

PLUGINS = Path(os.environ["ASSAY_PLUGIN_DIR"])

# In the order of enum Way of tests/plugins/wrong_wrapper.cpp.
WAYS = [
    wrong.DropAPair,
    wrong.LateByAnUlp,
    wrong.LatePairs,
    wrong.ForgetCommit,
    wrong.FreeWhenFew,
    wrong.DropNeighbours,
    wrong.RoundToFloat,
    wrong.FreeAtStart,
    wrong.AddAPair,
    wrong.HalfAStep,
]

CAMPAIGN = {
    "schema": "assay-campaign/1",
    "name": "wrong",
    "about": "a few cases of each kind, to be failed",
    "strata": [
        {"family": "closed-generic", "cases": 12, "bound": 0.9},
        {"family": "closed-degenerate", "cases": 12, "bound": 0.9},
        {"family": "unclosed-generic", "cases": 12, "bound": 0.9},
    ],
    "seconds": None,
    "laws_every": 0,
}


def smallest_mesh(folder):
    """Returns the number of triangles of the smallest mesh among all failures of a run."""
    files = Path(folder, "failures").glob("*-smallest.json")
    return min(len(json.loads(file.read_text())["triangles"]) for file in files)


@pytest.mark.parametrize("way", range(len(WAYS)))
def test_a_wrong_detector_is_found(way, tmp_path, monkeypatch):
    monkeypatch.setenv("ASSAY_TEST_WRONG", str(way))
    campaign = tmp_path / "wrong.json"
    campaign.write_text(json.dumps(CAMPAIGN))
    in_python = assay.run(str(campaign), WAYS[way], out=tmp_path / "python")
    in_cpp = assay.run(str(campaign), PLUGINS / "plugin_wrong_wrapper.so", out=tmp_path / "cpp")
    assert in_python.outcome == in_cpp.outcome == "defect", in_python.text + in_cpp.text
    sizes = smallest_mesh(tmp_path / "python"), smallest_mesh(tmp_path / "cpp")
    print(WAYS[way].__name__, *sizes)
    assert sizes[0] <= sizes[1]


# The eleventh way: the answers differ from process to process, but not within a process.
@pytest.mark.parametrize("detector", [wrong.OrderOfASet, PLUGINS / "plugin_wrong_wrapper.so"])
def test_one_that_differs_from_process_to_process_is_found(detector, tmp_path, monkeypatch, pair):
    monkeypatch.setenv("ASSAY_TEST_WRONG", str(len(WAYS)))
    campaign = tmp_path / "wrong.json"
    more = [dict(stratum, cases=60) for stratum in CAMPAIGN["strata"]]  # more cases, because only some are repeated
    campaign.write_text(json.dumps(dict(CAMPAIGN, strata=more)))
    run = assay.run(str(campaign), detector, out=tmp_path / "run")
    assert run.outcome == "defect", run.text
    assert "deterministic" in run.text and "two runs differ" in run.text
    checked = assay.check((pair.triangles, [pair.x_t0, pair.x_t1]), detector)
    assert checked.outcome == "defect", checked.text
    assert "deterministic" in checked.text
