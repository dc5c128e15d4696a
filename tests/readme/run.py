#!/usr/bin/env python3
"""Runs the commands of all READMEs and other pages as they are written, and checks their links. plan.py
says which commands are run, and how the others are checked.

usage: run.py --build BUILD [--slow|--shown]      BUILD: the build tree of preset release
"""
import argparse
import re
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True  # the sources' folder stays as it is
import plan
from blocks import chunks_of, not_printed
from clone import Clone
from named import is_synopsis, wrong_names

ROOT = Path(__file__).resolve().parents[2]
# A line that begins like this is a command, whatever the text around it is.
COMMAND = re.compile(
    r"(\w+=\S+ +)*(build/release/|reports/|tests/|assay |ctest |cmake |ninja |python3 |cc )")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
WORKFLOW_STEP = re.compile(r"(?:- )?run: (build/release/assay .*)")
QUICK_SECONDS, SLOW_SECONDS = 60, 3600  # the most that one command may take


def readmes():
    return sorted(str(f.relative_to(ROOT)) for f in ROOT.rglob("*.md")
                  if not {"build", "node_modules", ".git"} & set(f.relative_to(ROOT).parts))


class ReadmeTest:
    """The plan for one README, and its results."""

    def __init__(self, name, options, wrongs):
        self.name, self.options, self.wrongs = name, options, wrongs
        self.quick = plan.QUICK.get(name, [])
        self.slow = plan.SLOW.get(name, [])
        self.not_run = plan.NOT_RUN.get(name, {})
        self.no_command = plan.NO_COMMAND.get(name, {})
        self.met = set()  # entries of the plan that the README has
        self.ends = {c: [*codes] for c, codes in plan.ENDS.get(name, {}).items()}
        self.chunks = chunks_of((ROOT / name).read_text())
        self.clone = None  # made for the first command

    def wrong(self, line, text):
        self.wrongs.append(f"{self.name}:{line}: {text}")
        print(f"  WRONG {self.wrongs[-1]}", flush=True)

    def run(self):
        print(self.name, flush=True)
        self.check_links()
        for chunk in self.chunks:
            text = self.no_command_of(chunk)
            for line, command in chunk.commands():
                if not text:
                    self.look_at(line, command)
                elif step := WORKFLOW_STEP.match(command):
                    self.check_names(line, step.group(1))
                elif COMMAND.match(command):
                    self.wrong(line, f"among {self.no_command[text]}: {command}")
        for entry in [*self.quick, *self.slow, *self.not_run, *self.no_command]:
            if entry not in self.met:
                self.wrong(0, f"in plan.py, and not in this README: {entry}")

    def check_links(self):
        for number, line in enumerate((ROOT / self.name).read_text().splitlines(), 1):
            for target in LINK.findall(line):
                if "://" not in target and not ((ROOT / self.name).parent / target).exists():
                    self.wrong(number, f"there is no {target}, and a link to it")

    def no_command_of(self, chunk):
        """Returns the entry of plan.NO_COMMAND with which a line of the chunk begins, or None."""
        for entry in self.no_command:
            if any(command.startswith(entry) for _, command in chunk.commands()):
                self.met.add(entry)
                return entry
        return None

    def look_at(self, line, command):
        self.met.add(command)
        if self.name in plan.TYPED:
            return
        is_shown = command in plan.SHOWN.get(self.name, {})
        if (command in self.quick or (command in self.slow and self.options.slow)
                or (is_shown and self.options.shown)):
            self.run_command(line, command)
        elif command in self.slow:
            print(f"  slow         {command}", flush=True)
        elif command in self.not_run or is_synopsis(command):
            self.check_names(line, command)
        else:
            self.wrong(line, f"plan.py does not say what to do with: {command}")

    def check_names(self, line, command):
        print(f"  names only   {command}", flush=True)
        for wrong in wrong_names(command, self.place(), self.options.build):
            self.wrong(line, f"{wrong}, in: {command}")

    def run_command(self, line, command):
        started = time.monotonic()
        seconds = SLOW_SECONDS if command in self.slow else QUICK_SECONDS
        code, printed = self.place().run(command, seconds)
        print(f"  {time.monotonic() - started:6.1f} s     {command}", flush=True)
        codes = self.ends.get(command, [])
        wanted = codes.pop(0) if codes else 0
        if code != wanted:
            self.wrong(line, f"ends with {code}, not {wanted}: {command}\n{printed[-2000:]}")
        elif entry := plan.SHOWN.get(self.name, {}).get(command):
            self.compare_shown(entry, printed)

    def compare_shown(self, entry, printed):
        """Checks that each line of the shown chunk was printed; times may differ."""
        for line, text in not_printed(self.chunks, entry, printed):
            self.wrong(line, f"is not printed (reports/pictures/renew writes it anew): {text}")

    def place(self):
        if not self.clone:
            folder = self.options.build / "readme" / (
                "slow" if self.options.slow else "shown" if self.options.shown else "quick")
            self.clone = Clone(folder, ROOT, self.options.build)
            given = plan.GIVEN.get(self.name, [])
            if self.options.slow or (self.options.shown and self.name in plan.SHOWN):
                given = given + plan.GIVEN_SLOW.get(self.name, [])
            for command in given:
                code, printed = self.clone.run(command, SLOW_SECONDS)
                if code != 0:
                    sys.exit(f"what {self.name} takes as given ends with {code}: {command}\n{printed}")
        return self.clone


def main():
    p = argparse.ArgumentParser(description="Runs the commands of all READMEs")
    p.add_argument("--build", type=lambda text: Path(text).resolve(), required=True)
    p.add_argument("--slow", action="store_true", help="those of plan.SLOW too")
    p.add_argument("--shown", action="store_true", help="those of plan.SLOW whose output is shown too")
    options = p.parse_args()
    wrongs = []
    names = readmes()
    for name in names:
        ReadmeTest(name, options, wrongs).run()
    plans = (plan.QUICK, plan.SLOW, plan.NOT_RUN, plan.NO_COMMAND, plan.GIVEN, plan.GIVEN_SLOW,
             plan.ENDS, plan.SHOWN, plan.TYPED)
    for name in {name for one in plans for name in one} - {*names}:
        wrongs.append(f"plan.py speaks of {name}, and there is none")
    print("\n".join(["", *wrongs, f"{len(names)} READMEs, {len(wrongs)} wrong"]))
    return 1 if wrongs else 0


if __name__ == "__main__":
    sys.exit(main())
