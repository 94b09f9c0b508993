# SPDX-License-Identifier: GPL-3.0-or-later
"""pip installs the module, here from the build folder that exists: the package is whole and runs away from the sources."""

import importlib.util
import os
import subprocess
import sys
import unittest
from pathlib import Path

from support import ModuleTest

ROOT = Path(__file__).resolve().parent.parent.parent
BUILD = os.environ["COAGULA_BUILD"]


@unittest.skipIf(importlib.util.find_spec("pip") is None or importlib.util.find_spec("setuptools") is None, "needs pip and setuptools")
class Pip(ModuleTest):
    def pip(self, **environment):
        return subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index", "--target",
                               self.folder / "installed", ROOT], env={**os.environ, **environment}, capture_output=True, text=True)

    def test_install(self):
        done = self.pip(COAGULA_BUILD=BUILD)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        installed = {path.name for path in (self.folder / "installed/coagula").iterdir()}
        self.assertLessEqual({"__init__.py", "__init__.pyi", "py.typed", "_calls.py"}, installed)
        code = ("import coagula; made = coagula.generate_vem(particles=100, voids=50, volume_fraction=0.4, radius='1um'); "
                "print(coagula.__file__, coagula.characterize(made, only='coordination').coordination)")
        ran = subprocess.run([sys.executable, "-c", code], cwd=self.folder, env={**os.environ, "PYTHONPATH": str(self.folder / "installed")},
                             capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        place, coordination = ran.stdout.split()
        self.assertEqual(Path(place).parent, self.folder / "installed/coagula")
        self.assertGreater(float(coordination), 3)
        self.assertEqual(list(ROOT.glob("*.egg-info")), [])


if __name__ == "__main__":
    unittest.main()
