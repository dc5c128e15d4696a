"""Tests assay.Detector and the two elementary queries."""

import contextlib
import ctypes
import os
import platform
import signal
import subprocess
import sys
import threading
import tracemalloc
from dataclasses import replace
from fractions import Fraction

import conftest
import numpy as np
import pytest

import assay


def same(a, b):
    return (
        a.answer == b.answer
        and a.first == b.first
        and np.array_equal(a.pairs, b.pairs)
        and np.array_equal(a.times, b.times)
    )


def test_a_first_contact_is_looked_for_up_to_a_bound(pair):
    detector = assay.Detector(pair.triangles, pair.x_t0)
    first = detector.evaluate(pair.x_t0, pair.x_t1).first
    found = detector.first_contact(pair.x_t0, pair.x_t1, first[1])
    assert (found.answer, found.first) == ("collision", first)
    assert detector.first_contact(pair.x_t0, pair.x_t1).first == first
    detector.commit()
    assert detector.first_contact(pair.x_t0, pair.x_t1, first[0] / 2).answer == "free"
    with pytest.raises(assay.InputError):
        detector.commit()
    for wrong in (-0.5, 1.5, float("nan")):
        with pytest.raises(assay.InputError, match="`until` is not a time from 0 to 1"):
            detector.first_contact(pair.x_t0, pair.x_t1, wrong)


def test_a_limit_stops_before_the_contact(pair):
    detector = assay.Detector(pair.triangles, pair.x_t0)
    limit = detector.limit(pair.x_t0, pair.x_t1)
    assert limit.first == detector.evaluate(pair.x_t0, pair.x_t1).first
    assert 0.9 * limit.first[0] <= limit.share < limit.first[0]
    assert detector.evaluate(pair.x_t0, limit.positions).answer == "free"
    assert not limit.is_short
    whole = detector.limit(pair.x_t0, limit.positions)
    assert (whole.share, whole.first, whole.is_short) == (1, None, False)
    assert np.array_equal(whole.positions, limit.positions)
    detector.commit()
    with pytest.raises(assay.InputError, match="arithmetic double proves no step free"):
        assay.Detector(pair.triangles, pair.x_t0, "bvh", arithmetic="double").limit(pair.x_t0, pair.x_t1)


def test_a_step_has_its_pairs_times_and_sets(pair):
    result = assay.Detector(pair.triangles, pair.x_t0).step(pair.x_t0, pair.x_t1)
    assert result.answer == "collision"
    assert result.pairs.tolist() == [[2, 4], [2, 5], [2, 7]]
    assert (result.pairs.dtype, result.times.dtype) == (np.int32, np.float64)
    lo, hi = result.first
    exact = Fraction(5, 3) / (2 - Fraction(pair.x_t1[4, 0]))
    assert lo < exact < hi == np.nextafter(lo, 1)
    assert (result.times == [lo, hi]).all()
    assert assay.FEATURE_KINDS[result.features[0, 0]] == "vertex_face"
    assert result.features[0].tolist() == [0, 4, 1, 2, 3, -1]
    assert result.signs.dtype == np.int8 and len(result.signs) == 8
    assert result.doubts.dtype == np.uint8
    assert result.counts.search.candidate_pairs >= 3
    assert result.milliseconds.total > 0


def test_free_has_no_time_and_no_pairs(pair):
    result = assay.Detector(pair.triangles, pair.x_t0).evaluate(pair.x_t0, pair.x_t0)
    assert (result.answer, result.first) == ("free", None)
    assert result.pairs.shape == (0, 2) and result.times.shape == (0, 2)


def test_a_result_is_no_truth_value(pair):
    result = assay.Detector(pair.triangles, pair.x_t0).evaluate(pair.x_t0, pair.x_t0)
    with pytest.raises(TypeError):
        bool(result)


@pytest.mark.parametrize("culling", assay.OPTIONS["culling"])
def test_every_culling_answers_alike(cloud, culling):
    expected = assay.Detector(cloud.triangles, cloud.x_t0).step(cloud.x_t0, cloud.x_t1)
    assert len(expected.pairs) > 10
    made = assay.Detector(cloud.triangles, cloud.x_t0, culling)
    assert same(made.step(cloud.x_t0, cloud.x_t1), expected)


