"""Where the programs of Assay are: beside the package, as it was built or installed."""

import os
from pathlib import Path

from .errors import AssayError

_HERE = Path(__file__).absolute().parent

# In a package of pip's; as it was built; as cmake --install puts it.
_FOLDERS = (_HERE / "bin", _HERE.parent.parent, *(up / "bin" for up in _HERE.parents))


def program(name: str = "assay") -> Path:
    """The program `assay`, or `assay-worker` beside it. ASSAY_PROGRAM names another `assay`."""
    named = os.environ.get("ASSAY_PROGRAM")
    for folder in (Path(named).parent,) if named else _FOLDERS:
        if os.access(folder / "assay", os.X_OK) and os.access(folder / "assay-worker", os.X_OK):
            return folder / name
    raise AssayError("the programs assay and assay-worker are not beside the package", 2)
