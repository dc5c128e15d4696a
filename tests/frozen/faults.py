#!/usr/bin/env python3
"""Plants faults into the harness, and checks that the frozen rows or a named test show each fault.

usage: faults.py TREE [FAULT...]    # TREE: a built copy of the sources, which is changed
       faults.py --fit SOURCES      # only checks that the sources have the line of each fault

A fault is a file of faults/. Its line `+` takes the place of the line `-` in a source, and the word
PLANTED in it is true if the fault is active. All faults go into one build, and the environment variable
ASSAY_PLANTED names the active fault. A line `test: PROGRAM FILTER` names GoogleTest tests that show
the fault, if no frozen row does. Exit code 0: each fault shows, and no test fails without a fault.
"""
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

FROZEN = "tests/frozen/frozen.py"
HEAD = "#include <cstdlib>\n#include <string_view>\n"
IS_PLANTED = ('(std::getenv("ASSAY_PLANTED") != nullptr &&'
              ' std::string_view(std::getenv("ASSAY_PLANTED")) == "{}")')


class Fault(NamedTuple):
    name: str
    file: str
    right: str
    wrong: str
    test: tuple  # program and filter; empty: the frozen rows


def read(path):
    lines = path.read_text().splitlines()
    about, file, right, wrong, *test = lines
    begins = [line.split(" ")[0] for line in (about, file, *test)]
    if begins not in (["about:", "file:"], ["about:", "file:", "test:"]) or right[0] + wrong[0] != "-+":
        sys.exit(f"{path}: the lines are about:, file:, -, +, and perhaps test:")
    is_planted = IS_PLANTED.format(path.stem)
    return Fault(path.stem, file.removeprefix("file: "), right[1:],
                 wrong[1:].replace("PLANTED", is_planted), tuple(test[0].split(" ")[1:]) if test else ())


def planted(source, fault):
    """Returns the source with the fault. Ends the script unless the source has the line exactly once."""
    if source.count(f"\n{fault.right}\n") != 1:
        sys.exit(f"{fault.name}: not exactly once in {fault.file}: {fault.right}")
    head = "" if source.startswith(HEAD) else HEAD
    return head + source.replace(f"\n{fault.right}\n", f"\n{fault.wrong}\n")


def shows(tree, fault_name, test):
    build = tree / "build/release"
    words = [build / test[0], f"--gtest_filter={test[1]}"] if test else [sys.executable, tree / FROZEN, build]
    ended = subprocess.run(words, env=dict(os.environ, ASSAY_PLANTED=fault_name), text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if ended.returncode not in (0, 1) or "Traceback" in ended.stdout or " 0 tests from" in ended.stdout:
        sys.exit(f"{fault_name}: {words[0]} ended with {ended.returncode}:\n{ended.stdout[-2000:]}")
    return ended.returncode == 1


def main():
    is_fit, *rest = sys.argv[1:] if sys.argv[1] == "--fit" else ["", *sys.argv[1:]]
    tree, chosen = Path(rest[0]).resolve(), rest[1:]
    faults = [read(path) for path in sorted((tree / "tests/frozen/faults").glob("*.fault"))]
    sources = {}
    for fault in faults:
        source = sources.get(fault.file) or (tree / fault.file).read_text()
        sources[fault.file] = planted(source, fault)
    if is_fit:
        return 0 if len(faults) >= 20 else 1
    for file, source in sources.items():
        (tree / file).write_text(source)
    programs = sorted({fault.test[0] for fault in faults if fault.test})
    subprocess.run(["ninja", "-C", tree / "build/release", "assay", "assay-worker", "assay_python", *programs],
                   check=True, stdout=subprocess.DEVNULL)
    wrong = [test for test in sorted({fault.test for fault in faults}) if shows(tree, "none", test)]
    print(f"without a fault: {'wrong: ' + str(wrong) if wrong else 'nothing shows'}", flush=True)
    for fault in faults:
        if chosen and fault.name not in chosen:
            continue
        is_shown = shows(tree, fault.name, fault.test)
        print(f"{fault.name:24} {'shows' if is_shown else 'HIDDEN'}", flush=True)
        wrong += [] if is_shown else [fault.name]
    print(f"{len(chosen or faults)} faults, {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