def test_only_commit_advances_the_state(pair):
    detector = assay.Detector(pair.triangles, pair.x_t0)
    before = detector.state()
    detector.evaluate(pair.x_t0, pair.x_t1)
    assert detector.state() == before
    detector.commit()
    assert detector.state() != before
    with pytest.raises(assay.InputError) as error:
        detector.commit()
    assert error.value.name == "nothing_to_commit"


def test_a_state_is_a_value(cloud):
    one = assay.Detector(cloud.triangles, cloud.x_t0)
    one.step(cloud.x_t0, cloud.x_t1)
    state = one.state()
    expected = one.step(cloud.x_t1, cloud.x_t0)
    assert state != one.state() and state != "a state"
    other = assay.Detector(cloud.triangles, cloud.x_t0)
    other.restore(state)
    assert other.state() == state
    assert same(other.step(cloud.x_t1, cloud.x_t0), expected)


def test_a_foreign_state_is_refused(pair, cloud):
    state = assay.Detector(pair.triangles, pair.x_t0).state()
    with pytest.raises(assay.InputError) as error:
        assay.Detector(cloud.triangles, cloud.x_t0).restore(state)
    assert error.value.name == "foreign_state"


def test_reset_is_a_new_start(cloud):
    detector = assay.Detector(cloud.triangles, cloud.x_t0)
    first = detector.step(cloud.x_t0, cloud.x_t1)
    detector.reset()
    assert same(detector.step(cloud.x_t0, cloud.x_t1), first)


def strided(x):
    wide = np.zeros((len(x), 5))
    wide[:, 1:4] = x
    return wide[:, 1:4]


def readonly(x):
    x = x.copy()
    x.flags.writeable = False
    return x


@pytest.mark.parametrize("view", [np.array, strided, readonly])
def test_float64_in_rows_is_not_copied(view):
    count = 100_000
    side = np.arange(count, dtype=np.float64)
    x = view(np.stack([side, side % 2, np.zeros(count)], axis=1))
    corners = np.arange(0, count - 2, 1000)
    triangles = np.stack([corners, corners + 1, corners + 2], axis=1).astype(np.int32)
    detector = assay.Detector(triangles, x)
    tracemalloc.start()
    detector.evaluate(x, x)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < x.nbytes / 10


@pytest.mark.parametrize(
    "convert",
    [
        lambda x: x[::-1][::-1],
        lambda x: np.ascontiguousarray(x[::-1])[::-1],
        np.asfortranarray,
        lambda x: x.astype(">f8"),
        lambda x: x.astype(np.float32).astype(np.float64),
        lambda x: x.tolist(),
    ],
)
def test_what_is_no_view_is_converted(convert):
    x_t0 = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.25, 0.25, 1], [1, 1, 1], [2, 2, 1.0]])
    x_t1 = x_t0 - [0, 0, 2] * (np.arange(6) > 2)[:, None]
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    expected = assay.Detector(triangles, x_t0).step(x_t0, x_t1)
    assert expected.answer == "collision"
    for kind in (np.int32, np.int64, np.uint8, ">i4"):
        made = assay.Detector(triangles.astype(kind), convert(x_t0))
        assert same(made.step(convert(x_t0), convert(x_t1)), expected)


def test_others_run_during_a_step_and_may_not_use_its_detector(long_step):
    detector = assay.Detector(long_step.triangles, long_step.x_t0, "none")
    results = []
    thread = threading.Thread(
        target=lambda: results.append(detector.step(long_step.x_t0, long_step.x_t1))
    )
    thread.start()
    turns = refused = 0
    while thread.is_alive():
        turns += 1
        try:
            detector.state()
        except RuntimeError as error:
            assert "another thread" in str(error)
            refused += 1
    assert turns > 1000 and refused > 0
    assert results[0].answer == "collision"


def test_threads_with_a_detector_each_answer_alike(cloud):
    expected = assay.Detector(cloud.triangles, cloud.x_t0).step(cloud.x_t0, cloud.x_t1)
    results = []

    def work():
        detector = assay.Detector(cloud.triangles, cloud.x_t0)
        results.extend(detector.evaluate(cloud.x_t0, cloud.x_t1) for _ in range(20))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 80 and all(same(result, expected) for result in results)


