"""Compares the answers in a simulator's log (tests/recording/cloth.cpp) with exact ones, and rewrites it."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import assay
from recorder_test import records

CLOTH = Path(os.environ["ASSAY_BUILD_DIR"], "record_cloth")
WORDS = {
    "name": "textbook cubic",
    "version": "1",
    "claims": ["free-sound", "not-late", "first-time", "all-pairs"],
    "contract": {"adjacency": "no-shared-vertex", "start": "free"},
}
ANSWERS = ("free", "collision")


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("logs")
    for name in ("sound", "slip"):
        subprocess.run([CLOTH, folder / name, *["slip"][: name == "slip"]], check=True)
    return folder


def rows(array, columns=3):
    return None if array is None else array.reshape(-1, columns)


def steps_of(path):
    """Returns the triangles and the rest positions of a log, and each step with its start."""
    begin, *steps, _ = records(path)
    end, started = None, []
    for step in steps:
        start = step.get("x0", end)
        end = step.get("committed", step["x1"])
        started.append((rows(start), step))
    return rows(begin["triangles"]), rows(begin["positions"]), started


def test_the_sound_simulator_is_right_and_stays_free(logs):
    triangles, _, steps = steps_of(logs / "sound")
    assert len(steps) == 500
    collisions = 0
    for x0, step in steps:
        exact = assay.Detector(triangles, x0).step(x0, rows(step["x1"]))
        assert ANSWERS[step["answer"]] == exact.answer
        if exact.answer == "free":
            continue
        collisions += 1
        assert step["first_lo"] <= exact.first[0] <= exact.first[1] <= step["first_hi"]
        apart = [not set(triangles[a]) & set(triangles[b]) for a, b in exact.pairs]
        told = {tuple(sorted(pair)) for pair in rows(step["pairs"], 2).tolist()}
        assert told == {tuple(sorted(pair)) for pair in exact.pairs[apart].tolist()}
    assert collisions > 100


def test_the_slip_misses_a_contact(logs):
    triangles, _, steps = steps_of(logs / "slip")
    for number, (x0, step) in enumerate(steps):
        exact = assay.Detector(triangles, x0).step(x0, rows(step["x1"]))
        if ANSWERS[step["answer"]] != exact.answer:
            break
    assert (step["answer"], exact.answer) == (0, "collision") and exact.first[0] > 0
    assert number == step["step"] > 50


def test_python_writes_the_same_bytes(logs, tmp_path):
    triangles, rest, steps = steps_of(logs / "slip")
    with assay.Recorder(tmp_path / "again", triangles, rest, **WORDS) as recorder:
        for _, step in steps:
            recorder.step(
                rows(step.get("x0")),
                rows(step["x1"]),
                committed=rows(step.get("committed")),
                answer=ANSWERS[step["answer"]],
                first=(step["first_lo"], step["first_hi"]) if step["answer"] else None,
                pairs=rows(step.get("pairs"), 2),
                pair_times=rows(step.get("pair_times"), 2),
            )
    assert (tmp_path / "again").read_bytes() == (logs / "slip").read_bytes()


def test_the_slip_comes_home_as_two_triangles(logs, tmp_path):
    """Python records the log, and the program judges it."""
    triangles, rest, steps = steps_of(logs / "slip")
    with assay.Recorder(tmp_path / "log", triangles, rest, **WORDS) as recorder:
        for x0, step in steps[:120]:
            is_hit = step["answer"] == 1
            recorder.step(
                x0,
                rows(step["x1"]),
                answer=ANSWERS[step["answer"]],
                first=(step["first_lo"], step["first_hi"]) if is_hit else None,
                pairs=rows(step.get("pairs"), 2),
            )
    program = Path(os.environ["ASSAY_BUILD_DIR"], "assay")
    judged = subprocess.run([program, "check", tmp_path / "log", "--keep", tmp_path / "out"])
    assert judged.returncode == 1
    first = sorted((tmp_path / "out").glob("step-*"))[0]
    assert len(json.loads((first / "pair.json").read_text())["triangles"]) == 2
