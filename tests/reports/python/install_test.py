"""Tests the module that pip installs: it judges a class in Python. The test tests/consumer/installed
does the same with the module that CMake installs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import assay

SOURCES = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ["ASSAY_BUILD_DIR"])


def test_it_is_installed_by_pip(tmp_path):
    if BUILD != SOURCES / "build" / "release":
        pytest.skip("pip builds in build/release")
    wheel = "-m pip wheel --no-build-isolation --no-index --no-deps --wheel-dir".split()
    subprocess.run([sys.executable, *wheel, tmp_path, SOURCES], check=True)
    (file,) = tmp_path.glob(f"assay-{assay.__version__}-*.whl")
    venv = tmp_path / "venv"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", venv], check=True)
    subprocess.run([venv / "bin" / "pip", "install", "--no-index", file], check=True)
    variables = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    judge = [venv / "bin" / "python", SOURCES / "tests/consumer/installed/module.py", venv]
    subprocess.run(judge, cwd=tmp_path, env=variables, check=True)
    linked = venv / "lib" / f"python{sys.version_info.major}.{sys.version_info.minor}"
    package = linked / "site-packages" / "assay"
    # The installed module answers the installed conformance set.
    script = package / "share/assay/corpus/vectors/vectors.py"
    words = ["run", "--arithmetic", "exact", "--out", tmp_path / "results.json"]
    command = [venv / "bin" / "python", script, *words]
    ended = subprocess.run(command, env=variables, stdout=subprocess.PIPE, text=True, check=True)
    assert "Assay" in ended.stdout
    assert not (package / "share/assay/corpus/curated").is_symlink()