@pytest.mark.parametrize("threads", [0, 1, 2, 4])
def test_threads_do_not_show(threads):
    step = conftest.tetrahedra(300)
    expected = assay.Detector(step.triangles, step.x_t0).step(step.x_t0, step.x_t1)
    detector = assay.Detector(step.triangles, step.x_t0, threads=threads)
    assert same(detector.step(step.x_t0, step.x_t1), expected)
    with pytest.raises(ValueError, match="threads"):
        assay.Detector(step.triangles, step.x_t0, threads=-1)


def test_after_a_fork_threads_are_refused(cloud):
    """Runs in a separate interpreter, because a process that has forked refuses threads from then on."""
    program = """if True:
        import os, sys
        sys.path.insert(0, sys.argv[1])
        import conftest, assay
        step = conftest.tetrahedra(300)
        alone = assay.Detector(step.triangles, step.x_t0)
        several = assay.Detector(step.triangles, step.x_t0, threads=2)
        several.step(step.x_t0, step.x_t1)
        child = os.fork()
        if child == 0:
            refused = 0
            for work in (
                lambda: several.step(step.x_t1, step.x_t0),
                lambda: assay.Detector(step.triangles, step.x_t0, threads=0),
            ):
                try:
                    work()
                except RuntimeError:
                    refused += 1
            assert alone.step(step.x_t0, step.x_t1).answer == "collision"
            os._exit(10 + refused)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 12
        assert several.step(step.x_t1, step.x_t0).answer == "collision"
    """
    command = [sys.executable, "-c", program, os.path.dirname(__file__)]
    subprocess.run(command, check=True)


def test_after_a_fork_each_process_has_its_own(cloud):
    detector = assay.Detector(cloud.triangles, cloud.x_t0)
    detector.step(cloud.x_t0, cloud.x_t1)
    child = os.fork()
    if child == 0:
        code = 1
        try:
            fresh = assay.Detector(cloud.triangles, cloud.x_t0)
            fresh.step(cloud.x_t0, cloud.x_t1)
            alike = same(detector.step(cloud.x_t1, cloud.x_t0), fresh.step(cloud.x_t1, cloud.x_t0))
            code = 0 if alike else 2
        finally:
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert detector.step(cloud.x_t1, cloud.x_t0).answer == "collision"


def test_ctrl_c_ends_a_step_and_leaves_the_state(endless_step):
    detector = assay.Detector(endless_step.triangles, endless_step.x_t0, "none")
    before = detector.state()

    def interrupt():
        while True:
            try:
                detector.state()
            except RuntimeError:  # the step is under way
                os.kill(os.getpid(), signal.SIGINT)
                return

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        detector.step(endless_step.x_t0, endless_step.x_t1)
    thread.join()
    assert detector.state() == before
    with pytest.raises(assay.InputError, match="commit"):
        detector.commit()


def test_queries_answer_exactly():
    face = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
    above, below, beside = [0.25, 0.25, 1], [0.25, 0.25, -2], [2, 2, -2]
    x_t0 = np.array([[above, *face], [above, *face]])
    x_t1 = np.array([[below, *face], [beside, *face]])
    contacts = assay.vertex_face(x_t0, x_t1)
    assert contacts.hit.tolist() == [True, False]
    third = contacts.lo[0]
    assert third < 1 / 3 + 1e-16 and contacts.hi[0] == np.nextafter(third, 1)
    assert np.isnan(contacts.lo[1]) and np.isnan(contacts.hi[1])

    edges_t0 = np.array([[[0, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1.0]]])
    edges_t1 = edges_t0 - [[[0, 0, 0], [0, 0, 0], [0, 0, 2], [0, 0, 2]]]
    contacts = assay.edge_edge(edges_t0, edges_t1)
    assert (contacts.hit[0], contacts.lo[0], contacts.hi[0]) == (True, 0.5, 0.5)


def test_no_queries_have_no_answers():
    contacts = assay.vertex_face(np.zeros((0, 4, 3)), np.zeros((0, 4, 3)))
    assert contacts.hit.shape == contacts.lo.shape == contacts.hi.shape == (0,)


@contextlib.contextmanager
def processor_state(bits):
    """Sets these bits of MXCSR, the last word of glibc's fenv_t, and yields a function that reads them."""
    library, words = ctypes.CDLL("libm.so.6"), (ctypes.c_uint32 * 8)()

    def state():
        library.fegetenv(words)
        return words[7] & bits

    state()
    words[7] |= bits
    library.fesetenv(words)
    try:
        yield state
    finally:
        library.fegetenv(words)
        words[7] &= ~bits
        library.fesetenv(words)


