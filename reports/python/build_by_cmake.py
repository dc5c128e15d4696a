"""Makes setuptools build the package by CMake, in build/release."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools.command.build_py import build_py
from setuptools.command.egg_info import egg_info
from wheel.bdist_wheel import bdist_wheel

SOURCES = Path(__file__).resolve().parents[2]
BUILD = SOURCES / "build" / "release"


class BuildPy(build_py):
    """Builds the package with its modules, the plug-in that serves detectors in Python, the
    programs, and the files that the programs read."""

    def run(self):
        super().run()
        # The Python of a virtual environment is a link to this one; so nothing is configured anew.
        python = getattr(sys, "_base_executable", sys.executable)
        configure = ["cmake", "--preset", "release", f"-DASSAY_PYTHON={python}"]
        subprocess.run(configure, cwd=SOURCES, check=True)
        build = ["cmake", "--build", str(BUILD), "--target", "assay_python"]
        subprocess.run(build, cwd=SOURCES, check=True)
        package = Path(self.build_lib, "assay")
        (package / "bin").mkdir(parents=True, exist_ok=True)
        for module in ("_detector", "_recorder", "_judge", "python_detector"):
            for library in (BUILD / "python" / "assay").glob(f"{module}.*so"):
                shutil.copy2(library, package)
        for program in ("assay", "assay-worker"):
            shutil.copy2(BUILD / program, package / "bin")
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(["cmake", "--install", str(BUILD), "--prefix", prefix], check=True)
            shutil.copytree(Path(prefix, "share", "assay"), package / "share" / "assay", dirs_exist_ok=True)


class EggInfo(egg_info):
    """Keeps its files in build, so that nothing is written beside the sources."""

    def finalize_options(self):
        if self.egg_base is None:
            self.egg_base = str(SOURCES / "build")
            Path(self.egg_base).mkdir(exist_ok=True)
        super().finalize_options()


class BdistWheel(bdist_wheel):
    """Names the wheel for this Python and this machine, because it has compiled files."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False
