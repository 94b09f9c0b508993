# SPDX-License-Identifier: GPL-3.0-or-later
"""What the comparisons with other programs share: a network, its moduli by coagula, and the comparison."""

import sys

from bonded_network import bond, read_packing
from support import ProgramTest

PARTICLES = 1000
VOLUME_FRACTION = 0.4
RADIUS = 0.25e-6
NORMAL_STIFFNESS = 100.0  # of a particle [N/m]
MODULUS_UNIT = NORMAL_STIFFNESS / 2 / RADIUS  # normal stiffness of a contact over the radius [Pa]


class OtherProgramTest(ProgramTest):
    def packing_bonded(self, tolerance, particles=PARTICLES):
        self.succeed("generate", "vem", "--particles", particles, "--voids", particles // 2, "--volume-fraction", VOLUME_FRACTION,
                     "--radius", RADIUS, "--seed", 1, "--quiet", "-o", "packing.h5")
        self.succeed("export", "packing.h5", "--format", "csv", "-o", "packing.csv")
        edge, positions = read_packing(self.folder / "packing.csv", particles, VOLUME_FRACTION)
        return bond(edge, positions, tolerance)

    def moduli_by_coagula(self, network, tolerance, shear_stiffness):
        sheared = self.succeed_json("shear", "packing.h5", "--bond-tolerance", tolerance, "--normal-stiffness", NORMAL_STIFFNESS,
                                    "--shear-stiffness", shear_stiffness)
        self.assertEqual(sheared["contacts"], len(network.bonds))
        return sheared

    def compare(self, program, network, moduli, storage_modulus, tolerance):
        """`moduli` in MODULUS_UNIT against the moduli of coagula in Pa."""
        for plane, modulus in moduli.items():
            ratio = modulus * MODULUS_UNIT / storage_modulus[plane]
            print(f"C = {network.coordination:.2f}, {plane}: coagula {storage_modulus[plane]:.8g} Pa, {program} / coagula - 1 = "
                  f"{ratio - 1:+.1e}", file=sys.stderr)
            self.assertAlmostEqual(ratio, 1, delta=tolerance)