@pytest.mark.skipif(platform.machine() != "x86_64", reason="MXCSR is of x86")
@pytest.mark.parametrize("bits", [0x8040, 0x4000, 0x2000, 0x6000], ids=["flush", "up", "down", "zero"])
def test_the_state_of_the_processor_changes_no_answer(bits):
    triangles = np.array([[0, 1, 2], [3, 4, 5]], np.int32)
    flat = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], float)
    above, below = (np.vstack([flat, flat + [0.3, 0.1, z]]) for z in (0.7, -0.4))
    met = np.vstack([flat, flat]) * 5e-324
    near = np.vstack([flat, flat + [0, 0, 1e-45]]).astype(np.float32)
    query = [[[1, 1, 64 * 5e-324], *flat]], [[[1, 1, -64 * 5e-324], *flat]]

    def answers():
        told = []
        for x_t0, x_t1 in ((above, below), (met, met), (near, near)):
            detector = assay.Detector(triangles, x_t0, arithmetic="bounded", threads=2)
            result, limit = detector.evaluate(x_t0, x_t1), detector.limit(x_t0, x_t1)
            told += [result.answer, result.first, result.pairs.tolist(), limit.share]
            told += [limit.positions.tobytes(), detector.state()]
        hits = assay.vertex_face(*query)
        return [*told, hits.hit.tolist(), hits.lo.tobytes(), hits.hi.tobytes()]

    usual = answers()
    assert usual[0::6][:3] == ["collision", "collision", "free"]
    assert usual[-3] == [True]
    with processor_state(bits) as state:
        odd, kept = answers(), state()
    assert odd == usual
    assert kept == bits


def test_the_places_of_contacts_are_on_both_triangles(cloud):
    result = assay.Detector(cloud.triangles, cloud.x_t0).evaluate(cloud.x_t0, cloud.x_t1)
    places = assay.contact_places(result)
    assert len(places.point) == len(result.pairs) > 10
    assert repr(places) == f"<assay.ContactPlaces: {len(result.pairs)} pairs>"
    for k, two in enumerate(result.pairs):
        t = Fraction(float(result.times[k, 0]))
        for side, triangle in enumerate(two):
            weights = [Fraction(float(w)) for w in places.barycentric[k, side]]
            assert min(weights) >= 0 and abs(sum(weights) - 1) < 1e-15
            for axis in range(3):
                at = 0
                for weight, vertex in zip(weights, cloud.triangles[triangle]):
                    a, b = (Fraction(float(x[vertex, axis])) for x in (cloud.x_t0, cloud.x_t1))
                    at += weight * (a + t * (b - a))
                off = abs(at - Fraction(float(places.point[k, axis])))
                assert off <= Fraction(float(places.error[k]))
    unit = np.linalg.norm(places.normal, axis=1)
    assert np.all(np.isnan(unit) | (abs(unit - 1) < 1e-12)) and np.sum(np.isfinite(unit)) > 10
    assert np.array_equal(np.isnan(unit), np.isnan(places.normal_error))


def test_a_contact_without_a_named_feature_has_no_place(pair):
    result = assay.Detector(pair.triangles, pair.x_t0).evaluate(pair.x_t0, pair.x_t1)
    unnamed = replace(result, features=np.full_like(result.features, -1) * [0, 1, 1, 1, 1, 1])
    places = assay.contact_places(unnamed)
    for part in (places.point, places.barycentric, places.error, places.normal):
        assert len(part) == len(result.pairs) and np.all(np.isnan(part))
    with pytest.raises(ValueError, match="pairs: no such triangle"):
        assay.contact_places(replace(result, pairs=result.pairs + 8))
    same = result.features.copy()
    same[:, 0] = assay.FEATURE_KINDS.index("same_vertices")
    assert np.all(np.isnan(assay.contact_places(replace(result, features=same)).point))
    with pytest.raises(ValueError, match="a vertex that is not of the pair"):
        assay.contact_places(replace(result, pairs=result.pairs * 0))
    with pytest.raises(ValueError, match="features: no such kind"):
        assay.contact_places(replace(result, features=result.features + 8))
