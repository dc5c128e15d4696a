#!/usr/bin/env python3
"""Proves the error bounds of the detector's filters by Gappa (tests/README.md)."""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True  # the sources' folder stays as it is
import comparisons

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# By program: the files of the detector that it reads. If one has changed, the program is built again.
READ = {"claims": ["exact/bernstein.h", "mesh/step_types.h", "mesh/types.h"], "graph": [], "script": []}
BUILT, COPIED = {}, set()  # COPIED: the unchanged files of the copy
BASE = [*READ]  # all other sources are filters
FILTERS = sorted(p.stem for p in HERE.glob("*.cpp") if p.stem not in BASE)

# Patterns in the sources of the detector, and their replacements in the copy.
RULES = [
    (re.compile(r"\bdouble\b"), "bounds::Recorded"),
    (re.compile(r'(?<![\w."/])(\d+\.\d+)(?![\w.])'), r"bounds::Recorded(\1)"),
    (re.compile(r"\bstd::(abs|sqrt|isfinite|ilogb|scalbn|ldexp|frexp|bit_cast)\b"), r"bounds::math::\1"),
    (re.compile(r"\bprivate:"), "public:"),
]
# More replacements in the sources of boxes, which compute in floats.
FLOAT_RULES = [
    (re.compile(r"\bfloat\b"), "bounds::Float"),
    (re.compile(r"bounds::Float __attribute__\(\(vector_size\(16\)\)\)"), "bounds::FloatLanes"),
    (re.compile(r"\bint __attribute__\(\(vector_size\(16\)\)\)"), "bounds::LaneTruth"),
    (re.compile(r"#ifdef __SSE__"), "#if 0"),
]
# Lines that occur once in a file, and their replacements in the copy.
LINES = {
    "distance/near_filter.cpp": [
        ("double share(double part, double whole) {",
         "double share(double part, double whole) {\n  if (bounds::cut(part)) return part;"),
    ],
    "contact/contact_doubles.cpp": [
        ("Cubic left_of(Cubic f, double s) {", "Cubic left_of(Cubic f, double s) {\n  bounds::cut(s);"),
    ],
    # One lane.
    "boxes/box_lanes_kernel.h": [
        ("typedef float Lanes __attribute__((vector_size(32)));", "using Lanes = bounds::Float;"),
        ("typedef int LaneMask __attribute__((vector_size(32)));", "using LaneMask = int;"),
        ("__builtin_memcpy(&out, from, sizeof(out));", "out = *from;"),
        ("#if defined(__AVX2__) || defined(__SSE__)", "#if 0"),
        ("#if defined(__AVX2__)", "#if 1\n  return static_cast<std::uint32_t>(mask);\n#elif 0"),
        ("#elif defined(__SSE__)", "#elif 0"),
    ],
    "exact/double_lanes.h": [
        ("typedef double Lanes __attribute__((vector_size(8 * ASSAY_LANES)));",
         "using Lanes = bounds::RecordedLanes;"),
    ],
    "contact/lanes/query_lanes_kernel.h": [
        ("const Lanes size = x < Lanes{} ? -x : x;", "const Lanes size = bounds::abs(x);"),
    ],
    "view/view_lanes_kernel.h": [
        ("ASSAY_INLINE void clamp_to_unit(Lanes& s) {",
         "ASSAY_INLINE void clamp_to_unit(Lanes& s) {\n  if (bounds::cut(s)) return;"),
    ],
}


def arguments():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--work", default=str(ROOT / "build/bounds"), help="where copies and scripts go")
    p.add_argument("--compiler", default="g++")
    p.add_argument("--include", action="append", default=["/usr/include/eigen3"])
    p.add_argument("--jobs", type=int, default=os.cpu_count())
    p.add_argument("--changes", help="a JSON list of changed lines, of which each must be found")
    return p.parse_args()


def copy(target, change):
    """Copies the detector with recorded numbers in place of doubles. `change` changes one line."""
    for source in (ROOT / "detector").rglob("*"):
        is_changed = bool(change) and source == ROOT / change["file"]
        place = target / source.relative_to(ROOT)
        if source.suffix not in (".h", ".cpp") or not is_changed and place in COPIED:
            continue
        text = changed(source.read_text(), change) if is_changed else source.read_text()
        for line, other in LINES.get(str(source.relative_to(ROOT / "detector")), []):
            if text.count(line) != 1:
                sys.exit(f"{source}: not once in it: {line}")
            text = text.replace(line, other)
        in_floats = source.parent.name in ("boxes", "search")
        for pattern, other in RULES + (FLOAT_RULES if in_floats else []):
            text = pattern.sub(other, text)
        place.parent.mkdir(parents=True, exist_ok=True)
        if not place.exists() or place.read_text() != text:
            place.write_text(text)
        (COPIED.discard if is_changed else COPIED.add)(place)


def changed(text, change):
    lines = text.split("\n")
    places = [n for n, line in enumerate(lines) if line.strip() == change["line"]]
    nth = change.get("occurrence", 1)
    if len(places) < nth or ("occurrence" not in change and len(places) != 1):
        sys.exit(f"{change['file']}: stands there {len(places)} times: {change['line']}")
    lines[places[nth - 1]] = change["mutated"]
    return "\n".join(lines)


