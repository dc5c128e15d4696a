"""Tells the progress of long work."""

from __future__ import annotations

import sys
from typing import Callable, Optional, Union

Progress = Union[None, bool, Callable[[str], None]]


def listener(progress: Progress, end: str = "") -> Optional[Callable[[str], None]]:
    """Returns the function that gets each printed text: for True, one that prints it to stderr."""
    if progress is True:
        return lambda text: print(text, end=end, file=sys.stderr, flush=True)
    return progress or None
