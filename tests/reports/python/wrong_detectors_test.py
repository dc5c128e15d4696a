"""Ten wrong detectors in Python are found, each by a mesh no larger than that of the same in C++."""

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
    """Of all failures of a run: triangles of the smallest mesh."""
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
