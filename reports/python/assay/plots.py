"""Draws errors beside times with matplotlib."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

from .programs import Outcome

_PANELS = {
    "answered_free": "a contact, answered free",
    "false_alarms": "no contact, answered collision",
}


def plot(*outcomes: Outcome) -> Any:
    """Draws errors beside times of detectors that run() or certify() judged: a matplotlib Figure.

    A point is a family of cases: the detector's processor time for a step, and the share of the
    steps with this error, with its interval of 95 %. Each outcome has its own colour.

    ImportError: there is no matplotlib. ValueError: an outcome has no counts of errors.
    """
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("assay.plot needs matplotlib (Debian: python3-matplotlib)") from None
    rows = [_points(outcome) for outcome in outcomes]
    if not rows:
        raise ValueError("plot: name an outcome of run() or certify()")
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for panel, (error, title) in zip(axes, _PANELS.items()):
        for name, points in rows:
            known = [(time, error_of[error]) for time, error_of in points if error_of[error]["in"]]
            times = [time for time, _ in known]
            shares = [100 * e["share"] for _, e in known]
            below = [100 * (e["share"] - e["interval"][0]) for _, e in known]
            above = [100 * (e["interval"][1] - e["share"]) for _, e in known]
            panel.errorbar(times, shares, [below, above], fmt="o", label=name)
        panel.set(title=title, xlabel="time of a step, ms", ylabel="% of such steps", xscale="log")
        panel.set_ylim(bottom=0)
        panel.grid(alpha=0.3)
    axes[0].legend()
    return figure


def _points(outcome: Outcome) -> Tuple[str, List[Tuple[float, Dict[str, Any]]]]:
    findings = outcome._findings()
    used = {row["family"]: row["detector_us"] for row in findings["times"]["strata"]}
    # The elementary query of a detector has no steps.
    judged = [s for s in findings["strata"] if s["steps"] and s["measures"] is not None]
    if not judged:
        raise ValueError("plot: errors are counted only for a detector of yours that answers steps")
    points = [(used[s["family"]] / s["steps"] / 1000, s["measures"]) for s in judged]
    return findings["detector"]["name"], points
