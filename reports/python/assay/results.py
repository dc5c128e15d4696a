"""The results of a step and of a judgement. Each result has arrays of its own.

Triangles are numbered as the rows of the mesh. Times are shares of the step, in [0, 1]. A time is a
pair of doubles: twice the time if it is a double, else the two adjacent doubles around it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

Int32Array = npt.NDArray[np.int32]
Float64Array = npt.NDArray[np.float64]

# Bits of StepResult.doubts.
VIOLATED, DIRTY = 1, 2

# By the first column of `features`. The others hold vertices, then -1: v f f f; two edges, a a b b; an
# edge that goes through a face at the start, e e f f f; the face that both triangles are, f f f.
FEATURE_KINDS = ("vertex_face", "edge_edge", "piercing", "same_vertices")


@dataclass(frozen=True)
class SearchCounts:
    box_tests: int
    child_counts: int
    skipped: int
    contour_tests: int
    candidate_pairs: int


@dataclass(frozen=True)
class MarkingCounts:
    changed: int
    marked: int
    cleared: int


@dataclass(frozen=True)
class NarrowCounts:
    """Elementary tests, and how many feature pairs each rung decided."""

    elementary_tests: int
    axis: int
    filter: int
    fixed: int
    unbounded: int
    open: int


@dataclass(frozen=True)
class ViewCounts:
    """How many view signs of triangles each rung decided."""

    lanes: int
    filter: int
    exact: int
    open: int


@dataclass(frozen=True)
class GhostCounts:
    box_tests: int
    pairs: int
    elementary_tests: int
    near_triangles: int


@dataclass(frozen=True)
class ReleaseCounts:
    in_doubt: int
    released: int
    pairs: int
    elementary_tests: int
    winding_numbers: int


@dataclass(frozen=True)
class StepCounts:
    """Counts of the work in a step. They do not depend on the machine."""

    search: SearchCounts
    marking: MarkingCounts
    narrow: NarrowCounts
    view: ViewCounts
    ghosts: GhostCounts
    release: ReleaseCounts
    closure_rounds: int
    winding_numbers: int
    free_components: int


@dataclass(frozen=True)
class StepTimes:
    """Milliseconds of the wall clock. They are not part of the answer."""

    view_test: float
    start: float
    ghosts: float
    broad_phase: float
    narrow_phase: float
    closure: float
    total: float


class _Step:
    """Shows the answer to a step in one line."""

    answer: str
    first: Optional[Tuple[float, float]]
    pairs: Int32Array

    def __repr__(self) -> str:
        found = "" if self.first is None else f", first {self.first}, {len(self.pairs)} pairs"
        return f"<assay.{type(self).__name__}: {self.answer}{found}>"


@dataclass(frozen=True, eq=False, repr=False)
class StepResult(_Step):
    """The detector's answer to a step.

    answer: "free" or "collision".
    first: (lo, hi), the first contact time; None without a collision.
    pairs: int32 (k, 2), triangles in contact, ascending; times: float64 (k, 2), their first times.
    features: int32 (k, 6): kind (of FEATURE_KINDS), its vertices (v, face; edge, edge), then -1.
    view_positive, view_negative, view_zero, against_all, violated, dirty: sizes of the view sets.
    views: whether the step used views, or else why not.
    signs: int8 (m + ghosts,), view signs of the triangles, then of the ghosts; empty without views.
    doubts: uint8 (m,), VIOLATED and DIRTY; empty without views.
    triangles, x_t0, x_t1: the arguments of the call, not copied.
    """

    answer: str
    first: Optional[Tuple[float, float]]
    pairs: Int32Array
    times: Float64Array
    features: Int32Array
    view_positive: int
    view_negative: int
    view_zero: int
    against_all: int
    violated: int
    dirty: int
    views: str
    signs: npt.NDArray[np.int8]
    doubts: npt.NDArray[np.uint8]
    counts: StepCounts
    milliseconds: StepTimes
    triangles: Any
    x_t0: Any
    x_t1: Any

    def __bool__(self) -> bool:
        raise TypeError("a result has no truth value: compare its member .answer with 'free' or 'collision'")


def step_result(raw: Mapping[str, Any], triangles: Any, x_t0: Any, x_t1: Any) -> StepResult:
    """Makes a StepResult of the fields that the extension module returns."""
    fields = dict(raw, triangles=triangles, x_t0=x_t0, x_t1=x_t1)
    fields["milliseconds"] = StepTimes(*raw["milliseconds"])
    kinds: Any = dict(search=SearchCounts, marking=MarkingCounts, narrow=NarrowCounts)
    kinds.update(view=ViewCounts, ghosts=GhostCounts, release=ReleaseCounts)
    counts = {name: kinds[name](*c) if name in kinds else c for name, c in raw["counts"].items()}
    fields["counts"] = StepCounts(**counts)
    return StepResult(**fields)


@dataclass(frozen=True, eq=False, repr=False)
class Limit:
    """How far a caller may go in a step.

    share: of the step, 0 (stay) to 1 (whole); positions: float64 (n, 3), where the caller stops.
    first: (lo, hi), the first contact time of the whole step; None if there is no contact.
    is_short: whether less than 0.93 of the first contact time is taken, because rounding brought
    every farther place that was tried into contact.
    """

    share: float
    positions: Float64Array
    first: Optional[Tuple[float, float]]
    is_short: bool

    def __repr__(self) -> str:
        return f"<assay.Limit: {self.share} of the step, first {self.first}>"


@dataclass(frozen=True, eq=False, repr=False)
class Contacts:
    """Answers to k elementary queries.

    hit: bool (k,), whether the two features meet; lo, hi: float64 (k,), first time, NaN if not.
    """

    hit: npt.NDArray[np.bool_]
    lo: Float64Array
    hi: Float64Array

    def __repr__(self) -> str:
        return f"<assay.Contacts: {np.count_nonzero(self.hit)} of {len(self.hit)} meet>"


@dataclass(frozen=True, eq=False, repr=False)
class ContactPlaces:
    """Where k pairs meet, each at the lower end of its first time; midway, with a separation.

    point: float64 (k, 3); barycentric: float64 (k, 2, 3), weights of the point in both triangles.
    error: float64 (k,), bounds how far a coordinate of the point is from the weighted corners.
    normal: float64 (k, 3), a unit vector: of a face, on the side from which its corners are
    counter-clockwise; of two edges, along (a1 - a0) x (b1 - b0); NaN if there is no normal.
    normal_error: float64 (k,), bounds how far a coordinate of the normal is off.
    A pair whose features have no names has only NaN. Lengths are in units of the positions.
    """

    point: Float64Array
    barycentric: Float64Array
    error: Float64Array
    normal: Float64Array
    normal_error: Float64Array

    def __repr__(self) -> str:
        return f"<assay.ContactPlaces: {len(self.point)} pairs>"


@dataclass(frozen=True, eq=False, repr=False)
class Judgement(_Step):
    """The oracle's answer; fields as in StepResult. feature_candidates: feature pairs tested."""

    answer: str
    first: Optional[Tuple[float, float]]
    pairs: Int32Array
    times: Float64Array
    features: Int32Array
    feature_candidates: int
    triangles: Any
    x_t0: Any
    x_t1: Any

    def __bool__(self) -> bool:
        raise TypeError("a judgement has no truth value: compare its member .answer with 'free' or 'collision'")
