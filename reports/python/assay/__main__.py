"""Runs the program `assay`, for `python -m assay` and for the command that pip installs."""

import os
import sys

from .errors import AssayError
from .places import program


def main() -> None:
    """Replaces this process by the program. Detectors in Python then run in this Python."""
    os.environ.setdefault("ASSAY_PYTHON", sys.executable)
    try:
        file = program()
    except AssayError as error:
        sys.exit(f"assay: {error}")
    os.execv(file, [str(file), *sys.argv[1:]])


if __name__ == "__main__":
    main()
