#!/usr/bin/env python3
"""Runs every test that reads public data without these data: each test must be skipped.

usage: tests/without_data.py CTEST BUILD

These are the tests whose suite or name begins with `Public`, and python_public_data_test.
In turn, ASSAY_DATA is not set, is empty, and names no folder.
"""

import json
import os
import re
import subprocess
import sys

ctest, build = sys.argv[1:]
listed = subprocess.run(
    [ctest, "--test-dir", build, "--show-only=json-v1", "-R", r"(^|\.)(Public|python_public)"],
    capture_output=True, check=True, text=True).stdout
tests = [test for test in json.loads(listed)["tests"] if "command" in test]
if len(tests) < 15:
    sys.exit(f"only {len(tests)} tests read public data: are they named so, and built?")

failed = 0
for surroundings in ({}, {"ASSAY_DATA": ""}, {"ASSAY_DATA": "/nowhere"}):
    for test in tests:
        environment = {k: v for k, v in os.environ.items() if k != "ASSAY_DATA"} | surroundings
        for name_of in test.get("properties", []):
            if name_of["name"] == "ENVIRONMENT":
                environment |= dict(one.split("=", 1) for one in name_of["value"])
        ran = subprocess.run(test["command"], capture_output=True, text=True, env=environment)
        if ran.returncode or not re.search(r"\[  SKIPPED \] 1 test|^\d+ skipped in", ran.stdout, re.M):
            failed += 1
            print(f"{test['name']} is not skipped with {surroundings or 'no ASSAY_DATA'}:")
            print(ran.stdout[-1000:] + ran.stderr[-1000:])
print(f"{len(tests)} tests read public data; without it, {failed} were not skipped")
sys.exit(failed > 0)
