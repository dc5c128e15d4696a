"""`python -m assay`, and the command `assay` that pip installs: the program, run as it is."""

import os
import sys

from .errors import AssayError
from .places import program


def main() -> None:
    """Becomes the program. Detectors in Python are then of this Python."""
    os.environ.setdefault("ASSAY_PYTHON", sys.executable)
    try:
        file = program()
    except AssayError as error:
        sys.exit(f"assay: {error}")
    os.execv(file, [str(file), *sys.argv[1:]])


if __name__ == "__main__":
    main()
