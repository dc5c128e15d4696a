#!/usr/bin/env python3
"""Draws the figures of `assay bench --json` as SVG.

usage: benches.py FILE.json OUT.svg

For the suites speed-error and peers, draws speed against error, a point with intervals for each
subject: unsafe steps at the left, false alarms at the right. For the suite stability, draws the
share of right answers, a cell for each hard family and arithmetic. Equal figures give equal bytes.
"""
import json
import math
import sys
from html import escape
from pathlib import Path

# Colours that people who see colours differently can tell apart (Okabe and Ito, "Color Universal
# Design", 2008).
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, GREY = (
    "#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#777777")
ARITHMETICS = {"exact": BLUE, "bounded": GREEN, "double": ORANGE, "float": VERMILION}
CULLINGS = {"auto": "pentagon", "view-auto": "circle", "view-point": "up", "view-line": "down",
            "normal-cone": "diamond", "bvh": "square"}
PEER_COLOURS = [VERMILION, ORANGE, GREEN, PURPLE, SKY, GREY]
STYLE = """text { fill: #24292f } .axis { stroke: #57606a; fill: none } .grid { stroke: #d0d7de }
.on-light { fill: #24292f } .on-dark { fill: #ffffff }
@media (prefers-color-scheme: dark) {
text { fill: #e6edf3 } .axis { stroke: #9da7b1 } .grid { stroke: #3d444d } .on-light { fill: #24292f } }"""
# x and y of the corners, about the centre
SHAPES = {"square": [(-1, -1), (1, -1), (1, 1), (-1, 1)],
          "diamond": [(0, -1.4), (1.4, 0), (0, 1.4), (-1.4, 0)],
          "up": [(0, -1.3), (1.2, 0.9), (-1.2, 0.9)], "down": [(0, 1.3), (1.2, -0.9), (-1.2, -0.9)],
          "pentagon": [(math.sin(a), -math.cos(a)) for a in
                       (2 * math.pi * k / 5 for k in range(5))]}


def document(width, height, title, rows):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" role="img" font-family="sans-serif" font-size="13">\n'
            f'<title>{escape(title)}</title>\n<style>{STYLE}</style>\n' + "\n".join(rows) + "\n</svg>\n")


def text(x, y, words, anchor="start", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(words)}</text>'


def mark(x, y, shape, colour, hollow):
    look = f'fill="{"none" if hollow else colour}" stroke="{colour}" stroke-width="1.3"'
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.6" {look}/>'
    corners = " ".join(f"{x + 4.4 * i:.1f},{y + 4.4 * j:.1f}" for i, j in SHAPES[shape])
    return f'<polygon points="{corners}" {look}/>'


class Panel:
    """Times on a logarithmic scale, and percents on a scale that has 0 and shows small shares."""
    TOP, HEIGHT = 40, 360

    def __init__(self, left, width, times, most):
        self.left, self.width = left, width
        self.low, self.high = math.log(times[0] / 1.15), math.log(times[1] * 1.15)
        self.most = self.bent(most * 1.05)

    @staticmethod
    def bent(percent):
        return math.asinh(10 * percent)

    def x(self, times):
        return self.left + self.width * (math.log(times) - self.low) / (self.high - self.low)

    def y(self, percent):
        return self.TOP + self.HEIGHT * (1 - self.bent(percent) / self.most)

    def frame(self, title):
        bottom = self.TOP + self.HEIGHT
        rows = [text(self.left, self.TOP - 16, title)]
        for times in (.1, .2, .3, .5, .7, 1, 1.5, 2, 3, 5, 10, 20, 50, 100, 200, 500):
            if self.low <= math.log(times) <= self.high:
                rows += [f'<line class="grid" x1="{self.x(times):.1f}" x2="{self.x(times):.1f}" '
                         f'y1="{self.TOP}" y2="{bottom}"/>',
                         text(self.x(times), bottom + 18, f"{times:g}", "middle")]
        for percent in (0, .1, .3, 1, 3, 10, 30, 100):
            if self.bent(percent) <= self.most:
                y = self.y(percent)
                rows += [f'<line class="grid" x1="{self.left}" x2="{self.left + self.width}" '
                         f'y1="{y:.1f}" y2="{y:.1f}"/>', text(self.left - 8, y + 4, f"{percent:g}", "end")]
        rows.append(f'<path class="axis" d="M{self.left},{self.TOP} V{bottom} H{self.left + self.width}"/>')
        return rows

    def point(self, look, time, share):
        x, y = self.x(time["median"]), self.y(100 * share["share"])
        ends = [self.x(t) for t in time["interval"]]
        heights = [self.y(100 * s) for s in share["interval"]]
        line = f'stroke="{look[1]}" stroke-width="0.7" fill="none"'
        return [f'<path d="M{ends[0]:.1f},{y:.1f} H{ends[1]:.1f} M{x:.1f},{heights[0]:.1f} '
                f'V{heights[1]:.1f}" {line}/>', mark(x, y, *look)]


