"""Wrong arguments cause a clear exception, never a crash. A build with asan passes these tests, too."""

import numpy as np
import pytest

import assay


@pytest.fixture
def detector(pair):
    return assay.Detector(pair.triangles, pair.x_t0)


WRONG_POSITIONS = {
    "nothing": (lambda x: None, TypeError, "real numbers"),
    "words": (lambda x: "abc", TypeError, "real numbers"),
    "objects": (lambda x: x.astype(object), TypeError, "real numbers"),
    "complex": (lambda x: x * 1j, TypeError, "complex128"),
    "truth values": (lambda x: x > 0, TypeError, "bool"),
    "dates": (lambda x: x.astype("M8[s]"), TypeError, "datetime64"),
    "records": (lambda x: np.zeros(len(x), "f8,f8,f8"), TypeError, "f8"),
    "masked": (lambda x: np.ma.masked_array(x), TypeError, "masked"),
    "a generator": (lambda x: (row for row in x), TypeError, "real numbers"),
    "a number": (lambda x: 1.0, ValueError, r"shape \(\) is not"),
    "a row": (lambda x: x[0], ValueError, r"shape \(3,\)"),
    "two columns": (lambda x: x[:, :2], ValueError, r"shape \(8, 2\)"),
    "four columns": (lambda x: np.hstack([x, x])[:, :4], ValueError, r"shape \(8, 4\)"),
    "the transpose": (lambda x: x.T, ValueError, r"shape \(3, 8\)"),
    "a stack": (lambda x: x[None], ValueError, r"shape \(1, 8, 3\)"),
    "rows of different lengths": (lambda x: [[1, 2, 3], [1, 2]], ValueError, "inhomogeneous"),
    "an empty list": (lambda x: [], ValueError, r"shape \(0,\)"),
    "fewer rows": (lambda x: x[:-1], ValueError, "7 rows"),
    "no rows": (lambda x: x[:0], ValueError, "0 rows"),
    "more rows": (lambda x: np.vstack([x, x]), ValueError, "16 rows"),
    "NaN": (lambda x: np.full_like(x, np.nan), ValueError, "not finite"),
    "infinity": (lambda x: np.full_like(x, -np.inf), ValueError, "not finite"),
    "NaN of float32": (lambda x: np.full(x.shape, np.nan, np.float32), ValueError, "not finite"),
    "long doubles": (lambda x: x.astype(np.longdouble) + np.longdouble(1) / 3, ValueError, "exact"),
    "large integers": (lambda x: np.full(x.shape, 2**53 + 1), ValueError, "exact"),
    "larger integers": (lambda x: np.full(x.shape, 2**64 - 1, np.uint64), ValueError, "exact"),
}


@pytest.mark.parametrize("wrong", WRONG_POSITIONS)
def test_wrong_positions_are_refused(pair, detector, wrong):
    make, error, text = WRONG_POSITIONS[wrong]
    before = detector.state()
    for call in (detector.evaluate, detector.step):
        with pytest.raises(error, match=text):
            call(pair.x_t0, make(pair.x_t1))
        with pytest.raises(error, match=text):
            call(make(pair.x_t0), pair.x_t1)
    if wrong not in ("fewer rows", "no rows", "more rows"):
        with pytest.raises(error, match=text):
            assay.Detector(pair.triangles, make(pair.x_t0))
    assert detector.state() == before
    assert detector.step(pair.x_t0, pair.x_t1).answer == "collision"


WRONG_TRIANGLES = {
    "nothing": (lambda t: None, TypeError, "integers"),
    "floats": (lambda t: t.astype(float), TypeError, "float64"),
    "truth values": (lambda t: t > 0, TypeError, "bool"),
    "two columns": (lambda t: t[:, :2], ValueError, r"shape \(8, 2\)"),
    "flat": (lambda t: t.ravel(), ValueError, r"shape \(24,\)"),
    "beyond int32": (lambda t: t.astype(np.int64) + 2**32, ValueError, "exact"),
    "no triangles": (lambda t: t[:0], ValueError, "no triangles"),
    "no triangles of int64": (lambda t: np.zeros((0, 3), int), assay.InputError, "no triangles"),
    "an empty list": (lambda t: [], ValueError, r"shape \(0,\)"),
    "too large": (lambda t: t + 1, ValueError, "vertex 8"),
    "negative": (lambda t: t - 1, ValueError, "vertex -1"),
    "repeated": (lambda t: t * 0, ValueError, "twice"),
    "doubled": (lambda t: np.vstack([t, t]), ValueError, "same"),
}


