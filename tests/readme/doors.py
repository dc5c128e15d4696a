#!/usr/bin/env python3
"""Types the lines of reports/check/TEN_MINUTES.md into a shell, and nothing else. There are three doors: a
detector in C++, one in Python, and a recorded log. At each door a gate must fail and, after the fault is
mended, a gate must pass. The script starts in a bare system, or with the installed program.

usage: doors.py --chroot BARE --at CLONE     all lines, in a bare system; CLONE is a folder in it
       doors.py --build BUILD                with the program of BUILD, installed by cmake; without the lines in BUILT

Each line must end with its exit code in plan.ENDS, and must print the output that the page shows.
"""
import argparse
import contextlib
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

sys.dont_write_bytecode = True  # the sources' folder stays as it is
import plan
from blocks import chunks_of, not_printed

ROOT = Path(__file__).resolve().parents[2]
PAGE = "reports/check/TEN_MINUTES.md"
WANTED_MINUTES = 30
# Each line is evaluated in the same shell as the lines before, so that folders and variables stay. Every
# question is answered by yes.
TYPIST = r"""while IFS= read -r line; do eval "$line" <<<y 2>&1; printf '\n\1%d\n' $?; done"""


@dataclass
class Door:
    sections: tuple  # the beginnings of the headings of its sections
    fails: str  # the line of the gate that finds the fault
    passes: str  # the line of the gate that finds no fault


# The lines that build and install.
BUILT = ["reports/package/pack", "apt-get install -y ./build/assay_*.deb"]
# C++ comes last, because it makes the folder `cases`, which the other doors must not have.
DOORS = {
    "a recorded log": Door(("6.",), "assay check steps.log --keep build/judged", "assay check steps.log"),
    "a detector in Python": Door(("5.",), "SEED=3 sh detector/plugin/ci/job.sh",
                                 "SEED=4 sh detector/plugin/ci/job.sh"),
    "a detector in C++": Door(("1.", "2.", "3.", "4."),
                              "SEED=1 SOURCES=tests/plugins/additive_ccd.cpp sh detector/plugin/ci/job.sh",
                              "SEED=2 SOURCES=my_ccd.cpp sh detector/plugin/ci/job.sh"),
}


class Shell:
    def __init__(self, words, **place):
        self.job = subprocess.Popen([*words, "bash", "-c", TYPIST], text=True, errors="replace",
                                    stdin=subprocess.PIPE, stdout=subprocess.PIPE, **place)

    def type(self, line):
        """Types a line. Returns its exit code, or None if the line ended the shell, and its output."""
        print(line, file=self.job.stdin, flush=True)
        printed = []
        for text in self.job.stdout:
            if text.startswith("\1"):
                return int(text[1:]), "".join(printed)
            printed.append(text)
        return None, "".join(printed)

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.job.communicate()


