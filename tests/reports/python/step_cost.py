"""Measures the time of assay.Detector.step over that of the C++ call inside, on the public rod-twist step.

usage: ASSAY_DATA=FOLDER PYTHONPATH=build/release/python /usr/bin/python3 tests/reports/python/step_cost.py

Each of 15 steps is timed outside by the clock, and inside by the result. Prints the median of the ratios,
with its 95 % confidence interval (order statistics).
"""

import os
import time

import assay

STEPS = 15
# The 4th and the 12th of 15: the median lies between them in 96.5 of 100 samples.
LOW, HIGH = 3, 11

folder = os.path.join(os.environ["ASSAY_DATA"], "scalable-ccd", "rod-twist", "frames")
frames = assay.read_frames([os.path.join(folder, f"{k}.ply") for k in (3036, 3037)])
detector = assay.Detector(frames.triangles, frames.positions[0])
detector.step(*frames.positions)

ratios, inside = [], []
for _ in range(STEPS):
    detector.reset()
    begin = time.perf_counter()
    result = detector.step(*frames.positions)
    outside = (time.perf_counter() - begin) * 1e3
    inside.append(result.milliseconds.total)
    ratios.append(outside / result.milliseconds.total)
ratios.sort()
print(f"{len(frames.triangles)} triangles, {sorted(inside)[STEPS // 2]:.1f} ms a step in C++")
print(f"Python over C++: {ratios[STEPS // 2]:.4f} [{ratios[LOW]:.4f}, {ratios[HIGH]:.4f}]")
