"""Lets the oracle judge meshes and the steps of a detector."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from operator import index
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union, overload

from numpy.typing import ArrayLike

from .frames import Frames, as_frames
from .plugin import detector_word, surroundings
from .places import program
from .progress import Progress, listener
from .results import Judgement

Interval = Tuple[float, float]


@dataclass(frozen=True)
class Contact:
    """A pair of triangles, the first time of their contact, and the features that meet then.

    time: (lo, hi). feature: "vertex-face", ..., with its vertices in that order. bodies: for each
    triangle its body and its number there; None without bodies. The rest is only for contacts of a
    CheckedStep. meeting: "touching" or "crossing". crosses_at_end: whether the triangles cross at
    t = 1 (None at rest). point (3,), barycentric (2, 3), error, normal (3,): as in ContactPlaces.
    """

    triangles: Tuple[int, int]
    time: Interval
    feature: str
    vertices: Tuple[int, ...]
    bodies: Optional[Tuple[Tuple[int, int], Tuple[int, int]]] = None
    meeting: Optional[str] = None
    crosses_at_end: Optional[bool] = None
    point: Optional[List[float]] = None
    barycentric: Optional[List[List[float]]] = None
    error: Optional[float] = None
    normal: Optional[List[float]] = None


@dataclass(frozen=True)
class WrongTime:
    """A pair for which the detector's first time is wrong. bodies: as in Contact."""

    triangles: Tuple[int, int]
    detector: Interval
    oracle: Interval
    bodies: Optional[Tuple[Tuple[int, int], Tuple[int, int]]] = None


@dataclass(frozen=True)
class StepDiff:
    """How the detector's answer to a step differs from the oracle's answer.

    outcome: "holds", "defect", "undecided" or "error"; broken: the claims that the step breaks.
    missing, excused, spurious: pairs. An excused pair is missing, but no claim promises it.
    late, early: pairs with a wrong time. A late time is unsafe.
    """

    outcome: str
    broken: Tuple[str, ...]
    partial: bool
    wrong_answer: bool
    wrong_first_time: bool
    missing: Tuple[Contact, ...] = field(repr=False)
    excused: Tuple[Contact, ...] = field(repr=False)
    spurious: Tuple[Contact, ...] = field(repr=False)
    late: Tuple[WrongTime, ...] = field(repr=False)
    early: Tuple[WrongTime, ...] = field(repr=False)
    left_out: int
    left_out_missed: bool


@dataclass(frozen=True)
class CheckedStep:
    """A step: answers and first times of detector and oracle, and the diff (None without oracle).

    contacts: the pairs in contact, by the oracle; repr() does not show them.
    """

    answer: str
    first: Optional[Interval]
    oracle_answer: Optional[str]
    oracle_first: Optional[Interval]
    diff: Optional[StepDiff]
    contacts: Tuple[Contact, ...] = field(default=(), repr=False)


class _Report:
    outcome: str
    steps: Sequence[Any]
    text: str

    def __repr__(self) -> str:
        return f"<assay.{type(self).__name__}: {self.outcome}, {len(self.steps)} steps>"

    def __str__(self) -> str:
        return self.text

    def __bool__(self) -> bool:
        raise TypeError("a report has no truth value: compare its member .outcome with a word")


@dataclass(frozen=True, repr=False)
class CheckReport(_Report):
    """The report of `assay check` about the steps of a mesh.

    outcome: "holds", "defect", "undecided"; steps: a CheckedStep each; text: the printed text;
    json: the report of `--json` (assay-check/1, reports/README.md); code: the exit code.
    """

    outcome: str
    steps: Tuple[CheckedStep, ...]
    text: str
    json: Dict[str, Any]
    code: int


@dataclass(frozen=True)
class LeastDistance:
    """How near two triangles that share no vertex come during a step.

    distance: the least double within which two triangles come; 0 if two touch. contact: the first
    pair, by its triangles, that comes within this distance, with its first time and features.
    """

    distance: float
    contact: Contact


@dataclass(frozen=True)
class SeparationStep:
    """A step: which pairs come within the separation, when first, and the least distance of all.

    answer: "near", "apart" or "undecided"; first: None unless near; near_at_start: the number of
    pairs that are near at t = 0; pairs: each with its first time within the separation; least: None
    if no two triangles count, or if a limit was reached.
    """

    answer: str
    first: Optional[Interval]
    near_at_start: int
    pairs: Tuple[Contact, ...] = field(repr=False)
    least: Optional[LeastDistance]


@dataclass(frozen=True, repr=False)
class SeparationReport(_Report):
    """The report of `assay check --separation` about the steps of a mesh.

    outcome: "near", "apart", "undecided"; least_distance: the least of all steps, None if no two
    triangles count; steps: a SeparationStep each; text, json, code: as in CheckReport.
    """

    outcome: str
    separation: float
    least_distance: Optional[float]
    steps: Tuple[SeparationStep, ...]
    text: str
    json: Dict[str, Any]
    code: int


