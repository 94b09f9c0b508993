# SPDX-License-Identifier: GPL-3.0-or-later
"""The shear moduli of bonds with normal and shear springs by Yade (explicit steps, local damping, rotations) and by coagula."""

import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

from other_program import NORMAL_STIFFNESS, OtherProgramTest

SCRIPT = Path(os.environ["COAGULA_TEST_SUPPORT"]) / "yade_shear.py"
SHEAR_STIFFNESS = 10.0  # of a particle [N/m]


@unittest.skipUnless(shutil.which("yade"), "Yade is not installed: apt-get install yade")
class Yade(OtherProgramTest):
    def check(self, tolerance, strain, particles):
        network = self.packing_bonded(tolerance, particles)
        sheared = self.moduli_by_coagula(network, tolerance, SHEAR_STIFFNESS)
        answer = self.ask_yade({"edge": network.edge, "positions": network.positions, "tolerance": tolerance, "strain": strain,
                                "shear_stiffness": SHEAR_STIFFNESS / NORMAL_STIFFNESS})
        self.assertEqual(answer["bonds"], len(network.bonds))
        self.compare("Yade", network, answer["moduli"], sheared["storage_modulus"], 0.001)

    def ask_yade(self, request):
        self.write("request.json", json.dumps(request))
        done = subprocess.run(["yade", "-j1", "-nx", SCRIPT], cwd=self.folder, capture_output=True, text=True, timeout=250,
                              stdin=subprocess.DEVNULL)
        self.assertTrue((self.folder / "answer.json").exists(), done.stdout + done.stderr)
        return json.loads((self.folder / "answer.json").read_text())

    def test_network_of_touching_particles(self):
        # The softest modes of larger ones swing for a hundred thousand steps.
        self.check(tolerance=0.01, strain=1e-5, particles=500)

    def test_network_with_more_bonds_at_another_strain(self):
        self.check(tolerance=0.15, strain=1e-6, particles=1000)


if __name__ == "__main__":
    unittest.main()
