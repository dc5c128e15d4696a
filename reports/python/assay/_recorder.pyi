from typing import Any, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

CLAIMS: Tuple[str, ...]
MEMBERS: Dict[str, Tuple[str, ...]]

class Recorder:
    def __init__(
        self,
        path: bytes,
        mesh: Tuple[npt.NDArray[np.int32], npt.NDArray[Any]],
        name: Tuple[str, str],
        described: Tuple[int, Dict[str, Any]],
        every: int,
        overwrite: bool,
        counted: Tuple[Optional[npt.NDArray[np.int32]], npt.NDArray[np.int32]],
        near: Tuple[int, float, npt.NDArray[np.float64]],
    ) -> None: ...
    def step(
        self,
        x0: Optional[npt.NDArray[Any]],
        x1: Optional[npt.NDArray[Any]],
        dx: Optional[npt.NDArray[Any]],
        committed: Optional[npt.NDArray[Any]],
        answer: Optional[Tuple[Any, ...]],
        message: Optional[str],
        share: float,
        positions: Optional[npt.NDArray[np.float64]],
    ) -> None: ...
    def note(self, text: str) -> None: ...
    def end(self) -> None: ...
    @property
    def is_recording(self) -> bool: ...