def looks_of(subjects, of_peers):
    """Returns each subject's shape, colour and hollowness. Exact arithmetic is hollow, so that it does
    not hide bounded arithmetic; so are detectors that do not claim free-sound."""
    looks = {}
    for place, subject in enumerate(subjects):
        if not of_peers:
            looks[subject["subject"]] = (CULLINGS[subject["culling"]], ARITHMETICS[subject["arithmetic"]],
                                         subject["arithmetic"] == "exact")
            continue
        shapes = list(CULLINGS.values())
        colour = BLUE if subject["is_built_in"] else PEER_COLOURS[place % len(PEER_COLOURS)]
        looks[subject["subject"]] = (shapes[(place + place // len(shapes)) % len(shapes)], colour,
                                     "free-sound" not in subject["claims"])
    return looks


def speed_against_error(report):
    of_peers = report["suite"] == "peers"
    subjects = [s for s in report["subjects"] if s["time_over_reference"] and s["counts"]["steps"]
                and (of_peers or s["pairs"] == "all" and s["culling"] in CULLINGS)]
    looks = looks_of(subjects, of_peers)
    times = [t for s in subjects for t in s["time_over_reference"]["interval"]] + [1]
    most = max([1] + [100 * s[e]["interval"][1] for s in subjects for e in ("unsafe", "alarming")])
    rows, width = [], 1110 if of_peers else 1080
    for left, error, title in ((60, "unsafe", "Unsafe: a contact or pair missed, or a time too late"),
                               (470, "alarming", "Alarming: a contact or a pair that does not exist")):
        panel = Panel(left, 360, (min(times), max(times)), most)
        rows += panel.frame(title)
        best = sorted((s for s in subjects if s[error]["on_pareto_line"]),
                      key=lambda s: s["time_over_reference"]["median"])
        if best:
            path = " ".join(("M" if not i else "H") + f'{panel.x(s["time_over_reference"]["median"]):.1f}' +
                            (f',{panel.y(100 * s[error]["share"]):.1f}' if not i else
                             f' V{panel.y(100 * s[error]["share"]):.1f}') for i, s in enumerate(best))
            rows.append(f'<path class="axis" stroke-dasharray="5 4" d="{path}"/>')
        for subject in subjects:
            rows += panel.point(looks[subject["subject"]], subject["time_over_reference"], subject[error])
    steps = max((s["counts"]["steps"] for s in subjects), default=0)
    rows.append(text(20, 220, f"% of {'the steps within the contract' if of_peers else f'{steps} steps'}",
                     "middle", ' transform="rotate(-90 20 220)"'))
    rows.append(text(445, 440, "time of a step over the time by exact arithmetic with a plain box tree (bvh)",
                     "middle"))
    if of_peers:
        legend = [(looks[s["subject"]], s["subject"]) for s in subjects]
    else:
        legend = [(("circle", colour, name == "exact"), name) for name, colour in ARITHMETICS.items()]
        legend += [((shape, "#777777", False), name) for name, shape in CULLINGS.items()]
        rows.append('<path class="axis" stroke-dasharray="5 4" d="M838,250 h18"/>' +
                    text(864, 254, "Pareto line"))
    for i, (look, words) in enumerate(legend):
        rows += [mark(847, 50 + 20 * i, *look), text(864, 54 + 20 * i, words)]
    return document(width, 460, "Speed against error", rows)


def heat(report):
    """Draws a cell for each family and arithmetic: dark if nothing is right, light if all is."""
    sums = {}
    for cell in report["heat"]:
        one = sums.setdefault((cell["family"], cell["arithmetic"]), [0, 0, 0])
        for i, n in enumerate((cell["cases"], cell["right"], cell["errors"]["missed"])):
            one[i] += n
    families = list(dict.fromkeys(f for f, _ in sums))
    arithmetics = list(dict.fromkeys(a for _, a in sums))
    left, top, width, row = 220, 40, 150, 24
    rows = [text(left + width * (j + .5), top - 12, a, "middle") for j, a in enumerate(arithmetics)]
    for i, family in enumerate(families):
        y = top + row * i
        rows.append(text(left - 10, y + 16, family, "end"))
        for j, arithmetic in enumerate(arithmetics):
            cases, right, missed = sums[family, arithmetic]
            share = right / cases
            # 100 % is said only if every case is right.
            words = f"{100 if right == cases else min(99.9, 100 * share):.3g} %"
            words += f"   {missed} missed" if missed else ""
            colour = "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in
                                   zip((68, 1, 84), (253, 231, 160)))
            rows.append(f'<rect x="{left + width * j}" y="{y}" width="{width - 2}" height="{row - 2}" '
                        f'fill="{colour}"/>')
            rows.append(text(left + width * (j + .5), y + 16, words, "middle",
                             f' class="{"on-light" if share > .5 else "on-dark"}"'))
    return document(left + width * len(arithmetics) + 20, top + row * len(families) + 20,
                    "The share of hard cases that each arithmetic answers right", rows)


def main():
    if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
        print(__doc__.strip())
        return 0 if "--help" in sys.argv else 2
    try:
        report = json.loads(Path(sys.argv[1]).read_text())
    except (OSError, ValueError) as problem:
        print(f"{sys.argv[1]}: {problem}", file=sys.stderr)
        return 2
    if not isinstance(report, dict) or report.get("schema") != "assay-bench/2":
        print(f"{sys.argv[1]}: not a report of assay bench (assay-bench/2)", file=sys.stderr)
        return 2
    draw = {"speed-error": speed_against_error, "peers": speed_against_error,
            "stability": heat}.get(report.get("suite"))
    if not draw:
        print(f"suite {report['suite']} has no picture", file=sys.stderr)
        return 2
    Path(sys.argv[2]).write_text(draw(report))
    return 0


if __name__ == "__main__":
    sys.exit(main())
