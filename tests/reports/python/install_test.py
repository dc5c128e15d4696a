"""The module installed by CMake and by pip: a detector in Python is judged by what was installed."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import assay

SOURCES = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ["ASSAY_BUILD_DIR"])

JUDGE = """
    import assay, sys
    from assay.places import program

    class Mine:
        claims = ["free-sound", "total"]
        def create(self, triangles, positions):
            self.detector = assay.Detector(triangles, positions)
        def evaluate(self, x_t0, x_t1):
            return self.detector.evaluate(x_t0, x_t1)

    if __name__ == "__main__":
        triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
        frames = triangles, [[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, z]] for z in (1, -1)]
        print(assay.__file__, program(), assay.check(frames, Mine).outcome, sep="\\n")
"""


def judged_by(python, folder, tmp_path, path=""):
    """What is installed below the folder judges; nothing else is found."""
    (tmp_path / "script.py").write_text(textwrap.dedent(JUDGE))
    variables = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    if path:
        variables["PYTHONPATH"] = path
    command = [python, "script.py"]
    ended = subprocess.run(
        command, cwd=tmp_path, env=variables, stdout=subprocess.PIPE, text=True, check=True
    )
    package, program, outcome = ended.stdout.split("\n")[:3]
    assert outcome == "holds"
    for place in (package, program):
        assert str(folder) in str(Path(place).resolve())


def test_it_is_installed_by_cmake(tmp_path):
    prefix = tmp_path / "prefix"
    subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix], check=True)
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages = prefix / "lib" / version / "dist-packages"
    judged_by(sys.executable, prefix, tmp_path, str(packages))


def test_it_is_installed_by_pip(tmp_path):
    if BUILD != SOURCES / "build" / "release":
        pytest.skip("pip builds in build/release")
    wheel = "-m pip wheel --no-build-isolation --no-index --no-deps --wheel-dir".split()
    subprocess.run([sys.executable, *wheel, tmp_path, SOURCES], check=True)
    (file,) = tmp_path.glob(f"assay-{assay.__version__}-*.whl")
    venv = tmp_path / "venv"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", venv], check=True)
    subprocess.run([venv / "bin" / "pip", "install", "--no-index", file], check=True)
    judged_by(venv / "bin" / "python", venv, tmp_path)
    # The command reads the corpus that came with it.
    score = [venv / "bin" / "assay", "score", SOURCES / "corpus/vectors/results/assay_exact.json"]
    ended = subprocess.run(score, cwd=tmp_path, stdout=subprocess.PIPE, text=True, check=True)
    assert "Assay" in ended.stdout
    linked = venv / "lib" / f"python{sys.version_info.major}.{sys.version_info.minor}"
    package = linked / "site-packages" / "assay"
    assert not (package / "share/assay/corpus/curated").is_symlink()
