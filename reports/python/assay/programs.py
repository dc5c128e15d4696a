"""Runs verbs of the program `assay`: campaigns, certificates, replays and pages."""

from __future__ import annotations

import html
import json
import os
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Union

from .errors import AssayError
from .frames import Frames
from .places import program
from .plugin import detector_word, environment
from .progress import Progress, listener

PathLike = Union[str, "os.PathLike[str]"]

# Exit codes of reports/README.md.
_OUTCOMES = {0: "holds", 1: "defect", 3: "undecided", 4: "unsound", 5: "collision"}
_USAGE = 2


class Failure(Dict[str, Any]):
    """A kind of failure, as the run's findings describe it: signature, claim, met, what, file, ...

    file: the case file of the smallest mesh that shows it. The schema of certificates has the rest.
    """

    def frames(self) -> Frames:
        """Returns the smallest mesh: its triangles (m, 3), and positions (n, 3) of each frame."""
        from . import _judge

        return Frames(*_judge.read_case(self["file"]), [self["file"]])


@dataclass(frozen=True, repr=False)
class Outcome:
    """The result of a verb: a word for its exit code, the printed text, and its folder or file.

    strata, failures: after run() and certify(), lists for pandas.DataFrame(outcome.strata).
    """

    outcome: str
    code: int
    text: str
    out: Optional[Path] = None

    @property
    def strata(self) -> List[Dict[str, Any]]:
        """A dict for each family of cases: how many were judged, failed, ..., and its bound."""
        strata: List[Dict[str, Any]] = self._findings()["strata"]
        return strata

    @property
    def failures(self) -> List[Failure]:
        """A dict for each kind of failure, with the smallest mesh that shows it."""
        folder = Path(self.out or "").absolute()
        found = [Failure(failure) for failure in self._findings()["failures"]]
        for failure in found:
            failure["file"] = str(folder / failure["file"])
        return found

    def _findings(self) -> Dict[str, Any]:
        from . import _judge

        if self.out is None or not self.out.is_dir():
            raise ValueError("only outcomes of run() and certify() have strata and failures")
        findings: Dict[str, Any] = json.loads(_judge.findings(os.fspath(self.out)))
        return findings

    def __repr__(self) -> str:
        place = "" if self.out is None else f", {self.out}"
        return f"<assay.{type(self).__name__}: {self.outcome}{place}>"

    def __str__(self) -> str:
        return self.text

    def __bool__(self) -> bool:
        raise TypeError("this object has no truth value: compare its member .outcome with 'holds'")


@dataclass(frozen=True, repr=False)
class Page(Outcome):
    """The page of a run; a notebook shows it, with each failing mesh in 3D."""

    def _repr_html_(self) -> str:
        page = html.escape(Path(self.out or "").read_text(encoding="utf-8"), quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="800" style="border: 0"></iframe>'


def run(
    campaign: str, detector: Any = None, *, out: PathLike, progress: Progress = None, **options: Any
) -> Outcome:
    """Runs `assay run`: a campaign of random cases.

    campaign: "smoke", "quick", ..., or a file. detector: as in check(). out: the folder of the run.
    progress: a function for printed lines; True: stderr. options: as on the command line, without
    the dashes: seed=1, time=60, jobs=2, power="proof", ...

    AssayError says why the run could not begin. After Ctrl-C the same call continues the run.
    """
    return _of_campaign("run", campaign, detector, out, progress, options)


def certify(
    detector: Any = None,
    *,
    campaign: str = "smoke",
    out: PathLike,
    progress: Progress = None,
    **options: Any,
) -> Outcome:
    """Runs `assay certify`: corpus, campaign, planted faults, self-test and speed.

    Arguments are as in run(). The certificate is out/certificate.json.
    """
    return _of_campaign("certify", campaign, detector, out, progress, options)


def replay(
    case: PathLike, detector: Any = None, *, progress: Progress = None, **options: Any
) -> Outcome:
    """Runs `assay replay` on a case, by its id or file; why="0,5", export="folder", ..."""
    return _called(["replay", os.fspath(case)], detector, progress, options)


def report(folder: PathLike, out: Optional[PathLike] = None, **options: Any) -> Page:
    """Runs `assay report`: writes the page of a run to `out`, or to report.html in its folder."""
    file = Path(out) if out is not None else Path(folder) / "report.html"
    ended = _called(["report", os.fspath(folder), "--out", str(file)], None, None, options)
    return Page(ended.outcome, ended.code, ended.text, file)


def _of_campaign(
    verb: str,
    campaign: str,
    detector: Any,
    out: PathLike,
    progress: Progress,
    options: Dict[str, Any],
) -> Outcome:
    words = [verb, "--campaign", campaign, "--out", os.fspath(out)]
    ended = _called(words, detector, progress, options)
    return Outcome(ended.outcome, ended.code, ended.text, Path(out))


def _called(
    words: List[str], detector: Any, progress: Progress, options: Dict[str, Any]
) -> Outcome:
    variables = dict(os.environ)
    if detector is not None:
        words += ["--detector", detector_word(detector)]
        variables.update(environment(detector))
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            words += [option, os.fspath(value) if isinstance(value, os.PathLike) else str(value)]
    return _printed([str(program()), *words], variables, progress)


def _printed(command: List[str], variables: Dict[str, str], progress: Progress) -> Outcome:
    lines: List[str] = []
    told = listener(progress, "\n")
    # The child has a session of its own, so that ctrl-C reaches it only once, from this process.
    with subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        env=variables,
        start_new_session=True,
    ) as child:
        try:
            for line in child.stdout:
                lines.append(line)
                if told:
                    told(line.rstrip("\n"))
            code = child.wait()
        except BaseException:
            child.send_signal(signal.SIGINT)
            child.wait()
            raise
    if code not in _OUTCOMES:
        why = lines[-1].strip() if lines else f"it ended with {code}"
        raise AssayError(why.removeprefix("assay: "), code if code > 0 else _USAGE)
    return Outcome(_OUTCOMES[code], code, "".join(lines))
