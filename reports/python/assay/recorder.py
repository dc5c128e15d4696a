"""Records what a simulator does, for `assay check`."""

from __future__ import annotations

import os
from typing import Any, Dict, Iterable, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike

from . import _recorder, arrays, hosting

UNTOLD = object()  # in place of an answer: there is none


class Recorder:
    """A log of a simulator's steps and of what its own collision detector answered.

    path: the file. triangles: integers (m, 3). positions: real numbers (n, 3), those that the
    detector was made from. name, version, claims, contract: of that detector, in the words of a
    detector in Python (assay/hosting.py); without claims there is nothing that `assay check` could
    judge. bodies: (n,) the number of each vertex's body, from 0 on; apart: pairs of bodies that
    do not meet, or a body paired with itself. rings, rest_distance: pairs that do not count, as of
    assay.check; at rest the mesh is at `positions`.

    every: with 10, one step in ten is recorded. overwrite: whether an existing file may be lost.

    Arrays of float32 are recorded as float32, others as float64 where that is exact; positions that
    are not finite are recorded too, and an answer that can be none, as a time outside of [0, 1], is
    refused. Calls write at once: a process that is killed loses at most the record that it was
    writing. A recorder is of one thread at a time.

    ValueError: an argument that is refused; TypeError: no numbers; FileExistsError, OSError: a file
    that is there, or cannot be written. After ValueError and TypeError nothing is written; an
    OSError of a step ends the log, so that each later call fails too.
    """

    def __init__(
        self,
        path: Union[str, "os.PathLike[str]"],
        triangles: ArrayLike,
        positions: ArrayLike,
        *,
        name: str,
        version: str = "0",
        claims: Iterable[str] = (),
        contract: Optional[Dict[str, Any]] = None,
        every: int = 1,
        overwrite: bool = False,
        bodies: Optional[ArrayLike] = None,
        apart: Sequence[Tuple[int, int]] = (),
        rings: int = 0,
        rest_distance: float = 0,
    ):
        if every < 0:
            raise ValueError("every: a number of steps is wanted")
        rest = _frame(positions, "positions", True)
        self._vertices = len(rest)
        body = None if bodies is None else hosting.int32_of(bodies, "bodies")
        if body is not None and body.shape != (self._vertices,):
            raise ValueError(f"bodies: shape {body.shape} is not ({self._vertices},)")
        self._recorder = _recorder.Recorder(
            os.fsencode(path),
            (np.ascontiguousarray(arrays.triangles(triangles, "triangles")), rest),
            (name, version),
            hosting.described(claims, contract or {}, _recorder.CLAIMS, _recorder.MEMBERS),
            every,
            overwrite,
            (body, hosting.pairs_of(list(apart))),
            (rings, rest_distance, np.ascontiguousarray(rest, np.float64)),
        )

    def step(
        self,
        x0: Optional[ArrayLike] = None,
        x1: Optional[ArrayLike] = None,
        *,
        dx: Optional[ArrayLike] = None,
        committed: Optional[ArrayLike] = None,
        answer: Any = UNTOLD,
        first: Any = None,
        pairs: Optional[ArrayLike] = None,
        pair_times: Optional[ArrayLike] = None,
        message: Optional[str] = None,
        share: Optional[float] = None,
        positions: Optional[ArrayLike] = None,
    ) -> None:
        """Records the next step, real numbers (n, 3) each.

        x0: where it starts; None: where the last step ended, its `committed` or else its `x1`.
        x1 or dx: where it would go, or by how much. committed: where the simulator really went.
        answer: "free", "collision", "undecided" or "error"; first, pairs, pair_times: (lo, hi) or a
        number, (k, 2) triangles, their times (k, 2) or (k,); message: a line. Or answer is what a
        detector in Python answers, such as the result of assay.Detector, which has all of these.
        None is "free", as there; without it no answer is recorded. share, positions: how far a
        limiter let the step go.
        """
        told = None
        if answer is not UNTOLD:
            if isinstance(answer, str):
                answer = {"answer": answer, "first": first, "pairs": pairs, "times": pair_times}
            elif first is not None or pairs is not None or pair_times is not None:
                raise ValueError("first, pairs and pair_times: this answer states them itself")
            told = hosting.parts_of(answer, hosting.ANSWERS + ("error",))
        elif any(part is not None for part in (first, pairs, pair_times, message)):
            raise ValueError("first, pairs, pair_times and message need an answer")
        self._recorder.step(
            self._frame(x0, "x0"),
            self._frame(x1, "x1"),
            self._frame(dx, "dx"),
            self._frame(committed, "committed"),
            told,
            message,
            -1.0 if share is None else float(share),
            self._frame(positions, "positions", False),
        )

    def note(self, text: str) -> None:
        """Records a line of text before the next step."""
        self._recorder.note(text)

    def end(self) -> None:
        """Records how many steps there were, and closes the file."""
        self._recorder.end()

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(self, *_: object) -> None:
        if self._recorder.is_recording:
            self.end()

    def _frame(self, given: Optional[ArrayLike], name: str, may_be_float32: bool = True) -> Any:
        if given is None:
            return None
        frame = _frame(given, name, may_be_float32)
        if len(frame) != self._vertices:
            raise ValueError(f"{name}: shape {frame.shape} is not ({self._vertices}, 3)")
        return frame


def _frame(given: ArrayLike, name: str, may_be_float32: bool) -> npt.NDArray[Any]:
    """Adjacent rows of three numbers, of float32 if they are that already and may be."""
    if may_be_float32 and type(given) is np.ndarray and given.dtype == np.float32:
        if given.ndim == 2 and given.shape[1] == 3:
            return np.ascontiguousarray(given)
    return np.ascontiguousarray(arrays.positions(given, name))
