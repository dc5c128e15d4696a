"""Frames of one mesh, from files or from arrays."""

from __future__ import annotations

import glob
import os
import re
import warnings
from dataclasses import dataclass, field
from typing import Iterable, List, Tuple, Union

import numpy as np

from .results import Float64Array, Int32Array

Path = Union[str, "os.PathLike[str]"]

# Files that the project's own readers read, to the last bit. meshio reads all other files.
_OWN = re.compile(r"\.(obj|ply|off)(\.gz)?$", re.IGNORECASE)
_NO_SURFACE = {"vertex", "line", "line3"}


@dataclass(frozen=True, eq=False, repr=False)
class Frames:
    """One mesh that deforms. Two consecutive frames are the start and the end of a step.

    triangles: int32 (m, 3); positions: a list of float64 (n, 3), one a frame; files: the sources.
    """

    triangles: Int32Array
    positions: List[Float64Array]
    files: List[str] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<assay.Frames: {len(self)} frames of {len(self.triangles)} triangles>"


def read_frames(paths: Union[Path, Iterable[Path]]) -> Frames:
    """Reads frames, one from each file.

    paths: names of files, or patterns such as "sim_*.vtu". The matches of a pattern are sorted by
    their numbers: sim_2 before sim_10. Files in the order of a shell (sim_1, sim_10, sim_2) are
    sorted too; any other order is kept. Assay's own readers read OBJ, PLY and OFF (.gz too), and
    keep every bit; meshio reads other formats. A warning tells what was sorted, changed or skipped.

    FileNotFoundError: no such file. ValueError: a file that is not in its format, that has no
    triangles, or whose triangles differ from the triangles of the first file.
    """
    from . import _judge

    files = _expanded([paths] if isinstance(paths, (str, os.PathLike)) else paths)
    if not files:
        raise ValueError("there are no frames")
    files, remarks = _judge.in_order_of_numbers(files)
    if all(_OWN.search(file) for file in files):
        parts = [_own(files)]
    else:
        parts = [_own([file]) if _OWN.search(file) else _by_meshio(file) for file in files]
    for line in dict.fromkeys([*remarks, *parts[0][1]]):
        warnings.warn(line, stacklevel=2)
    first = parts[0][0]
    if len(parts) == 1:
        return first
    for file, (part, _) in zip(files, parts):
        if not np.array_equal(part.triangles, first.triangles):
            raise ValueError(f"{file}: its triangles differ from the triangles of {files[0]}")
        if len(part.positions[0]) != len(first.positions[0]):
            raise ValueError(f"{file}: it has more or fewer vertices than {files[0]}")
    return Frames(first.triangles, [part.positions[0] for part, _ in parts], files)


def as_frames(given) -> Frames:
    """Returns Frames as they are, or Frames of a pair: triangles, and positions (frames, n, 3)."""
    if isinstance(given, Frames):
        return given
    try:
        triangles, positions = given
        if isinstance(triangles, (str, os.PathLike)):
            raise TypeError
    except (TypeError, ValueError):
        raise TypeError("Frames are wanted, as of assay.read_frames(files), or a pair of triangles and positions") from None
    positions = list(positions)
    if positions and np.ndim(positions[0]) == 1:
        raise ValueError("first triangles (m, 3), then a list of frames, even of a single one: (triangles, [x0])")
    return Frames(triangles, positions)


def _expanded(paths: Iterable[Path]) -> List[str]:
    from . import _judge

    files: List[str] = []
    for path in map(os.fspath, paths):
        names = [path] if os.path.exists(path) else sorted(glob.glob(path))
        if not names:
            raise FileNotFoundError(f"{path}: no such file")
        files += _judge.in_order_of_numbers(names)[0]
    return files


_Read = Tuple[Frames, List[str]]  # the frames, and remarks on them


def _own(files: List[str]) -> _Read:
    from . import _judge

    triangles, positions, remarks = _judge.read_sequence(files)
    return Frames(triangles, positions, files), remarks


def _by_meshio(file: str) -> _Read:
    import meshio

    try:
        mesh = meshio.read(file)
    except (Exception, SystemExit) as error:  # on a torn file meshio raises any exception
        raise ValueError(f"{file}: meshio cannot read it: {error or type(error).__name__}") from None
    triangles = [block.data for block in mesh.cells if block.type == "triangle"]
    others = {block.type for block in mesh.cells} - {"triangle"} - _NO_SURFACE
    if others or not triangles:
        what = ", ".join(sorted(others)) or "no triangles"
        raise ValueError(f"{file}: it holds {what}: a mesh of only triangles is wanted")
    if mesh.points.ndim != 2 or mesh.points.shape[1] != 3:
        raise ValueError(f"{file}: points of three coordinates are wanted")
    corners = np.ascontiguousarray(np.concatenate(triangles), np.int32)
    skipped = [block for block in mesh.cells if block.type in _NO_SURFACE]
    remarks = [f"not looked at: {len(block.data)} cells of type {block.type}" for block in skipped]
    if file.lower().endswith(".stl"):
        remarks.append("meshio merges equal corners of an STL file into one vertex")
    return Frames(corners, [np.ascontiguousarray(mesh.points, np.float64)], [file]), remarks
