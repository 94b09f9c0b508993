# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python module share: the program beside it, and exact comparison with what that says."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import coagula

PROGRAM = os.environ["COAGULA_PROGRAM"]
DATASETS = Path(os.environ["COAGULA_DATASETS"])
VEM = {"particles": 200, "voids": 100, "volume_fraction": 0.4, "radius": "0.25um", "seed": 1}
# Of a call of the program, not of the result.
OF_THE_CALL = {"output", "seconds", "notes", "report", "extended_model"}


def options(given):
    """Keyword arguments as options of the program."""
    words = []
    for name, value in given.items():
        words += ["--" + name.replace("_", "-")] + ([] if value is True else [str(value)])
    return words


class ModuleTest(unittest.TestCase):
    """Each test has an empty folder, which is also its working directory."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="coagula-python-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=200,
                              stdin=subprocess.DEVNULL)

    def program(self, *words):
        done = self.run_program(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def assert_same(self, said, result, path=""):
        """Every value that the program prints is that of the result, bit for bit; null is None or a number that is not finite."""
        for key, value in said.items():
            if path == "" and key in OF_THE_CALL:
                continue
            place = f"{path}/{key}"
            self.assertIn(key, result, place)
            mine = result[key]
            if isinstance(value, dict):
                self.assert_same(value, mine, place)
            elif value is None:
                self.assertTrue(mine is None or mine == -1 or not np.isfinite(mine), place)
            elif isinstance(mine, list):
                self.assertEqual(len(value), len(mine), place)
                for one, other in zip(value, mine):
                    if isinstance(one, dict):
                        self.assert_same(one, other, place)
                    else:
                        self.assertEqual(one, other, place)
            elif isinstance(mine, np.ndarray):
                np.testing.assert_array_equal(np.array(value, dtype=float), np.array(mine, dtype=float), place)
            else:
                self.assertEqual(value, mine, place)

    @staticmethod
    def made(**changes):
        return coagula.generate_vem(**{**VEM, **changes})
