"""Records what a simulator does, for `assay check`."""

from __future__ import annotations

import os
from typing import Any, Dict, Iterable, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike

from . import _recorder, arrays, hosting

UNTOLD = object()  # stands for: there is no answer


class Recorder:
    """A log of a simulator's steps and of the answers of the simulator's own collision detector.

    path: the file. triangles: integers (m, 3). positions: real numbers (n, 3), from which the
    detector was made. name, version, claims, contract: of that detector, in the words of
    assay/hosting.py; without claims `assay check` can judge nothing. bodies: integers (n,), the
    body of each vertex, from 0 on. apart: pairs of bodies that do not meet, or a body paired with
    itself. rings, rest_distance: which pairs do not count, as in assay.check; at rest the mesh is
    at `positions`. every: 10 records one step in ten. overwrite: replaces an existing file.

    Arrays of float32 are recorded as float32, others as float64 where that is exact. Positions that
    are not finite are recorded too. An impossible answer, such as a time outside of [0, 1], is
    refused. Calls write at once: a process that is killed loses at most the record that it was
    writing. Only one thread at a time may use a recorder.

    ValueError: an argument that is refused. TypeError: no numbers. FileExistsError, OSError: the
    file exists, or cannot be written. After ValueError and TypeError nothing is written. An OSError
    of a step ends the log, so each later call fails too.
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
        """Records the next step. Positions are real numbers (n, 3).

        x0: where the step starts; None: where the last step ended, at its `committed` or else `x1`.
        x1 or dx: where the step would go, or by how much. committed: where the simulator went.
        answer: "free", "collision", "undecided" or "error", with first: (lo, hi) or a number,
        pairs: (k, 2) triangles, pair_times: (k, 2) or (k,), message: a line. Or answer is the
        answer of a detector in Python, such as the result of assay.Detector, which has all of
        these; None is "free". Without `answer` no answer is recorded. share, positions: how far a
        limiter let the step go.
        """
        told = None
        if answer is not UNTOLD:
            if isinstance(answer, str):
                answer = {"answer": answer, "first": first, "pairs": pairs, "times": pair_times}
            elif first is not None or pairs is not None or pair_times is not None:
                raise ValueError("first, pairs and pair_times: this answer already states them")
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
    """Returns adjacent rows of three numbers: float32 if they already are and may be float32."""
    if may_be_float32 and type(given) is np.ndarray and given.dtype == np.float32:
        if given.ndim == 2 and given.shape[1] == 3:
            return np.ascontiguousarray(given)
    return np.ascontiguousarray(arrays.positions(given, name))
