"""What setuptools builds of the package is built by CMake, in build/release as ever."""

import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCES = Path(__file__).resolve().parent
BUILD = SOURCES / "build" / "release"


class BuildByCMake(build_ext):
    """Modules, the plug-in that serves detectors in Python, and the programs beside them."""

    def run(self):
        # That of a virtual environment is a link to it; then nothing is configured anew.
        python = getattr(sys, "_base_executable", sys.executable)
        configure = ["cmake", "--preset", "release", f"-DASSAY_PYTHON={python}"]
        subprocess.run(configure, cwd=SOURCES, check=True)
        build = ["cmake", "--build", str(BUILD), "--target", "assay_python"]
        subprocess.run(build, cwd=SOURCES, check=True)
        package = Path(self.build_lib, "assay")
        (package / "bin").mkdir(parents=True, exist_ok=True)
        for library in (BUILD / "python" / "assay").glob("*.so"):
            shutil.copy2(library, package)
        for program in ("assay", "assay-worker"):
            shutil.copy2(BUILD / program, package / "bin")


(SOURCES / "build").mkdir(exist_ok=True)
setup(
    # It says that there is something to compile; what it is, CMake knows.
    ext_modules=[Extension("assay._detector", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": "build/pip"}, "egg_info": {"egg_base": "build"}},
)
