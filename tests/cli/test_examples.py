# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs in examples/ run, and say what they promise. The C++ one is built in test_install."""

import os
import re
import subprocess
import unittest
from pathlib import Path

from support import PROGRAM, ProgramTest

EXAMPLES = Path(__file__).resolve().parent.parent.parent / "examples"
MODULE = Path(os.environ["COAGULA_PYTHON_PACKAGE"]) if "COAGULA_PYTHON_PACKAGE" in os.environ else Path(PROGRAM).parent.parent / "python"


class Examples(ProgramTest):
    def printed_by(self, *command):
        environment = {**os.environ, "PATH": f"{Path(PROGRAM).parent}:{os.environ['PATH']}", "PYTHONPATH": str(MODULE)}
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env=environment, timeout=250)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def example(self, name):
        if not (MODULE / "coagula" / "__init__.py").exists():
            self.skipTest("the Python module is not built")
        return self.printed_by("/usr/bin/python3", str(EXAMPLES / name))

    def test_every_example_has_its_test(self):
        tested = Path(__file__).read_text()
        for program in EXAMPLES.glob("*.[ps][yh]"):
            self.assertIn(f'"{program.name}"', tested)
            self.assertIn(f"`{program.name}`", (EXAMPLES / "README.md").read_text())

    def test_first_packing(self):
        self.assertIn("storage_modulus", self.printed_by("sh", str(EXAMPLES / "first_packing.sh")))
        self.assertGreater((self.folder / "gel.html").stat().st_size, 10_000)

    def test_voids_and_modulus(self):
        rows = [line.split() for line in self.example("voids_and_modulus.py").splitlines()[1:]]
        heterogeneity = [float(row[1]) for row in rows]
        self.assertEqual(len(rows), 3)
        self.assertEqual(heterogeneity, sorted(heterogeneity))

    def test_measured_packing(self):
        coordination, expected = re.search(r"coordination ([\d.]+), .* expected ([\d.]+)", self.example("measured_packing.py")).groups()
        self.assertAlmostEqual(float(coordination), float(expected), delta=0.3)

    def test_losses(self):
        rows = [list(map(float, line.split())) for line in self.example("losses.py").splitlines()[1:]]
        self.assertEqual(len(rows), 7)
        self.assertGreater(rows[-1][1], rows[0][1])
        largest = max(rows, key=lambda row: row[2])
        self.assertTrue(1 < largest[0] < 10, "the loss is largest near 1 / (2 pi 50 ms) = 3.2 Hz")

    def test_depletion_gel(self):
        rows = [list(map(float, line.split())) for line in self.example("depletion_gel.py").splitlines()[1:]]
        self.assertEqual([row[0] for row in rows], [2, 6, 10])
        self.assertTrue(all(abs(row[1] / row[0] - rows[0][1] / rows[0][0]) < 0.1 for row in rows), "stiffness goes as the depth")
        self.assertEqual(rows[0][4], 0, "a shallow attraction makes no gel")
        self.assertEqual([row[3] for row in rows[1:]], [3, 3])
        self.assertGreater(rows[0][2], 0)
        self.assertLess(rows[0][2], 2)
        self.assertGreater(min(row[2] for row in rows[1:]), 4)
        self.assertGreater(rows[2][4], 0)

    def test_results_with_h5py(self):
        self.assertRegex(self.example("results_with_h5py.py"), r"(?m)^characterization/doh/a: 0\.\d+$")


if __name__ == "__main__":
    unittest.main()