@pytest.mark.parametrize("wrong", WRONG_TRIANGLES)
def test_wrong_triangles_are_refused(pair, wrong):
    make, error, text = WRONG_TRIANGLES[wrong]
    with pytest.raises(error, match=text):
        assay.Detector(make(pair.triangles), pair.x_t0)


def test_input_errors_have_a_name(pair, detector):
    with pytest.raises(assay.InputError) as error:
        detector.step(pair.x_t0, pair.x_t1[:2])
    assert error.value.name == "wrong_frame_size"
    with pytest.raises(assay.InputError) as error:
        assay.Detector(pair.triangles + 1, pair.x_t0)
    assert error.value.name == "index_out_of_range"


@pytest.mark.parametrize("zero", ["broadcast", "tiny strides", "unaligned", "memmap"])
def test_odd_layouts_are_read_as_they_are(pair, zero, tmp_path):
    x = np.zeros_like(pair.x_t0)
    if zero == "broadcast":
        odd = np.broadcast_to(x[0], x.shape)
    elif zero == "tiny strides":
        odd = np.lib.stride_tricks.as_strided(np.zeros(100), x.shape, (8, 8))
    elif zero == "unaligned":
        odd = np.frombuffer(bytearray(x.nbytes + 1), np.uint8)[1:].view(np.float64).reshape(x.shape)
    else:
        odd = np.memmap(tmp_path / "x", np.float64, "w+", shape=x.shape)
    expected = assay.Detector(pair.triangles, pair.x_t0).evaluate(x, x)
    answered = assay.Detector(pair.triangles, pair.x_t0).evaluate(odd, odd)
    assert answered.answer == expected.answer == "collision"
    assert answered.pairs.tolist() == expected.pairs.tolist()


@pytest.mark.parametrize("options", [{"culling": "fast"}, {"pairs": ""}, {"arithmetic": "Exact"}])
def test_an_unknown_word_is_refused(pair, options):
    with pytest.raises(ValueError, match=list(options)[0]):
        assay.Detector(pair.triangles, pair.x_t0, **options)


def test_an_option_is_a_word(pair):
    with pytest.raises(TypeError, match="culling"):
        assay.Detector(pair.triangles, pair.x_t0, culling=3)


def test_a_state_of_another_type_is_refused(detector):
    for wrong in (None, b"", 3, detector):
        with pytest.raises(TypeError):
            detector.restore(wrong)


def test_a_half_made_object_is_no_crash(detector):
    with pytest.raises(AttributeError):
        assay.Detector.__new__(assay.Detector).state()
    with pytest.raises(AttributeError):
        detector.restore(assay.State.__new__(assay.State))
    with pytest.raises(TypeError):
        assay.State(b"")


@pytest.mark.parametrize("ask", [assay.vertex_face, assay.edge_edge])
def test_wrong_queries_are_refused(ask):
    good = np.zeros((2, 4, 3))
    for wrong, error in [
        (None, TypeError),
        (good > 0, TypeError),
        (good[0], ValueError),
        (good[:, :3], ValueError),
        (good[..., :2], ValueError),
        (good[:1], ValueError),
        (good + np.nan, ValueError),
        (good - np.inf, ValueError),
    ]:
        with pytest.raises(error):
            ask(good, wrong)
        with pytest.raises(error):
            ask(wrong, good)
    for odd in (good.astype(">f8"), good[::-1], good.transpose(0, 1, 2)[:, ::-1], good.tolist()):
        assert ask(good, odd).hit.all()
