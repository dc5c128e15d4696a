"""Tells the progress of long work."""

from __future__ import annotations

import sys
from typing import Callable, Optional, Union

Progress = Union[None, bool, Callable[[str], None]]


def listener(progress: Progress, end: str = "") -> Optional[Callable[[str], None]]:
    """The function that gets each printed text; True stands for stderr, with `end` after it."""
    if progress is True:
        return lambda text: print(text, end=end, file=sys.stderr, flush=True)
    return progress or None
