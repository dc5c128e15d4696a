"""Writes results for ParaView."""

import os
from typing import Union

import numpy as np

from .arrays import positions, triangles
from .detector import contact_places
from .errors import InputError
from .results import DIRTY, VIOLATED, Judgement, StepResult


def write_vtk(result: Union[StepResult, Judgement], path: Union[str, "os.PathLike[str]"]) -> None:
    """Writes the step of a result as an unstructured grid, by meshio: .vtu or .vtk.

    Points are the vertices of the mesh at the first contact time (at t = 0 without a contact), then
    the place where each pair meets. A pair without a place is left out. Cells are the triangles,
    then a vertex for each place.
    Fields of points: displacement (x_t1 - x_t0; 0 at places of contact).
    Fields of cells: is_contact, in_contact, first_time (NaN: no contact), pair_a and pair_b (-1 for
    triangles); for a result of the detector also view_sign (2: none), violated, dirty.
    """
    import meshio

    if not isinstance(result, (StepResult, Judgement)):
        raise TypeError(f"result: a StepResult or a Judgement is wanted, not {type(result).__name__}")
    if os.path.splitext(os.fspath(path))[1] not in (".vtu", ".vtk"):
        raise InputError(f"{os.fspath(path)}: the name has to end with .vtu or .vtk", "unknown_ending")
    mesh = triangles(result.triangles, "triangles")
    x_t0, x_t1 = positions(result.x_t0, "x_t0"), positions(result.x_t1, "x_t1")
    places = contact_places(result).point
    shown = np.isfinite(places).all(axis=1)
    pairs, times, places = result.pairs[shown], result.times[shown, 0], places[shown]

    count, contacts = len(mesh), len(places)
    t = result.first[0] if result.first else 0.0
    points = np.vstack([(1 - t) * x_t0 + t * x_t1, places])
    moved = np.vstack([x_t1 - x_t0, np.zeros((contacts, 3))])
    first = np.full(count, np.nan)
    for column in result.pairs.T:
        np.fmin.at(first, column, result.times[:, 0])
    blank = np.zeros(contacts, np.int32)
    fields = {
        "is_contact": (np.zeros(count, np.int32), blank + 1),
        "in_contact": (np.isfinite(first).astype(np.int32), blank + 1),
        "first_time": (first, times),
        "pair_a": (np.full(count, -1, np.int32), pairs[:, 0].astype(np.int32)),
        "pair_b": (np.full(count, -1, np.int32), pairs[:, 1].astype(np.int32)),
    }
    if isinstance(result, StepResult):
        seen = len(result.signs) >= count
        signs = result.signs[:count].astype(np.int32) if seen else np.full(count, 2, np.int32)
        doubts = result.doubts if len(result.doubts) == count else np.zeros(count, np.uint8)
        fields["view_sign"] = (signs, blank + 2)
        fields["violated"] = ((doubts & VIOLATED != 0).astype(np.int32), blank)
        fields["dirty"] = ((doubts & DIRTY != 0).astype(np.int32), blank)
    cells = [("triangle", mesh)]
    if contacts:
        cells.append(("vertex", len(x_t0) + np.arange(contacts)[:, None]))
    meshio.write(
        os.fspath(path),
        meshio.Mesh(
            points,
            cells,
            point_data={"displacement": moved},
            cell_data={name: list(parts[: len(cells)]) for name, parts in fields.items()},
        ),
    )
