"""The production detector and its elementary test."""

from __future__ import annotations

import math
from typing import Tuple, Union

from numpy.typing import ArrayLike

from . import _detector, arrays
from .results import ContactPlaces, Contacts, Judgement, Limit, StepResult, step_result

OPTIONS = _detector.OPTIONS  # the words of each option


class State:
    """What a detector carries from step to step, as a value: Detector.restore() takes it back."""

    def __init__(self, saved: _detector.State):
        if not isinstance(saved, _detector.State):
            raise TypeError("a state is what Detector.state() gives")
        self._saved = saved

    def __eq__(self, other: object) -> bool:
        return isinstance(other, State) and self._saved == other._saved


class Detector:
    """The built-in detector of one deforming mesh.

    triangles: integers (m, 3), vertices of each, counter-clockwise seen from outside.
    positions: real numbers (n, 3), in your units: the first frame is best.
    culling, start, pairs, arithmetic: words of assay.OPTIONS, explained in detector/README.md.
    separation: 0 looks for contacts, a distance for pairs of triangles without a common vertex that
    come within it; culling "bvh" or "none" then.
    threads: how many a step may use; 0: all cores. What comes out does not depend on it.

    int32 and float64 in rows of three adjacent numbers are not copied. Other integers and floats are
    converted once where that is exact.

    InputError (a ValueError): a mesh that is refused, by name. ValueError: another shape, an unknown
    word, a number without exact float64. TypeError: no numbers.

    Calls release the interpreter, and ctrl-C ends them: the state stays as it was. A detector is used
    by one thread at a time (RuntimeError otherwise); different detectors are independent. Arrays must
    not change during a call. After os.fork() each process has a detector of its own; one with several
    threads is refused there (RuntimeError) if the process that forked had one with several threads.
    """

    def __init__(
        self,
        triangles: ArrayLike,
        positions: ArrayLike,
        culling: str = "auto",
        *,
        start: str = "verified",
        pairs: str = "all",
        arithmetic: str = "exact",
        separation: float = 0.0,
        threads: int = 1,
    ):
        options = {"culling": culling, "start": start, "pairs": pairs, "arithmetic": arithmetic}
        if separation != 0:
            options["separation"] = repr(_question("exact", float(separation))[1])
        if not 0 <= threads <= 1024:
            raise ValueError("threads: 0 (all cores) to 1024 are wanted")
        self._detector = _detector.Detector(triangles, positions, options, threads)
        self._triangles = triangles
        usual = {"start": "verified", "pairs": "all"}
        chosen = [f"{name} {word}" for name, word in options.items() if word != usual.get(name)]
        self._words = ", ".join(chosen)

    def __repr__(self) -> str:
        return f"<assay.Detector: {len(self._triangles)} triangles, {self._words}>"

    def evaluate(self, x_t0: ArrayLike, x_t1: ArrayLike) -> StepResult:
        """The step from x_t0 to x_t1, real numbers (n, 3) each; the state stays as it is."""
        return step_result(self._detector.evaluate(x_t0, x_t1), self._triangles, x_t0, x_t1)

    def commit(self) -> None:
        """Advances the state to the end of the last step or limit. InputError: there is none to commit."""
        self._detector.commit()

    def step(self, x_t0: ArrayLike, x_t1: ArrayLike) -> StepResult:
        """evaluate() and commit()."""
        return step_result(self._detector.step(x_t0, x_t1), self._triangles, x_t0, x_t1)

    def first_contact(self, x_t0: ArrayLike, x_t1: ArrayLike, until: float = 1.0) -> StepResult:
        """Whether there is a contact in [0, until], and which is first; the state stays as it is.

        Pairs are those of pairs="first", whatever `pairs` says. "free" says that there is no contact up
        to `until`; one at `until` counts. Nothing later is looked at, so a caller that knows a contact
        can give its time. Only after until = 1 is there something to commit. InputError: `until` is not
        from 0 to 1.
        """
        return step_result(self._detector.first_contact(x_t0, x_t1, until), self._triangles, x_t0, x_t1)

    def limit(self, x_t0: ArrayLike, x_t1: ArrayLike) -> Limit:
        """How far the step may be taken; the state stays as it is.

        To limit.positions the straight way is free, rounding included; commit() then goes there. A
        step that is free is taken whole; else 0.95 of the time until the contact, or less where
        rounding asks for it (is_short). Share 0: a contact at the start, or at all places tried.
        InputError: arithmetic "double" or "float", which prove nothing.
        """
        return Limit(*self._detector.limit(x_t0, x_t1))

    def state(self) -> State:
        """What later steps rest on, as a value to keep."""
        return State(self._detector.state())

    def restore(self, state: State) -> None:
        """Goes on from this state. InputError: it is the state of another mesh or culling."""
        if not isinstance(state, State):
            raise TypeError(f"a State is wanted, not {type(state).__name__}")
        self._detector.restore(state._saved)

    def reset(self) -> None:
        """Forgets the state: the next step is a new start."""
        self._detector.reset()


def vertex_face(
    x_t0: ArrayLike, x_t1: ArrayLike, *, arithmetic: str = "exact", separation: float = 0
) -> Contacts:
    """Whether and when vertices and faces first meet, exactly; about a microsecond a query.

    x_t0, x_t1: real numbers (k, 4, 3), the vertex and the three corners of the face at both ends of
    the step. arithmetic: other words of OPTIONS["arithmetic"] are less than exact. separation: above 0,
    whether and when they come within this distance, exactly. ValueError: another shape or word, a
    coordinate that is not finite, or a distance that is no length.
    """
    return Contacts(*_detector.vertex_face(x_t0, x_t1, *_question(arithmetic, separation)))


def edge_edge(
    x_t0: ArrayLike, x_t1: ArrayLike, *, arithmetic: str = "exact", separation: float = 0
) -> Contacts:
    """The same for two edges: (k, 4, 3) are the two ends of one, then the two ends of the other."""
    return Contacts(*_detector.edge_edge(x_t0, x_t1, *_question(arithmetic, separation)))


def _question(arithmetic: str, separation: float) -> Tuple[str, float]:
    if not (math.isfinite(separation) and separation >= 0):
        raise ValueError("separation: a length is wanted, finite and not below 0")
    if separation > 0 and arithmetic != "exact":
        raise ValueError("separation: only exact arithmetic answers it")
    return arithmetic, separation


def contact_places(result: Union[StepResult, Judgement]) -> ContactPlaces:
    """Where the pairs of a result meet, for a response. Contacts of a CheckedStep have their places."""
    mesh = arrays.triangles(result.triangles, "triangles")
    x_t0, x_t1 = arrays.positions(result.x_t0, "x_t0"), arrays.positions(result.x_t1, "x_t1")
    return ContactPlaces(
        *_detector.contact_places(mesh, x_t0, x_t1, result.pairs, result.times, result.features)
    )
