"""Assay: continuous self-collision detection of deforming triangle meshes, judged exactly.

    detector = assay.Detector(triangles, positions)
    result = detector.step(x_t0, x_t1)
    if result.answer == "collision":
        print(result.first, result.pairs)

reports/python/README.md has an example of everything.
"""

from typing import List

from ._detector import VERSION as __version__
from .detector import OPTIONS, Detector, State, contact_places, edge_edge, vertex_face
from .errors import AssayError, InputError
from .frames import Frames, read_frames
from .judging import (
    CheckedStep,
    CheckReport,
    Contact,
    LeastDistance,
    SeparationReport,
    SeparationStep,
    StepDiff,
    WrongTime,
    check,
    first_time_within,
    judge,
    least_distance,
)
from .hosting import BeyondCapacity, Refused
from .plots import plot
from .plugin import Plugin
from .programs import Failure, Outcome, Page, certify, replay, report, run
from .recorder import Recorder
from .results import (
    DIRTY,
    FEATURE_KINDS,
    VIOLATED,
    ContactPlaces,
    Contacts,
    Judgement,
    Limit,
    StepCounts,
    StepResult,
    StepTimes,
)
from .vtk import write_vtk

__all__ = [
    "AssayError",
    "BeyondCapacity",
    "CheckReport",
    "CheckedStep",
    "Contact",
    "ContactPlaces",
    "Contacts",
    "DIRTY",
    "Detector",
    "FEATURE_KINDS",
    "Failure",
    "Frames",
    "InputError",
    "Judgement",
    "LeastDistance",
    "Limit",
    "OPTIONS",
    "Outcome",
    "Page",
    "Plugin",
    "Recorder",
    "Refused",
    "SeparationReport",
    "SeparationStep",
    "State",
    "StepCounts",
    "StepDiff",
    "StepResult",
    "StepTimes",
    "VIOLATED",
    "WrongTime",
    "certify",
    "check",
    "contact_places",
    "edge_edge",
    "first_time_within",
    "judge",
    "least_distance",
    "plot",
    "read_frames",
    "replay",
    "report",
    "run",
    "vertex_face",
    "write_vtk",
]


def __dir__() -> List[str]:
    """Returns the names for users, without the modules of the package."""
    return [*__all__, "__version__", "__doc__", "__file__"]
