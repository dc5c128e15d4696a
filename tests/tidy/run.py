#!/usr/bin/env python3
"""Runs clang-tidy on the sources, and so on the headers that they include.

usage: run.py --build BUILD [--all] [--jobs N] [FILE...]

Without --all it checks detector and oracle, the two rooms in which a bug is a wrong verdict, with the
checks that take little more time than reading the file. With --all it runs all checks of .clang-tidy, in
all rooms except tests.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
JUDGING_ROOMS = ("detector", "oracle")
ALL_ROOMS = ("detector", "oracle", "corpus", "properties", "reports")
CHEAP = ("bugprone-use-after-move", "bugprone-dangling-handle", "bugprone-unused-raii",
         "bugprone-copy-constructor-init", "bugprone-integer-division", "bugprone-branch-clone",
         "performance-for-range-copy", "performance-unnecessary-copy-initialization",
         "performance-move-const-arg", "performance-unnecessary-value-param",
         "misc-unused-parameters", "modernize-use-override")
# Flags of g++ that clang does not accept: clang cannot read the precompiled headers of g++.
PRECOMPILED = re.compile(r" -Winvalid-pch -include \S+/cmake_pch\.hxx| -fpch-preprocess"
                         r"| --param ggc-min-heapsize=\d+")
FOR_CLANG = ["--extra-arg=-Wno-unknown-warning-option"]
FINDING = re.compile(r"^/\S+?:\d+:\d+: (?:error|warning): .*$", re.M)


def compile_commands(build, rooms):
    """Returns the command that compiles each source of the rooms, in a form that clang accepts."""
    # In some rooms a whole folder is compiled as one source, which CMake has written (ASSAY_UNITY).
    places = tuple(f"{folder}/{room}/" for folder in (ROOT, build) for room in rooms)
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = entry["file"]
        if file.startswith(places) and "cmake_pch" not in file:
            commands.setdefault(file, PRECOMPILED.sub("", entry["command"]))
    return commands


# Sources that give another meaning to a name than another source of their folder.
NOT_JOINED = tuple(f"{ROOT}/{file}" for file in (
    "detector/view/view_signs.cpp", "oracle/referee/referee.cpp", "oracle/referee/static_check.cpp"))
# Folders without conflicting names are read as one.
TOGETHER = {folder: number for number, folders in enumerate((
    "detector detector/boundary detector/boxes detector/mesh detector/parallel detector/plugin "
    "detector/view", "detector/contact detector/distance detector/exact detector/geometry",
    "oracle oracle/distance oracle/view", "oracle/mesh oracle/query",
    "oracle/instant oracle/referee")) for folder in folders.split()}


def by_folder(commands, folder):
    """Joins the sources of a few folders to one, so that headers are read once: a quarter of the time."""
    groups, joined = {}, {}
    for file, command in commands.items():
        # Sources with other flags are not joined.
        flags = re.sub(r"-o \S+ -c \S+", "", command)
        if file in NOT_JOINED:
            joined[file] = command
        else:
            place = os.path.relpath(os.path.dirname(file), ROOT)
            groups.setdefault((TOGETHER.get(place, place), flags), []).append(file)
    for number, ((_, flags), files) in enumerate(groups.items()):
        source = Path(folder) / f"folder_{number}.cpp"
        source.write_text("".join(f'#include "{file}"\n' for file in sorted(files)))
        joined[str(source)] = f"{flags} -c {source}"
    return joined


def main():
    p = argparse.ArgumentParser(description="clang-tidy over the sources")
    p.add_argument("--build", type=lambda text: Path(text).resolve(), required=True)
    p.add_argument("--all", action="store_true", help="all rooms and all checks of .clang-tidy")
    p.add_argument("--jobs", type=int, default=os.cpu_count())
    p.add_argument("files", nargs="*", type=lambda text: str(Path(text).resolve()))
    options = p.parse_args()
    commands = compile_commands(options.build, ALL_ROOMS if options.all else JUDGING_ROOMS)
    if options.files:
        commands = {file: commands[file] for file in options.files}
    arguments = FOR_CLANG + ([] if options.all else ["--checks=-*," + ",".join(CHEAP)])

    with tempfile.TemporaryDirectory() as folder:
        sources = commands if options.files or options.all else by_folder(commands, folder)
        (Path(folder) / "compile_commands.json").write_text(json.dumps(
            [{"directory": str(options.build), "file": file, "command": command}
             for file, command in sources.items()]))

        def look_at(file):
            return subprocess.run(["clang-tidy", "--quiet", "-p", folder, *arguments, file],
                                  capture_output=True, text=True, errors="replace")

        files = sorted(sources)
        with ThreadPoolExecutor(options.jobs) as threads:
            runs = list(threads.map(look_at, files))
    findings = {}  # one entry for a finding in a header, which many sources have
    for file, run in zip(files, runs):
        if run.returncode:
            found = FINDING.findall(run.stdout) or [f"clang-tidy ends with {run.returncode}: {run.stderr}"]
            for finding in found:
                findings.setdefault(finding, file)
    print("".join(f"{finding}\n" for finding in findings), end="")
    print(f"{len(commands)} files, {len(findings)} findings")
    return 1 if findings or not files else 0


if __name__ == "__main__":
    sys.exit(main())
