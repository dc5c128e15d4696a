"""The production detector and its elementary test."""

from __future__ import annotations

import math
from typing import Tuple, Union

from numpy.typing import ArrayLike

from . import _detector, arrays
from .results import ContactPlaces, Contacts, Judgement, Limit, StepResult, step_result

OPTIONS = _detector.OPTIONS  # the words of each option


class State:
    """The state that a detector carries from step to step. Detector.restore() sets it again."""

    def __init__(self, saved: _detector.State):
        if not isinstance(saved, _detector.State):
            raise TypeError("a State comes from Detector.state()")
        self._saved = saved

    def __eq__(self, other: object) -> bool:
        return isinstance(other, State) and self._saved == other._saved


class Detector:
    """The built-in detector of one deforming mesh.

    triangles: integers (m, 3), three vertices each, counter-clockwise as seen from outside.
    positions: real numbers (n, 3), in your units, preferably those of the first frame.
    culling, start, pairs, arithmetic: words of assay.OPTIONS, explained in detector/README.md.
    separation: 0 looks for contacts. A distance looks for pairs of triangles that share no vertex
    and come within this distance; culling is then "bvh" or "none".
    threads: how many threads a step may use; 0: all cores. Results do not depend on it.

    int32 and float64 in rows of three adjacent numbers are not copied. Other integers and floats
    are converted once; each number must have an exact int32 or float64.

    InputError (a ValueError): the mesh is refused; the error's `name` says why. ValueError: another
    shape, an unknown word, a number without exact float64. TypeError: no numbers.

    Calls release the interpreter. Ctrl-C ends a call and leaves the state as it was. Only one
    thread at a time may use a detector (else RuntimeError); two detectors do not affect each other.
    Arrays must not change during a call. After os.fork() each process has its own copy of a
    detector. In the child several threads are refused (RuntimeError) if the parent used several.
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
        """Answers the step from x_t0 to x_t1, real numbers (n, 3) each, and keeps the state."""
        return step_result(self._detector.evaluate(x_t0, x_t1), self._triangles, x_t0, x_t1)

    def commit(self) -> None:
        """Advances the state to the end of the last step or limit. InputError: there is no step."""
        self._detector.commit()

    def step(self, x_t0: ArrayLike, x_t1: ArrayLike) -> StepResult:
        """Calls evaluate() and commit()."""
        return step_result(self._detector.step(x_t0, x_t1), self._triangles, x_t0, x_t1)

    def first_contact(self, x_t0: ArrayLike, x_t1: ArrayLike, until: float = 1.0) -> StepResult:
        """Finds the first contact in [0, until], and keeps the state.

        The result has pairs as with pairs="first", whatever `pairs` is. "free" means that there is
        no contact in [0, until]. Later contacts are not looked for, so a caller that knows a
        contact can pass its time as `until`. commit() is possible only if `until` is 1. InputError:
        `until` is not in [0, 1].
        """
        return step_result(self._detector.first_contact(x_t0, x_t1, until), self._triangles, x_t0, x_t1)

    def limit(self, x_t0: ArrayLike, x_t1: ArrayLike) -> Limit:
        """Finds how far the step may be taken, and keeps the state.

        The straight way to limit.positions has no contact, rounding included; commit() then goes
        there. A free step is taken whole. Otherwise the share is 0.95 of the time of the contact,
        or less if rounding requires it (is_short). It is 0 if there is a contact at the start, or
        at each place that was tried. InputError: arithmetic "double" or "float" proves nothing.
        """
        return Limit(*self._detector.limit(x_t0, x_t1))

    def state(self) -> State:
        """Returns the state on which later steps rest. The state can be kept and compared."""
        return State(self._detector.state())

    def restore(self, state: State) -> None:
        """Continues from this state. InputError: the state is of another mesh or culling."""
        if not isinstance(state, State):
            raise TypeError(f"a State is wanted, not {type(state).__name__}")
        self._detector.restore(state._saved)

    def reset(self) -> None:
        """Forgets the state. The next step is a new start."""
        self._detector.reset()


def vertex_face(
    x_t0: ArrayLike, x_t1: ArrayLike, *, arithmetic: str = "exact", separation: float = 0
) -> Contacts:
    """Tells whether and when vertices and faces first meet, exactly; about a microsecond a query.

    x_t0, x_t1: real numbers (k, 4, 3): the vertex and the three corners of the face, at both ends
    of the step. arithmetic: words of OPTIONS["arithmetic"]; only "exact" is exact. separation: if
    above 0, tells whether and when the two come within this distance, exactly. ValueError: another
    shape or word, a coordinate that is not finite, a separation that is no length.
    """
    return Contacts(*_detector.vertex_face(x_t0, x_t1, *_question(arithmetic, separation)))


def edge_edge(
    x_t0: ArrayLike, x_t1: ArrayLike, *, arithmetic: str = "exact", separation: float = 0
) -> Contacts:
    """Does the same for two edges. (k, 4, 3): the end points of one edge, then of the other."""
    return Contacts(*_detector.edge_edge(x_t0, x_t1, *_question(arithmetic, separation)))


def _question(arithmetic: str, separation: float) -> Tuple[str, float]:
    if not (math.isfinite(separation) and separation >= 0):
        raise ValueError("separation: a length is wanted, finite and not below 0")
    if separation > 0 and arithmetic != "exact":
        raise ValueError("separation: a distance needs exact arithmetic")
    return arithmetic, separation


def contact_places(result: Union[StepResult, Judgement]) -> ContactPlaces:
    """Returns where the pairs of a result meet. The contacts of a CheckedStep have their places."""
    mesh = arrays.triangles(result.triangles, "triangles")
    x_t0, x_t1 = arrays.positions(result.x_t0, "x_t0"), arrays.positions(result.x_t1, "x_t1")
    return ContactPlaces(
        *_detector.contact_places(mesh, x_t0, x_t1, result.pairs, result.times, result.features)
    )
