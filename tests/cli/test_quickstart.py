# SPDX-License-Identifier: GPL-3.0-or-later
"""What ./quickstart --build-only leaves in a clone: the program, and a Python module that can be imported and installed.

Compiled objects are taken from the build under test, by a compiler launcher, where it has one of the same name: everything else is done
as in a clone."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ["COAGULA_BUILD"])
NOT_CLONED = shutil.ignore_patterns("build-*", ".git", ".cache", "node_modules", "__pycache__")
LAUNCHER = """#!/bin/bash
# LAUNCHER COMPILER WORDS...: copies the object from the build under test, or compiles it.
for ((i = 1; i < $#; i++)); do
  case "${!i}" in -o) next=$((i + 1)) object="${!next}" ;; -MF) next=$((i + 1)) dependencies="${!next}" ;; esac
done
case "$object" in
  *.gch) : >"$object" ;; # objects that are copied need none, and the compiler reads the header instead of an empty one
  *.o) cp "$TAKEN_FROM/$object" "$object" 2>/dev/null || exec "$@" ;;
  *) exec "$@" ;;
esac
echo "$object:" >"$dependencies"
"""


def not_cloned(folder, names):
    return {*NOT_CLONED(folder, names), *({"build", "out"} if Path(folder) == ROOT else ())}


def cached(name):
    """A variable of the CMake cache of the build under test."""
    lines = (BUILD / "CMakeCache.txt").read_text().splitlines()
    return next(line.split("=", 1)[1] for line in lines if line.startswith(f"{name}:"))


class Quickstart(unittest.TestCase):
    def setUp(self):
        folder = Path(tempfile.mkdtemp(prefix="coagula-quickstart-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        self.clone, self.prefix, launcher = folder / "clone", folder / "prefix", folder / "launcher"
        shutil.copytree(ROOT, self.clone, ignore=not_cloned)
        shutil.copytree(ROOT / "build/web", self.clone / "build/web", copy_function=shutil.copy)  # it would come from the network
        launcher.write_text(LAUNCHER)
        launcher.chmod(0o755)
        options = [f"-D{name}={cached(name)}" for name in ("COAGULA_UNITY", "COAGULA_WARNINGS_AS_ERRORS")]
        self.environment = {**os.environ, "TAKEN_FROM": str(BUILD),
                            "COAGULA_CMAKE_OPTIONS": " ".join([*options, f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}"])}

    def call(self, *words, **more):
        done = subprocess.run(list(map(str, words)), cwd=self.clone, env={**self.environment, **more}, capture_output=True, text=True,
                              timeout=280)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def check_module(self, place):
        said = self.call("/usr/bin/python3", "-c", "import coagula; print(coagula.generate_vem(particles=60, voids=30, "
                         "volume_fraction=0.4, radius='0.25um').particles, coagula.__file__)", PYTHONPATH=str(place))
        particles, file = said.split()
        self.assertEqual((particles, Path(file)), ("60", place / "coagula/__init__.py"))

    def test_build_only(self):
        self.call("./quickstart", "--build-only")
        self.assertIn("coagula", self.call("build/bin/coagula", "--version"))
        self.check_module(self.clone / "build/python")
        self.call("cmake", "--install", "build", "--prefix", self.prefix)
        installed = next(self.prefix.glob("lib/python3*/dist-packages"))
        self.check_module(installed)

        # A build without the module leaves nothing of it behind, not even a folder that Python takes for an empty package.
        shutil.rmtree(self.prefix)
        for file in (self.clone / "build/python/coagula").iterdir():
            file.unlink()
        self.assertIn("Left out, as it is not built: the Python module", self.call("cmake", "--install", "build", "--prefix", self.prefix))
        self.assertEqual(list(self.prefix.glob("lib/python3*")), [])


if __name__ == "__main__":
    unittest.main()
