# SPDX-License-Identifier: GPL-3.0-or-later
"""The shear moduli of networks by LAMMPS and by coagula: central springs (harmonic bonds, minimised energy), and bonds that resist
sliding (rigid bodies that come to rest)."""

import unittest

import lammps_shear
from other_program import MODULUS_UNIT, NORMAL_STIFFNESS, OtherProgramTest

STRAIN = 1e-7


class Lammps(OtherProgramTest):
    def check_rigid(self, tolerance, least_coordination):
        network = self.packing_bonded(tolerance)
        self.assertGreater(network.coordination, least_coordination)
        sheared = self.moduli_by_coagula(network, tolerance, 0)
        moduli = lammps_shear.shear_moduli(self.folder, network, STRAIN)
        self.compare("LAMMPS", network, moduli["relaxed"], sheared["storage_modulus"], 1e-4)
        affine = sum(moduli["affine"].values()) / 3 * MODULUS_UNIT
        self.assertAlmostEqual(affine / sheared["affine_modulus"], 1, delta=1e-6)
        return network, moduli["relaxed"]

    def test_far_from_floppy(self):
        self.check_rigid(0.3, 7.3)

    def test_closer_to_floppy_and_at_another_strain(self):
        # Nearly floppy parts of the network stretch by the square of their motion: the limit of small strains is reached late.
        network, moduli = self.check_rigid(0.22, 6.5)
        others = lammps_shear.shear_moduli(self.folder, network, 5 * STRAIN)["relaxed"]
        for plane, modulus in moduli.items():
            self.assertAlmostEqual(others[plane] / modulus, 1, delta=2e-4)

    def test_too_few_bonds_for_central_springs(self):
        network = self.packing_bonded(0.01)
        self.assertLess(network.coordination, 4.8)
        sheared = self.moduli_by_coagula(network, 0.01, 0)
        moduli = lammps_shear.shear_moduli(self.folder, network, STRAIN)
        for plane in lammps_shear.PLANES:
            self.assertLess(abs(moduli["relaxed"][plane] / moduli["affine"][plane]), 1e-6)
            self.assertLess(abs(sheared["storage_modulus"][plane] / sheared["affine_modulus"]), 1e-6)

    def test_bonds_that_resist_sliding(self):
        # Large networks have motions so soft that they take very long to come to rest.
        network = self.packing_bonded(0.01, 300)
        sheared = self.moduli_by_coagula(network, 0.01, 0.1 * NORMAL_STIFFNESS)
        moduli = {"xz": lammps_shear.modulus_with_sliding(self.folder, network, 0.1, "xz")}
        self.compare("LAMMPS", network, moduli, sheared["storage_modulus"], 3e-3)
        self.assertGreater(sheared["storage_modulus"]["xz"] / sheared["affine_modulus"], 0.01)


if __name__ == "__main__":
    unittest.main()