def write_scripts(options, work, filters, pool):
    """Compiles the filters and writes their scripts. Returns the program's exit code and output."""
    compile_ = [options.compiler, "-std=c++20", "-O0", "-w", f"-I{work}", f"-I{ROOT}",
                *[f"-isystem{i}" for i in options.include]]

    # Eigen and the standard library are read once, for both tests.
    first = Path(options.work) / "first.h"
    read = Path(f"{first}.gch")
    if not read.exists() or read.stat().st_mtime < (HERE / "recorded.h").stat().st_mtime:
        first.write_text('#include "tests/bounds/recorded.h"\n')
        subprocess.run([*compile_, "-x", "c++-header", str(first), "-o", str(read)], check=True)

    def build(name):
        return subprocess.run(
            [*compile_, "-include", str(first), "-c", str(HERE / f"{name}.cpp"),
             "-o", f"{work}/{name}.o"], capture_output=True, text=True)
    objects = [*BASE, *filters]
    read_now = {name: [(work / "detector" / file).read_text() for file in READ[name]] for name in BASE}
    to_build = [name for name in objects if name in filters or BUILT.get((work, name)) != read_now[name]]
    for name, done in zip(to_build, pool.map(build, to_build)):
        if done.returncode:
            return 1, f"{name} does not compile:\n{done.stderr[:2000]}"
    BUILT.update({(work, name): read_now[name] for name in BASE})
    # Functions that the filters do not call, such as those of integers, stay unresolved.
    subprocess.run([options.compiler, "-no-pie", "-Wl,--unresolved-symbols=ignore-all",
                    *[f"{work}/{name}.o" for name in objects], "-o", f"{work}/write_scripts"],
                   check=True)
    shutil.rmtree(work / "scripts", ignore_errors=True)
    (work / "scripts").mkdir()
    done = subprocess.run([f"{work}/write_scripts", f"{work}/scripts"], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def proof_of(script):
    done = subprocess.run(["gappa", str(script)], capture_output=True, text=True)
    errors = [line for line in done.stderr.split("\n") if line and "Warning" not in line]
    return script.name, done.returncode == 0, " ".join(errors)


def is_contradictory(script):
    """Returns whether the hypotheses contradict each other, so that the proof says nothing."""
    hypotheses, rest = script.read_text().split(" ->", 1)
    claim_of_nothing = script.with_suffix(".contradiction")
    claim_of_nothing.write_text(hypotheses + " -> 0 in [1,2]" + rest[rest.index(" }"):])
    return subprocess.run(["gappa", str(claim_of_nothing)], capture_output=True).returncode == 0


def open_scripts(work, pool, all_of_them=True):
    """Returns all scripts that Gappa does not prove, or the first of them, and the number of scripts."""
    found = []
    scripts = sorted((work / "scripts").glob("*.g"), key=lambda s: (len(s.name), s.name))
    step = len(scripts) if all_of_them else 2
    for begin in range(0, len(scripts), max(step, 1)):
        found += [p for p in pool.map(proof_of, scripts[begin:begin + step]) if not p[1]]
        if found:
            break
    return found, len(scripts)


def prove(options, pool):
    work = Path(options.work) / "as_is"
    copy(work, None)
    code, output = write_scripts(options, work, FILTERS, pool)
    print(output, end="", flush=True)
    started = time.monotonic()
    found, count = open_scripts(work, pool)
    for name, _, errors in found:
        print(f"not proved: {work}/scripts/{name}: {errors[:200]}")
    print(f"{count - len(found)} of {count} scripts proved in {time.monotonic() - started:.0f} s")
    by_claim = {}
    for script in sorted((work / "scripts").glob("*.g")):
        by_claim.setdefault(re.sub(r"-\d+\.g$", "", script.name), []).append(script)
    # One piece of code makes all scripts of a claim, so a few scripts of each claim are enough.
    some = [script for scripts in by_claim.values() for script in scripts[:4]]
    empty = [s.name for s, holds in zip(some, pool.map(is_contradictory, some)) if holds]
    empty += [] if is_contradictory(HERE / "contradiction.g") else ["contradiction.g is not seen"]
    for name in empty:
        print(f"contradictory hypotheses, so nothing is proved: {name}")
    missing = comparisons.faults(comparisons.sources_of(ROOT), set(by_claim))
    for fault in missing:
        print(fault)
    return code or (1 if found or missing or empty or count == 0 else 0)


def seen_in_list(change):
    """Returns the errors that a change of a source causes in the list of comparisons."""
    claims = {name for parts in comparisons.listed().values() for name in parts}
    sources = [(file, changed(text, change) if f"detector/{file}" == change["file"] else text)
               for file, text in comparisons.sources_of(ROOT)]
    return comparisons.faults(sources, claims - {"nothing"} - {c for c in claims if "lemma" in c})


def seen_by_proofs(options, change, pool):
    """Returns what Gappa does not prove of a changed source."""
    work = Path(options.work) / "changed"
    copy(work, change)
    code, output = write_scripts(options, work, change["filters"], pool)
    if "does not compile" in output:
        sys.exit(f"{change['about']}: {output}")
    if code not in (0, 1):
        sys.exit(f"{change['about']}: the program that writes scripts ended with {code}")
    if code:
        return [output.strip().split("\n")[-1]]
    found, _ = open_scripts(work, pool, all_of_them=False)
    return [f"{name}: {errors}" for name, _, errors in found]


def prove_changed(options, pool):
    missed = 0
    for change in json.loads(Path(options.changes).read_text()):
        seen = seen_by_proofs(options, change, pool) if "filters" in change else seen_in_list(change)
        print(f"{'red' if seen else 'MISSED'}: {change['file']}: {change['about']}"
              f" ({seen[0][:90] if seen else ''})", flush=True)
        missed += not seen
    print(f"{missed} changes missed")
    return 1 if missed else 0


def main():
    options = arguments()
    if not shutil.which("gappa"):
        sys.exit("gappa is not installed (Debian: gappa)")
    with ThreadPoolExecutor(options.jobs) as pool:
        return prove_changed(options, pool) if options.changes else prove(options, pool)


if __name__ == "__main__":
    sys.exit(main())
