"""Builds the extension by CMake for `pip install .`; everything else is said in pyproject.toml.

COAGULA_BUILD=FOLDER takes the module from a build folder that exists, such as that of ./quickstart, instead of building all of it again."""

import os
import re
import shutil
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
        extension = Path(self.get_ext_fullpath(ext.name)).resolve()
        if folder := os.environ.get("COAGULA_BUILD"):
            self.take(Path(folder).resolve(), extension)
        else:
            self.build(Path(self.build_temp).resolve(), extension.parent)

    def build(self, build, package):
        subprocess.run([ROOT / "scripts/bundle-web"], check=True)
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCOAGULA_TESTS=OFF",
                        "-DCOAGULA_UNITY=ON", "-DCOAGULA_PYTHON_MODULE=ON", f"-DPython_EXECUTABLE={sys.executable}",
                        f"-DCOAGULA_PYTHON_FOLDER={package.parent}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "coagula_python_package"], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python"], check=True, env={**os.environ, "DESTDIR": ""})

    def take(self, build, extension):
        subprocess.run(["cmake", "--build", build, "--target", "coagula_python_package"], check=True)
        made = build / "python/coagula"
        if not (made / extension.name).exists():
            sys.exit(f"{made} has no {extension.name}: that build is for another Python than {sys.executable}")
        shutil.copytree(made, extension.parent, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))


# All that setuptools leaves goes into a folder of its own: build/ is that of the program.
FOLDER = ROOT / "build-pip"
FOLDER.mkdir(exist_ok=True)
setup(version=version(), packages=[], ext_modules=[Extension("coagula._coagula", [])], cmdclass={"build_ext": CMakeBuild},
      options={"build": {"build_base": str(FOLDER)}, "egg_info": {"egg_base": str(FOLDER)}})
