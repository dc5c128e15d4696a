#!/usr/bin/env python3
"""Plants faults into the harness and asks whether the frozen rows show each of them.

usage: faults.py TREE [FAULT...]

TREE is a copy of the sources that may be changed, built in build/release, with the rows of its
right build in tests/frozen/rows.txt. All faults go into one build, and an environment variable
says which of them is there. A fault is a file of faults/: its line `+` takes the place of the
line `-` of a source, and the word PLANTED in it is true if the fault is there.
"""
import os
import subprocess
import sys
from pathlib import Path

HEAD = "#include <cstdlib>\n#include <string_view>\n"
WORD = ('(std::getenv("ASSAY_PLANTED") != nullptr &&'
        ' std::string_view(std::getenv("ASSAY_PLANTED")) == "{}")')


def parts_of(fault):
    about, file, right, wrong = fault.read_text().splitlines()
    return file.removeprefix("file: "), right[1:], wrong[1:].replace("PLANTED", WORD.format(fault.stem))


def main():
    tree = Path(sys.argv[1]).resolve()
    faults = sorted((tree / "tests/frozen/faults").glob("*.fault"))
    for fault in faults:
        file, right, wrong = parts_of(fault)
        source = (tree / file).read_text()
        if source.count(f"\n{right}\n") != 1:
            sys.exit(f"{fault.stem}: not exactly once in {file}: {right}")
        head = "" if source.startswith(HEAD) else HEAD
        (tree / file).write_text(head + source.replace(f"\n{right}\n", f"\n{wrong}\n"))
    subprocess.run(["ninja", "-C", tree / "build/release", "assay", "assay-worker", "assay_python"],
                   check=True, stdout=subprocess.DEVNULL)
    script = [sys.executable, tree / "tests/frozen/frozen.py", tree / "build/release"]
    chosen = [fault.stem for fault in faults if fault.stem in sys.argv[2:] or len(sys.argv) == 2]
    missed = []
    for name in ["none", *chosen]:
        ended = subprocess.run(script, env=dict(os.environ, ASSAY_PLANTED=name), text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        found = ended.returncode == 1 and "Traceback" not in ended.stdout
        rows = [line for line in ended.stdout.splitlines() if line.startswith("-")]
        is_right = found != (name == "none")
        print(f"{name:24} {'right' if is_right else 'WRONG'}: {len(rows)} rows differ; "
              f"{rows[0][:100] if rows else ''}", flush=True)
        if not is_right:
            missed.append(name)
    print(f"{len(chosen)} faults, wrong: {', '.join(missed) or 'none'}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
