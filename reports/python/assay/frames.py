"""Frames of one mesh, from files or arrays."""

from __future__ import annotations

import glob
import os
import re
from dataclasses import dataclass, field
from typing import Iterable, List, Sequence, Union

import numpy as np

from .results import Float64Array, Int32Array

Path = Union[str, "os.PathLike[str]"]

# What the project's own readers take, to the last bit; all else is meshio's.
_OWN = re.compile(r"\.(obj|ply|off)(\.gz)?$", re.IGNORECASE)
_NO_SURFACE = {"vertex", "line", "line3"}


@dataclass(frozen=True, eq=False, repr=False)
class Frames:
    """One mesh that deforms; consecutive frames are the ends of a step.

    triangles: int32 (m, 3); positions: a list of float64 (n, 3), one a frame; files: where from.
    """

    triangles: Int32Array
    positions: List[Float64Array]
    files: List[str] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<assay.Frames: {len(self)} frames of {len(self.triangles)} triangles>"


def read_frames(paths: Union[Path, Iterable[Path]]) -> Frames:
    """The frames in these files, in this order, a file each.

    paths: names of files, or patterns such as "sim_*.vtu", whose matches are put in order by their
    numbers: sim_2 before sim_10. OBJ, PLY and OFF (.gz too) are read by Assay's own readers, which
    keep every bit; others by meshio.

    FileNotFoundError: no such file. ValueError: a file that is none of its format, that has no
    triangles, or not those of the first.
    """
    files = _expanded([paths] if isinstance(paths, (str, os.PathLike)) else paths)
    if not files:
        raise ValueError("there are no frames")
    if all(_OWN.search(file) for file in files):
        return _own(files)
    parts = [_own([file]) if _OWN.search(file) else _by_meshio(file) for file in files]
    first = parts[0]
    for file, part in zip(files, parts):
        if not np.array_equal(part.triangles, first.triangles):
            raise ValueError(f"{file}: not the triangles of {files[0]}")
        if len(part.positions[0]) != len(first.positions[0]):
            raise ValueError(f"{file}: not as many vertices as {files[0]}")
    return Frames(first.triangles, [part.positions[0] for part in parts], files)


def as_frames(given) -> Frames:
    """Frames as they are; else a pair of triangles and positions, frames by n by 3."""
    if isinstance(given, Frames):
        return given
    try:
        triangles, positions = given
    except (TypeError, ValueError):
        raise TypeError("Frames are wanted, or a pair of triangles and positions") from None
    return Frames(triangles, list(positions))


def _expanded(paths: Iterable[Path]) -> List[str]:
    files: List[str] = []
    for path in map(os.fspath, paths):
        if os.path.exists(path):
            files.append(path)
            continue
        found = sorted(glob.glob(path), key=_by_numbers)
        if not found:
            raise FileNotFoundError(f"{path}: no such file")
        files += found
    return files


def _by_numbers(name: str) -> Sequence[Union[str, int]]:
    return [int(part) if part.isdigit() else part for part in re.split(r"([0-9]+)", name)]


def _own(files: List[str]) -> Frames:
    from . import _judge

    triangles, positions = _judge.read_sequence(files)
    return Frames(triangles, positions, files)


def _by_meshio(file: str) -> Frames:
    import meshio

    try:
        mesh = meshio.read(file)
    except (meshio.ReadError, OSError, KeyError, SystemExit) as error:
        raise ValueError(f"{file}: {error or 'meshio cannot read it'}") from None
    triangles = [block.data for block in mesh.cells if block.type == "triangle"]
    others = {block.type for block in mesh.cells} - {"triangle"} - _NO_SURFACE
    if others or not triangles:
        what = ", ".join(sorted(others)) or "no triangles"
        raise ValueError(f"{file}: it holds {what}: a mesh of triangles alone is wanted")
    if mesh.points.ndim != 2 or mesh.points.shape[1] != 3:
        raise ValueError(f"{file}: points of three coordinates are wanted")
    corners = np.ascontiguousarray(np.concatenate(triangles), np.int32)
    return Frames(corners, [np.ascontiguousarray(mesh.points, np.float64)], [file])
