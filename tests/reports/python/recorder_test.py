"""Tests assay.Recorder: reads its logs back with the standard library alone."""

import struct
import zlib

import numpy as np
import pytest

import assay

MINE = {"name": "mine", "version": "1.5"}


def records(path):
    """Returns the bodies of all records of a log, and checks the bytes around each body."""
    data, out = path.read_bytes(), []
    while data:
        assert data[:9] == b"\x83\x44ASR1\xd8\x18\x5b"
        end = 17 + int.from_bytes(data[9:17], "big")
        body = data[17:end]
        assert data[end : end + 5] == b"\x1a" + zlib.crc32(body).to_bytes(4, "big")
        value, at = item(body, 0)
        assert at == len(body)
        out.append(value)
        data = data[end + 5 :]
    return out


TYPED = {78: "<i4", 85: "<f4", 86: "<f8"}


def item(data, at):
    """Returns one item of CBOR, of a type that a log can have, and where the next item begins."""
    major, info = data[at] >> 5, data[at] & 31
    if data[at] == 0xFB:
        return struct.unpack_from(">d", data, at + 1)[0], at + 9
    size = {24: 1, 25: 2, 26: 4, 27: 8}.get(info, 0)
    number = int.from_bytes(data[at + 1 : at + 1 + size], "big") if size else info
    at += 1 + size
    if major == 0:
        return number, at
    if major == 1:
        return -1 - number, at
    if major == 2:
        return data[at : at + number], at + number
    if major == 3:
        return data[at : at + number].decode(), at + number
    if major == 6:
        held, at = item(data, at)
        return np.frombuffer(held, TYPED[number]), at
    assert major == 5
    fields = {}
    for _ in range(number):
        key, at = item(data, at)
        fields[key], at = item(data, at)
    return fields, at


@pytest.fixture
def path(tmp_path):
    return tmp_path / "steps.log"


def test_a_log_holds_the_mesh_and_the_contract(path, pair):
    contract = {"adjacency": "no-shared-vertex", "separation": 0.5, "rings": 2, "reports": "no-pairs"}
    claims = ["free-sound", "total"]
    with assay.Recorder(
        path,
        pair.triangles,
        pair.x_t0.astype(np.float32),
        **MINE,
        claims=claims,
        contract=contract,
        bodies=[0] * 4 + [1] * 4,
        apart=[(0, 1)],
        rings=3,
        rest_distance=0.25,
    ):
        pass
    begin, end = records(path)
    assert (begin["type"], begin["log"], begin["name"], begin["version"]) == ("begin", 1, "mine", "1.5")
    assert begin["claims"] == 1 | 1 << 7
    assert (begin["adjacency"], begin["separation"], begin["rings"]) == (2, 0.5, 2)
    assert (begin["reports"], begin["motion"], begin["progress"]) == (1, 0, 0)
    assert begin["vertices"] == 8 and (begin["triangles"] == pair.triangles.ravel()).all()
    assert begin["positions"].dtype == np.float32
    assert begin["counted"]["body"].tolist() == [0] * 4 + [1] * 4
    assert begin["counted"]["apart"].tolist() == [0, 1]
    assert (begin["counted"]["rings"], begin["counted"]["rest_distance"]) == (3, 0.25)
    assert (begin["counted"]["rest"] == pair.x_t0.ravel()).all()
    assert end == {"type": "end", "record": 1, "steps": 0}


def test_steps_hold_what_they_were_given(path, pair):
    recorder = assay.Recorder(path, pair.triangles, pair.x_t0, **MINE)
    recorder.step(
        pair.x_t0,
        pair.x_t1,
        committed=pair.x_t0,
        answer="collision",
        first=(0.25, 0.5),
        pairs=[(0, 4), (1, 5)],
        pair_times=[0.25, 0.5],
        share=0.75,
        positions=pair.x_t0.astype(np.float32),
    )
    recorder.note("grüße")
    recorder.step(dx=np.ones((8, 3), np.float32), answer="error", message="no memory")
    recorder.end()
    begin, first, note, second, _ = records(path)
    assert "counted" not in begin
    assert (first["x0"] == pair.x_t0.ravel()).all() and (first["x1"] == pair.x_t1.ravel()).all()
    assert (first["committed"] == first["x0"]).all()
    assert (first["answer"], first["first_lo"], first["first_hi"]) == (1, 0.25, 0.5)
    assert first["pairs"].tolist() == [0, 4, 1, 5]
    assert first["pair_times"].tolist() == [0.25, 0.25, 0.5, 0.5]
    assert first["share"] == 0.75 and first["positions"].dtype == np.float64
    assert note == {"type": "note", "record": 2, "step": 1, "text": "grüße"}
    assert second["dx"].dtype == np.float32 and "x0" not in second
    assert (second["answer"], second["message"]) == (3, "no memory")


