"""Finds the programs of Assay: beside the package, as it was built or installed."""

import os
from pathlib import Path

from .errors import AssayError

_HERE = Path(__file__).absolute().parent

# The folder in a package of pip; the folder of the build; the folders of cmake --install.
_FOLDERS = (_HERE / "bin", _HERE.parent.parent, *(up / "bin" for up in _HERE.parents))


def program(name: str = "assay") -> Path:
    """Returns the path of this program. ASSAY_PROGRAM names another `assay`."""
    named = os.environ.get("ASSAY_PROGRAM")
    for folder in (Path(named).parent,) if named else _FOLDERS:
        for workers in (folder, folder.parent / "libexec" / "assay"):
            found = {"assay": folder / "assay", "assay-worker": workers / "assay-worker"}
            if all(os.access(file, os.X_OK) for file in found.values()):
                return found[name]
    raise AssayError("the programs assay and assay-worker are not beside the package", 2)
