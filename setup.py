"""Builds the extension by CMake for `pip install .`; everything else is said in pyproject.toml."""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


def version():
    """The version that CMakeLists.txt gives the project."""
    return re.search(r"project\(coagula VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


class CMakeBuild(build_ext):
    """The package as CMake makes it: the extension, the Python files and the stubs."""

    def build_extension(self, ext):
        build = Path(self.build_temp).resolve()
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent
        subprocess.run([ROOT / "scripts/bundle-web"], check=True)
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCOAGULA_TESTS=OFF",
                        "-DCOAGULA_UNITY=ON", "-DCOAGULA_PYTHON_MODULE=ON", f"-DPython_EXECUTABLE={sys.executable}",
                        f"-DCOAGULA_PYTHON_FOLDER={target.parent}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "coagula_python_package"], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python"], check=True, env={**os.environ, "DESTDIR": ""})


setup(version=version(), packages=[], ext_modules=[Extension("coagula._coagula", [])], cmdclass={"build_ext": CMakeBuild})
