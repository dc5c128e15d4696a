#!/usr/bin/env python3
"""Measures the time of whole sequences with culling auto and with bvh, for the top README.

usage: sequences.py ASSAY OUT.svg [--data DIR] [--scenes NAME...] [--rounds N]

Each scene has 19 steps. It has about 20,000 triangles, or fewer if its contacts grow with the
square of the triangles. Both cullings go through a sequence in turn, N times, in one thread, in
exact arithmetic and with all pairs. The time of a step is the least of its N times, because other
work of the machine only adds time. Prints a line for each sequence. OUT.svg is the chart.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

FRAMES, TRIANGLES = 20, 20_000
SIZES = {"inverted-sleeve": 2_000, "winding-spiral": 4_000}
SCENES = ["breathing-sphere", "two-spheres", "dented-sphere", "bend", "twist", "open-tube",
          "pinching-torus", "folding-sheet", "crumpling-sphere", "arm-in-box", "ball-in-tube",
          "inverted-sleeve", "crossing-fans", "winding-spiral"]
PUBLIC = {"kick (a real shell)": "codim-ipc-kick/*.obj.gz"}

ROW, LEFT, WIDTH, RIGHT, TOP = 22, 170, 420, 60, 30
STYLE = """text { fill: #24292f } .ones { text-anchor: end } .bar { fill: #0072b2 }
.line { stroke: #57606a; stroke-width: 1 }
@media (prefers-color-scheme: dark) {
text { fill: #e6edf3 } .bar { fill: #56b4e9 } .line { stroke: #9da7b1 } }"""


def step_times(assay, frames, culling, folder):
    """Returns the milliseconds of each step, and the number of triangles."""
    report = folder / "report.json"
    subprocess.run([assay, "check", "--no-oracle", "--threads", "1", "--culling", culling,
                    "--json", report, *frames], check=True, stdout=subprocess.DEVNULL)
    read = json.loads(report.read_text())
    return [step["times_ms"]["total"] for step in read["steps"]], read["triangles"]


class Sequence:
    def __init__(self, name, assay, frames, rounds, folder):
        self.name = name
        least = {}
        for _ in range(rounds):
            for culling in ("bvh", "auto"):
                times, self.triangles = step_times(assay, frames, culling, folder)
                least[culling] = [*map(min, times, least.get(culling, times))]
        self.steps = len(least["bvh"])
        self.bvh, self.auto = (sum(least[c]) / self.steps for c in ("bvh", "auto"))
        self.faster = self.bvh / self.auto

    def line(self):
        return (f"{self.name:<20} {self.triangles:>9} {self.steps:>5} {self.bvh:>8.3g}"
                f" {self.auto:>8.3g} {self.faster:>8.3g}")


def chart(sequences):
    """Draws bars that begin at 1, on a logarithmic scale."""
    most = max(100.0, *(s.faster for s in sequences))
    least = min(0.8, *(s.faster for s in sequences))

    def x(times):
        return LEFT + WIDTH * math.log(times / least) / math.log(most / least)

    height = TOP + ROW * len(sequences) + 10
    rows = []
    for mark in (1, 2, 5, 10, 20, 50, 100):
        rows.append(f'<line class="line" x1="{x(mark):.1f}" x2="{x(mark):.1f}" y1="{TOP}" '
                    f'y2="{height - 10}" stroke-opacity="{1 if mark == 1 else 0.3}"/>'
                    f'<text x="{x(mark):.1f}" y="{TOP - 8}" text-anchor="middle">{mark}</text>')
    for i, s in enumerate(sequences):
        y = TOP + ROW * i + 4
        begin, end = sorted((x(1), x(s.faster)))
        rows.append(f'<text class="ones" x="{LEFT - 10}" y="{y + 12}">{s.name}</text>'
                    f'<rect class="bar" x="{begin:.1f}" y="{y}" width="{max(end - begin, 1):.1f}" '
                    f'height="{ROW - 8}"/>'
                    f'<text x="{end + 6:.1f}" y="{y + 12}">{s.faster:.3g}</text>')
    width = LEFT + WIDTH + RIGHT
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" role="img" font-family="sans-serif" font-size="14">\n'
            f'<title>How many times faster auto is than bvh, by sequence</title>\n'
            f'<style>{STYLE}</style>\n' + "\n".join(rows) + "\n</svg>\n")


def main():
    p = argparse.ArgumentParser(description="Times whole sequences with culling auto and with culling bvh")
    p.add_argument("assay")
    p.add_argument("out", type=Path)
    p.add_argument("--data", type=Path, default=Path("../shared/data"))
    p.add_argument("--scenes", nargs="*", default=SCENES)
    p.add_argument("--rounds", type=int, default=5)
    options = p.parse_args()
    sequences = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for scene in options.scenes:
            place = folder / scene
            subprocess.run([options.assay, "scene", scene, "--size",
                            str(SIZES.get(scene, TRIANGLES)), "--frames", str(FRAMES), "--out",
                            place], check=True, stdout=subprocess.DEVNULL)
            sequences.append(Sequence(scene, options.assay, sorted(place.glob("*.ply")),
                                      options.rounds, folder))
        for what, files in PUBLIC.items():
            if frames := sorted(options.data.glob(files)):
                sequences.append(Sequence(what, options.assay, frames, options.rounds, folder))
            else:
                print(f"no data: {options.data / files}", file=sys.stderr)
    sequences.sort(key=lambda s: -s.faster)
    print(f"{'sequence':<20} {'triangles':>9} {'steps':>5} {'bvh ms':>8} {'auto ms':>8} {'faster':>8}")
    print("\n".join(s.line() for s in sequences))
    options.out.write_text(chart(sequences))
    return 0


if __name__ == "__main__":
    sys.exit(main())
