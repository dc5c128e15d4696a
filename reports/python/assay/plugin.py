"""Names a detector for the programs, and asks a plug-in about single cases.

Another process imports a class in Python by its module, so the class has to be in a file. There
hosting.py calls the class, and says which members the class must have.
"""

import contextlib
import inspect
import json
import os
import sys
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Tuple

from . import hosting
from .places import program


def detector_word(detector: Any) -> str:
    """Returns the word for `--detector`: the name of a library, or "python:MODULE:CLASS"."""
    hosting.stop_if_imported()
    if isinstance(detector, type):
        module, _ = _place(detector)
        return f"python:{module}:{detector.__qualname__}"
    if isinstance(detector, (str, os.PathLike)):
        return os.fspath(detector)
    raise TypeError(
        f"a detector is a class, 'python:MODULE:CLASS' or a library, not {type(detector).__name__}"
    )


def environment(detector: Any) -> Dict[str, str]:
    """Returns the variables by which a plug-in's process finds the class and this Python."""
    folders = [os.environ.get("PYTHONPATH", "")]
    if isinstance(detector, type):
        folders.insert(0, _place(detector)[1])
    return {"PYTHONPATH": os.pathsep.join(filter(None, folders)), "ASSAY_PYTHON": sys.executable}


@contextlib.contextmanager
def surroundings(detector: Any) -> Iterator[None]:
    """Sets the variables of environment() in this process for its children, and restores them."""
    during = {} if detector is None else environment(detector)
    before = {name: os.environ[name] for name in during if name in os.environ}
    os.environ.update(during)
    try:
        yield
    finally:
        for name in during:
            os.environ.pop(name, None)
        os.environ.update(before)


class Plugin:
    """A plug-in that answers single cases: steps, limits and queries, in a process of its own.

    detector: as for check(). seconds: the limit of processor time for a case. name, version: as the
    plug-in states them. ValueError: the plug-in cannot be used; the message says why.
    """

    def __init__(self, detector: Any, *, seconds: float = 10):
        from . import _judge

        self._detector = detector
        with surroundings(detector):
            self._plugin = _judge.Plugin(
                detector_word(detector), str(program("assay-worker")), seconds
            )
        self.name, self.version = self._plugin.name, self._plugin.version

    def answers(
        self, case: Dict[str, Any], *, separation: float = 0, limits: bool = False
    ) -> Optional[List[Dict[str, Any]]]:
        """Returns a dict for each step of a case, as in the results of corpus/vectors.

        case: the content of a case file (corpus/README.md); with the option `query` the case is one
        query of two features. separation: the distance that is asked about, 0 for contacts. limits:
        asks how far each step may be taken. Returns None if the detector cannot answer the
        question, or if its contract leaves out the case.
        """
        with surroundings(self._detector):
            return self._plugin.answers(json.dumps(case), separation, limits)


def _place(kind: type) -> Tuple[str, str]:
    """Returns the module of a class, and the folder in which Python finds the module."""
    try:
        file = Path(inspect.getfile(kind)).absolute()
    except (OSError, TypeError):
        why = "a class of a notebook or a prompt stands in no file that another process can import"
        how = "write the class to a file (%%writefile mine.py), and import it from that file"
        raise ValueError(f"{kind.__qualname__}: {why}; {how}") from None
    if "." in kind.__qualname__:
        raise ValueError(f"{kind.__qualname__}: a class at the top of its module is wanted")
    if kind.__module__ == "__main__":
        return file.stem, str(file.parent)
    module = kind.__module__
    if file.name == "__init__.py":
        file = file.parent
    return module, str(file.parents[module.count(".")])
