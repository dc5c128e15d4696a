#!/usr/bin/env python3
"""Looks for contracted operations (a product and a sum rounded once) in the detector's object code, and for
functions that code for one instruction set shares with other code."""
import argparse
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# Sources with filters, which are compiled once more for a machine that has contracted operations.
FILTERS = ["contact/contact_doubles.cpp", "contact/contact_fixed.cpp", "lanes_avx2.cpp", "lanes_avx512.cpp",
           "distance/near_filter.cpp", "distance/nearness.cpp",
           "geometry/orientation.cpp", "geometry/winding.cpp", "boxes/moving_box.cpp",
           "search/feature_pairs.cpp", "traditional/moving_contour.cpp", "view/view_bounds.cpp",
           "view/view_filter.cpp"]
# Contracted operations of x86-64 (vfmadd213pd, vfnmsub...) and of 64-bit ARM (fmadd, fmla, fmls...).
CONTRACTED = re.compile(r"\t(vf(n?m(add|sub)|maddsub|msubadd)\w*|fn?m(add|sub|la|ls)\w*)\b")


def arguments():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--build", required=True, help="build tree")
    p.add_argument("--objdump", default="objdump")
    return p.parse_args()


def contracted(options, file):
    done = subprocess.run([options.objdump, "-d", "--no-show-raw-insn", str(file)], check=True,
                          capture_output=True, text=True)
    if "\tret" not in done.stdout:
        sys.exit(f"{file}: no code in it")
    return len(CONTRACTED.findall(done.stdout))


def compile_command(options, source, extra, out):
    """Returns the command of the build, changed to compile for a machine with contracted operations."""
    for entry in json.loads((Path(options.build) / "compile_commands.json").read_text()):
        if not entry["file"].endswith(f"/detector/{source}"):
            continue
        words = shlex.split(entry["command"])
        compiler = next(i for i, w in enumerate(words) if w.startswith("-")) - 1
        kept, skip = [], False
        for word in words[compiler:]:
            if skip or word in ("-o", "-include", "-c"):
                skip = not skip and word != "-c"
            elif not word.startswith("-W") and word != entry["file"]:
                kept.append(word)
        return kept + ["-w", "-mfma", *extra, "-c", entry["file"], "-o", str(out)]
    sys.exit(f"{source}: not in compile_commands.json")


def main():
    options = arguments()
    build = Path(options.build).resolve()
    work = build / "tests/bounds/contracted"
    work.mkdir(parents=True, exist_ok=True)
    failed = contracted(options, build / "detector/libassay_detector.a")
    print(f"libassay_detector.a: {failed} contracted operations")

    def compiled(source, extra=()):
        out = work / (Path(source).stem + ".o")
        subprocess.run(compile_command(options, source, extra, out), check=True, cwd=build)
        return contracted(options, out)
    with ThreadPoolExecutor(2) as pool:
        for source, count in zip(FILTERS, pool.map(compiled, FILTERS)):
            if count:
                print(f"{source}: {count} contracted operations where the machine has them")
            failed += count
    # A linker keeps one of all copies of an inline function. If this copy is compiled for one instruction
    # set, the program crashes on a machine without this set.
    for source in sorted(Path(__file__).resolve().parents[2].glob("detector/*/**/*_avx*.cpp")):
        out = work / (source.stem + ".O0.o")
        name = str(source).split("/detector/")[1]
        subprocess.run(compile_command(options, name, ["-O0"], out), check=True, cwd=build)
        symbols = subprocess.run(["nm", "-C", str(out)], check=True, capture_output=True, text=True)
        for line in re.findall(r" [WVu] .*", symbols.stdout):
            failed += 1
            print(f"{name}: holds what other files may hold, too:{line}")
    # This checks that a contracted operation is found.
    if not compiled("contact/contact_doubles.cpp", ["-ffp-contract=fast"]):
        sys.exit("contact_doubles.cpp: nothing is contracted where it may be; what is looked for here?")
    print("red: contact_doubles.cpp with contraction allowed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