class Page:
    def __init__(self, text, ends, shown, no_command):
        self.ends = {line: [*codes] for line, codes in ends.items()}
        self.shown, self.wrongs, self.chunks = {**shown}, [], chunks_of(text)
        headings = {number: line[3:] for number, line in enumerate(text.splitlines(), 1)
                    if line.startswith("## ")}
        self.lines = []  # (number, heading, line) of all lines to type
        for chunk in self.chunks:
            lines = chunk.commands()
            if any(line.startswith(entry) for _, line in lines for entry in no_command):
                continue
            heading = next((headings[n] for n in sorted(headings, reverse=True) if n < chunk.line), "")
            self.lines += [(number, heading, line) for number, line in lines]

    def wrong(self, number, text):
        self.wrongs.append(f"{number}: {text}")
        print(f"  WRONG {self.wrongs[-1]}", flush=True)

    def type(self, shell, lines):
        """Types the lines in order, up to the first wrong one. Returns the exit codes of the typed lines."""
        codes = {}
        for number, line in lines:
            started, before = time.monotonic(), len(self.wrongs)
            codes[line], printed = shell.type(line)
            print(f"  {time.monotonic() - started:6.1f} s  {line}", flush=True)
            wanted = self.ends[line].pop(0) if self.ends.get(line) else 0
            if codes[line] != wanted:
                self.wrong(number, f"ends with {codes[line]}, not {wanted}: {line}\n{printed[-2000:]}")
            elif entry := self.shown.pop(line, None):  # if a line occurs twice, the first one
                for place, text in not_printed(self.chunks, entry, printed):
                    self.wrong(place, f"is shown, and not printed: {text}")
            if len(self.wrongs) > before:
                break
        return codes

    def go_through(self, shell, doors, built, is_built):
        """Types all lines, and returns how many seconds the build and each door took."""
        for line in {*built} - {line for _, _, line in self.lines}:
            self.wrong(0, f"the page has no such line: {line}")
        started, seconds = time.monotonic(), {}
        if not is_built:
            self.type(shell, [(number, line) for number, _, line in self.lines if line in built])
        seconds["build"] = time.monotonic() - started
        rest = [entry for entry in self.lines if entry[2] not in built]
        for name, door in doors.items():
            if self.wrongs:
                break
            print(name, flush=True)
            started = time.monotonic()
            codes = self.type(shell, [(number, line) for number, heading, line in rest
                                      if heading.startswith(door.sections)])
            seconds[name] = time.monotonic() - started
            for line, wanted in ((door.fails, 1), (door.passes, 0)):
                if not self.wrongs and codes.get(line) != wanted:
                    self.wrong(0, f"no gate that ends with {wanted}: {line}")
        sections = tuple(s for door in doors.values() for s in door.sections)
        for number, heading, line in rest:
            if not heading.startswith(sections):
                self.wrong(number, f"behind no door: {line}")
        return seconds


def shell_of_the_installed(build):
    """Returns a shell in a folder with the sources alone; the program is installed in another folder."""
    place = build / "doors"
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(ROOT, place / "clone", ignore=lambda folder, names: {
        n for n in names if n in (".git", "node_modules") or n == "build" and Path(folder) == ROOT})
    subprocess.run(["cmake", "--install", build, "--prefix", place / "prefix"], check=True,
                   stdout=subprocess.DEVNULL)
    path = f"{place / 'prefix/bin'}:{os.environ['PATH']}"
    return Shell([], cwd=place / "clone", env={**os.environ, "PATH": path})


def shell_of_the_bare(bare, clone):
    path = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
    shell = Shell(["chroot", bare], env={"HOME": "/root", "PATH": path})
    shell.type(f"cd {clone}")
    return shell


def main():
    p = argparse.ArgumentParser(description="Types the lines of " + PAGE)
    p.add_argument("--chroot")
    p.add_argument("--at", default="/root/assay")
    p.add_argument("--build", type=lambda text: Path(text).resolve())
    options = p.parse_args()
    page = Page((ROOT / PAGE).read_text(), plan.ENDS[PAGE], plan.SHOWN[PAGE], plan.NO_COMMAND[PAGE])
    shell = (shell_of_the_bare(options.chroot, options.at) if options.chroot
             else shell_of_the_installed(options.build))
    seconds = page.go_through(shell, DOORS, BUILT, is_built=not options.chroot)
    shell.close()
    build = seconds.pop("build")
    for name, own in seconds.items():
        minutes = (build + own) / 60
        print(f"{name}: {minutes:.1f} minutes ({build:.0f} s of the build, {own:.0f} s of its own)"
              + (f"; wanted are {WANTED_MINUTES}" if minutes > WANTED_MINUTES else ""))
    print("\n".join([*(f"{PAGE}:{wrong}" for wrong in page.wrongs), f"{len(page.wrongs)} wrong"]))
    return 1 if page.wrongs else 0


if __name__ == "__main__":
    sys.exit(main())
