from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

Listener = Optional[Callable[[str], None]]

def judge(
    triangles: npt.ArrayLike,
    x_t0: npt.ArrayLike,
    x_t1: npt.ArrayLike,
    within: Optional[Tuple[float, float]],
    jobs: int,
) -> Dict[str, Any]: ...
def least_distance(
    triangles: npt.ArrayLike, x_t0: npt.ArrayLike, x_t1: npt.ArrayLike, jobs: int
) -> Optional[
    Tuple[float, Tuple[int, int], Tuple[float, float], str, Tuple[int, ...]]
]: ...
def check_arrays(
    triangles: npt.ArrayLike,
    frames: List[npt.ArrayLike],
    asked: Dict[str, Any],
    worker: str,
    listener: Listener,
) -> Tuple[str, str, int]: ...
def check_files(
    files: List[str], asked: Dict[str, Any], worker: str, listener: Listener
) -> Tuple[str, str, int]: ...
def in_order_of_numbers(files: List[str]) -> Tuple[List[str], List[str]]: ...
def read_sequence(
    files: List[str],
) -> Tuple[npt.NDArray[np.int32], List[npt.NDArray[np.float64]], List[str]]: ...
def read_case(
    file: str,
) -> Tuple[npt.NDArray[np.int32], List[npt.NDArray[np.float64]]]: ...
def findings(folder: str) -> str: ...

class Plugin:
    """A plug-in in a process of its own."""

    def __init__(self, library: str, worker: str, seconds: float) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def version(self) -> str: ...
    def answers(
        self, case_text: str, separation: float, asks_limits: bool
    ) -> Optional[List[Dict[str, Any]]]: ...