def test_an_answer_may_be_that_of_a_detector(path, pair):
    result = assay.Detector(pair.triangles, pair.x_t0).step(pair.x_t0, pair.x_t1)
    with assay.Recorder(path, pair.triangles, pair.x_t0, **MINE) as recorder:
        recorder.step(pair.x_t0, pair.x_t1, answer=result)
        recorder.step(x1=pair.x_t0)
        with pytest.raises(ValueError, match="already states them"):
            recorder.step(x1=pair.x_t0, answer=result, first=0.5)
    first, second = records(path)[1:3]
    assert (first["first_lo"], first["first_hi"]) == result.first
    assert (first["pairs"] == result.pairs.ravel()).all()
    assert (first["pair_times"] == result.times.ravel()).all()
    assert second.keys() == {"type", "record", "step", "x1"}


def test_rows_apart_other_numbers_and_nan_are_recorded(path, pair):
    wide = np.arange(48, dtype=np.float32).reshape(8, 6)
    with assay.Recorder(path, pair.triangles, pair.x_t0, **MINE) as recorder:
        recorder.step(wide[:, 1:4], np.full((8, 3), np.nan))
        recorder.step(pair.x_t0.tolist(), np.ones((8, 3), int))
    first, second = records(path)[1:3]
    assert first["x0"].dtype == np.float32 and (first["x0"] == wide[:, 1:4].ravel()).all()
    assert np.isnan(first["x1"]).all()
    assert second["x1"].dtype == np.float64 and (second["x1"] == 1).all()


def test_what_is_wrong_is_refused_in_one_line(path, pair):
    for words, text in (
        ({"claims": ["all-sound"]}, "claims: 'all-sound' is none of free-sound"),
        ({"contract": {"adjacent": 1}}, "'adjacent' is not a member"),
        ({"contract": {"start": "never"}}, "contract: start: 'never' is none of"),
        ({"bodies": [0]}, r"bodies: shape \(1,\) is not \(8,\)"),
        ({"every": -1}, "every: a number of steps is wanted"),
    ):
        with pytest.raises(ValueError, match=text):
            assay.Recorder(path, pair.triangles, pair.x_t0, **MINE, **words)
    with pytest.raises(ValueError, match="vertex that does not exist"):
        assay.Recorder(path, pair.triangles + 1, pair.x_t0, **MINE)
    assert not path.exists()
    recorder = assay.Recorder(path, pair.triangles, pair.x_t0, **MINE)
    for call, error, text in (
        (lambda: recorder.step(x1=pair.x_t1), ValueError, "x0 is missing"),
        (lambda: recorder.step(pair.x_t0), ValueError, "either x1 or dx"),
        (lambda: recorder.step(pair.x_t0, pair.x_t1[:-1]), ValueError, r"x1: shape \(7, 3\) is not \(8, 3\)"),
        (lambda: recorder.step(pair.x_t0, pair.x_t1.T), ValueError, r"x1: shape \(3, 8\)"),
        (lambda: recorder.step(pair.x_t0, "abc"), TypeError, "x1: real numbers"),
        (lambda: recorder.step(pair.x_t0, pair.x_t1, answer="maybe"), ValueError, "'maybe' is none of"),
        (lambda: recorder.step(pair.x_t0, pair.x_t1, first=0.5), ValueError, "need an answer"),
    ):
        with pytest.raises(error, match=text):
            call()
    recorder.end()
    assert [record["type"] for record in records(path)] == ["begin", "end"]
    with pytest.raises(ValueError, match="nothing is being recorded"):
        recorder.step(pair.x_t0, pair.x_t1)


def test_files_that_are_there_stay(path, pair):
    path.write_text("precious")
    with pytest.raises(FileExistsError, match="steps.log"):
        assay.Recorder(path, pair.triangles, pair.x_t0, **MINE)
    assert path.read_text() == "precious"
    assay.Recorder(path, pair.triangles, pair.x_t0, **MINE, overwrite=True).end()
    assert len(records(path)) == 2
    with pytest.raises(OSError, match="cannot open"):
        assay.Recorder(path / "below", pair.triangles, pair.x_t0, **MINE)


@pytest.mark.parametrize("answer", [False, 0, 7, []])
def test_what_is_no_answer_is_refused(tmp_path, answer):
    """If False were read as "a contact was found", it would hide every miss."""
    triangles, positions = [(0, 1, 2)], [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    with assay.Recorder(tmp_path / "log", triangles, positions, name="mine", claims=["free-sound"]) as log:
        with pytest.raises(ValueError, match="is no answer"):
            log.step(positions, positions, answer=answer)
        log.step(positions, positions, answer=None)