def judge(
    triangles: ArrayLike,
    x_t0: ArrayLike,
    x_t1: Optional[ArrayLike] = None,
    *,
    separation: Union[float, Tuple[float, float]] = 0,
    jobs: Optional[int] = None,
) -> Judgement:
    """Returns the oracle's answer to a step: all pairs in contact, by exact arithmetic.

    Without x_t1 the mesh is at rest: "collision" means that the mesh meets itself.
    separation: if above 0, finds all pairs of triangles that share no vertex and come within this
    distance, each with the first time at which they do; "collision" means that there is a pair. A
    tuple of two doubles means their exact sum. jobs: threads; None: all cores. Arrays and errors:
    as in Detector. Ctrl-C ends the call. Only check() has options that say which pairs count.
    """
    from . import _judge

    length, rest = separation if isinstance(separation, tuple) else (separation, 0.0)
    within = (length, rest) if _length(length + rest) > 0 and _length(length) > 0 else None
    x_t1 = x_t0 if x_t1 is None else x_t1
    answer = _judge.judge(triangles, x_t0, x_t1, within, _jobs(jobs))
    return Judgement(**answer, triangles=triangles, x_t0=x_t0, x_t1=x_t1)


def _length(separation: float) -> float:
    if not (math.isfinite(separation) and separation >= 0):
        raise ValueError("separation: a length is wanted, finite and not below 0")
    return separation


def first_time_within(
    triangles: ArrayLike,
    x_t0: ArrayLike,
    x_t1: ArrayLike,
    separation: float,
    *,
    jobs: Optional[int] = None,
) -> Optional[Interval]:
    """Returns when two triangles that share no vertex first come within a distance; None: never.

    separation: a length in units of the positions. Other arguments are those of judge(). The two
    doubles of the interval are the time, or are adjacent and have the time between them.
    """
    from . import _judge

    first: Optional[Interval] = _judge.judge(
        triangles, x_t0, x_t1, (_length(separation), 0.0), _jobs(jobs)
    )["first"]
    return first


def least_distance(
    triangles: ArrayLike, x_t0: ArrayLike, x_t1: ArrayLike, *, jobs: Optional[int] = None
) -> Optional[LeastDistance]:
    """Returns the least distance over a step, exactly; None if every two triangles share a vertex.

    Arguments are those of judge(). x_t1 is required; for a mesh at rest it is x_t0.
    """
    from . import _judge

    found = _judge.least_distance(triangles, x_t0, x_t1, _jobs(jobs))
    return found and LeastDistance(found[0], Contact(*found[1:]))


@overload
def check(
    frames: Any, detector: Any = None, *, separation: None = None, **options: Any
) -> CheckReport: ...
@overload
def check(frames: Any, *, separation: float, **options: Any) -> SeparationReport: ...
def check(
    frames: Any,
    detector: Any = None,
    *,
    separation: Optional[float] = None,
    culling: Optional[str] = None,
    start: Optional[str] = None,
    pairs: Optional[str] = None,
    arithmetic: Optional[str] = None,
    jobs: Optional[int] = None,
    threads: int = 0,
    time: Optional[float] = None,
    memory: Optional[str] = None,
    isolation: Optional[str] = None,
    bodies: Optional[ArrayLike] = None,
    apart: Sequence[Tuple[int, int]] = (),
    rings: int = 0,
    rest_distance: float = 0,
    weld: bool = False,
    progress: Progress = None,
) -> Union[CheckReport, SeparationReport]:
    """Runs `assay check`: detector and oracle answer each step, and their answers are compared.

    frames: Frames, a pair of triangles (m, 3) and positions (frames, n, 3), or the name of a case
    file; a single frame is a mesh at rest. detector: None for the built-in detector, the name of a
    plug-in's library, "python:MODULE:CLASS", or a class, which another process imports by its
    module. culling, start, pairs, arithmetic: for the built-in detector. jobs: threads of the
    oracle. threads: of the detector; 0: 1 for a plug-in, else all cores. time: seconds. memory
    ("6GB"), isolation: as on the command line. progress: a function for printed text; True: stderr.
    bodies: integers (n,), the body of each vertex, from 0 on. apart: pairs of bodies that do not
    meet, or a body paired with itself. rings: pairs of triangles that a path of fewer edges joins
    do not count (1: those that share a vertex). rest_distance: pairs nearer than this length in the
    first frame do not count. weld: vertices of a body that are at one place in every frame count as
    one vertex. A case file takes none of these options, because it states what counts.
    separation: if given, no detector runs; the oracle says which triangles that share no vertex
    come within this distance, when first, and how near any two come, in a SeparationReport.

    ValueError: input that is refused; the message says why. Ctrl-C ends the call; a plug-in's
    process ends with its step, or at `time`. For a slow class, `time` is a limit in seconds, and
    `progress=True` shows each step as it is judged.
    """
    from . import _judge, hosting

    if detector is not None and (culling or start or pairs or arithmetic):
        raise ValueError("culling, start, pairs and arithmetic are options of the built-in detector")
    of_a_detector = detector is not None or culling or start or pairs or arithmetic
    if separation is not None and of_a_detector:
        raise ValueError("only the oracle answers a separation: leave out detector, culling, start, pairs and arithmetic")
    asked = {
        "separation": None if separation is None else _length(separation),
        "culling": culling,
        "start": start,
        "pairs": pairs,
        "arithmetic": arithmetic,
        "detector": detector_word(detector) if detector is not None else None,
        "jobs": _jobs(jobs),
        "threads": index(threads),
        "time": None if time is None else float(time),
        "memory": memory,
        "isolation": isolation,
        "bodies": None if bodies is None else hosting.int32_of(bodies, "bodies").tolist(),
        "apart": hosting.pairs_of(list(apart)).tolist(),
        "rings": index(rings),
        "rest_distance": float(rest_distance),
        "weld": weld,
    }
    told = listener(progress)
    worker = str(program("assay-worker")) if detector is not None else ""
    with surroundings(detector):
        if isinstance(frames, (str, os.PathLike)):
            if bodies is not None or apart or rings or rest_distance or weld:
                raise ValueError("a case file states which pairs count: bodies, apart, rings, rest_distance and weld are for meshes")
            if "*" in os.fspath(frames):
                raise ValueError(f"{frames}: a pattern is for assay.read_frames")
            answer = _judge.check_files([os.fspath(frames)], asked, worker, told)
        else:
            mesh: Frames = as_frames(frames)
            asked["files"] = mesh.files
            answer = _judge.check_arrays(mesh.triangles, mesh.positions, asked, worker, told)
    return _report(*answer) if separation is None else _separation_report(*answer)


