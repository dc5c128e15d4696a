#!/usr/bin/env python3
"""Tests that reports/pictures/benches.py draws every point with its intervals, with the same bytes each time."""
import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

PICTURES = Path(__file__).resolve().parents[3] / "reports/pictures"


def share(value, is_best):
    return {"share": value, "interval": [value / 2, value + .01], "on_pareto_line": is_best}


def subject(name, times, unsafe, **more):
    arithmetic, culling, pairs = name.split()
    return {"subject": name, "arithmetic": arithmetic, "culling": culling, "pairs": pairs,
            "is_built_in": True, "claims": ["free-sound"], "counts": {"steps": 321},
            "time_over_reference": {"median": times, "interval": [.9 * times, 1.1 * times]},
            "unsafe": share(unsafe, True), "alarming": share(0, True), **more}


SUBJECTS = [subject("exact bvh all", 1, 0), subject("double view-auto all", .5, .125),
            subject("double view-auto first", .4, .125)]
REPORTS = {
    "speed-error": {"suite": "speed-error", "subjects": SUBJECTS},
    "peers": {"suite": "peers", "subjects": [
        *SUBJECTS, subject("float none all", 9, .5, subject="Somebody's <CCD>", is_built_in=False, claims=[])]},
    "stability": {"suite": "stability", "heat": [
        {"family": "slivers", "arithmetic": "double", "cases": 3, "right": right,
         "errors": {"missed": 3 - right}} for right in (3, 1)]}}


class Benches(unittest.TestCase):
    def draw(self, report):
        with tempfile.TemporaryDirectory() as folder:
            given, drawn = Path(folder) / "report.json", Path(folder) / "picture.svg"
            given.write_text(json.dumps({"schema": "assay-bench/2", **report}))
            done = subprocess.run([sys.executable, PICTURES / "benches.py", given, drawn],
                                  capture_output=True, text=True)
            return done.returncode, drawn.read_text() if drawn.exists() else done.stderr

    def test_every_picture_is_drawn_alike(self):
        for suite, report in REPORTS.items():
            code, svg = self.draw(report)
            self.assertEqual((code, svg), self.draw(report), suite)
            self.assertEqual(code, 0, svg)
            xml.fromstring(svg)
            self.assertIn("prefers-color-scheme: dark", svg)
            self.assertNotIn("nan", svg)

    def test_a_point_for_each_subject_in_each_panel(self):
        svg = self.draw(REPORTS["speed-error"])[1]
        # Two subjects are asked for all pairs; a square and a circle stand in the legend, too.
        self.assertEqual(svg.count('stroke-width="0.7"'), 4)
        self.assertIn("% of 321 steps", svg)
        self.assertEqual(svg.count("Pareto line"), 1)
        self.assertIn("Somebody's &lt;CCD&gt;".replace("'", "&#x27;"), self.draw(REPORTS["peers"])[1])

    def test_cells_are_sums(self):
        self.assertIn("66.7 %   2 missed", self.draw(REPORTS["stability"])[1])

    def test_a_suite_without_a_picture_is_named(self):
        self.assertEqual(self.draw({"suite": "sequences"}), (2, "suite sequences has no picture\n"))
        code, told = self.draw({"schema": "assay-bench/1", "suite": "peers"})
        self.assertEqual((code, told.count("\n")), (2, 1), told)

    # On a dark page a white ground is a slab, and dark letters are not seen.
    def test_committed_pictures_know_both_schemes(self):
        for name in ("peers", "speed-error", "sequences"):
            self.assertIn("prefers-color-scheme: dark", (PICTURES / f"{name}.svg").read_text(), name)


if __name__ == "__main__":
    unittest.main()
