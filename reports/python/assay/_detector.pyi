from typing import Any, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

VERSION: str
OPTIONS: Dict[str, Tuple[str, ...]]

class State:
    """The state that a detector carries from step to step."""

    def __eq__(self, other: object) -> bool: ...

class Detector:
    def __init__(
        self,
        triangles: npt.ArrayLike,
        positions: npt.ArrayLike,
        options: Dict[str, str],
        threads: int,
    ) -> None: ...
    def evaluate(self, x_t0: npt.ArrayLike, x_t1: npt.ArrayLike) -> Dict[str, Any]: ...
    def commit(self) -> None: ...
    def step(self, x_t0: npt.ArrayLike, x_t1: npt.ArrayLike) -> Dict[str, Any]: ...
    def first_contact(
        self, x_t0: npt.ArrayLike, x_t1: npt.ArrayLike, until: float
    ) -> Dict[str, Any]: ...
    def limit(
        self, x_t0: npt.ArrayLike, x_t1: npt.ArrayLike
    ) -> Tuple[float, npt.NDArray[np.float64], Optional[Tuple[float, float]]]: ...
    def state(self) -> State: ...
    def restore(self, state: State) -> None: ...
    def reset(self) -> None: ...

Answers = Tuple[npt.NDArray[np.bool_], npt.NDArray[np.float64], npt.NDArray[np.float64]]

def vertex_face(
    x_t0: npt.ArrayLike, x_t1: npt.ArrayLike, arithmetic: str, separation: float
) -> Answers: ...
def edge_edge(
    x_t0: npt.ArrayLike, x_t1: npt.ArrayLike, arithmetic: str, separation: float
) -> Answers: ...
def contact_places(
    triangles: npt.ArrayLike,
    x_t0: npt.ArrayLike,
    x_t1: npt.ArrayLike,
    pairs: npt.NDArray[np.int32],
    times: npt.NDArray[np.float64],
    features: npt.NDArray[np.int32],
) -> Tuple[npt.NDArray[np.float64], ...]: ...