def _jobs(jobs: Optional[int]) -> int:
    jobs = len(os.sched_getaffinity(0)) if jobs is None else index(jobs)
    if not 1 <= jobs <= 1024:
        raise ValueError("jobs: 1 to 1024 are wanted")
    return jobs


def _separation_report(text: str, printed: str, code: int) -> SeparationReport:
    report = json.loads(text)
    steps = tuple(map(_separation_step, report["steps"]))
    known = (report["outcome"], report["separation"], report["least_distance"])
    return SeparationReport(*known, steps, printed, report, code)


def _report(text: str, printed: str, code: int) -> CheckReport:
    report = json.loads(text)
    return CheckReport(report["outcome"], tuple(map(_step, report["steps"])), printed, report, code)


def _step(raw: Dict[str, Any]) -> CheckedStep:
    oracle = raw["oracle"] or {"answer": None, "first_time": None}
    return CheckedStep(
        raw["answer"],
        _interval(raw["first_time"]),
        oracle["answer"],
        _interval(oracle["first_time"]),
        _diff(raw["diff"]) if raw["diff"] else None,
        tuple(map(_contact, raw.get("contacts", ()))),
    )


def _separation_step(raw: Dict[str, Any]) -> SeparationStep:
    least = raw["least_at"] and LeastDistance(raw["least_distance"], _contact(raw["least_at"]))
    pairs = tuple(map(_contact, raw["pairs"]))
    return SeparationStep(
        raw["answer"], _interval(raw["first_time"]), raw["near_at_start"], pairs, least
    )


def _diff(raw: Dict[str, Any]) -> StepDiff:
    fields = {name: raw[name] for name in StepDiff.__dataclass_fields__}
    fields["broken"] = tuple(raw["broken"])
    for name in ("missing", "excused", "spurious"):
        fields[name] = tuple(map(_contact, raw[name]))
    for name in ("late", "early"):
        fields[name] = tuple(map(_wrong_time, raw[name]))
    return StepDiff(**fields)


def _contact(raw: Dict[str, Any]) -> Contact:
    place = ("meeting", "crosses_at_end", "point", "barycentric", "error", "normal")
    known = (tuple(raw["triangles"]), tuple(raw["time"]), raw["feature"], tuple(raw["vertices"]))
    return Contact(*known, _bodies(raw), **{name: raw.get(name) for name in place})


def _wrong_time(raw: Dict[str, Any]) -> WrongTime:
    times = (tuple(raw["detector"]), tuple(raw["oracle"]))
    return WrongTime(tuple(raw["triangles"]), *times, _bodies(raw))


def _bodies(raw: Dict[str, Any]) -> Any:
    bodies = raw.get("bodies")
    return bodies and tuple((of["body"], of["triangle"]) for of in bodies)


def _interval(raw: Optional[List[float]]) -> Optional[Interval]:
    return (raw[0], raw[1]) if raw else None
