# SPDX-License-Identifier: GPL-3.0-or-later
"""Gels of depletion attraction from Python: characterize and shear take their bonds from the gel, in memory and from a file."""

import unittest

import coagula
from support import ModuleTest


class Depletion(ModuleTest):
    def test_bonds_come_from_the_gel(self):
        made = coagula.generate_brownian(law="depletion", depth="10kT", size_ratio=0.1, radius="0.5um", particles=200, volume_fraction=0.2,
                                         equilibration_time="2ms", stop_time="5ms")
        tolerance = made.potential.bond_tolerance
        self.assertEqual(made.potential.unit("bond_stiffness"), "N/m")
        coagula.write("gel.h5", made)
        stored = coagula.read("gel.h5")
        for gel in (made, stored):
            self.assertEqual(coagula.characterize(gel, only="coordination").contact_tolerance, tolerance)
            sheared = coagula.shear(gel, stiffness_from="potential")
            self.assertAlmostEqual(sheared.contact_stiffness.normal / made.potential.bond_stiffness, 1)
            self.assertEqual(sheared.contact_stiffness.shear, 0)
            self.assertEqual(sheared.conditions.bond_tolerance, tolerance)
        self.assertEqual(coagula.characterize(made.packing, only="coordination").contact_tolerance, 0.01)
        with self.assertRaisesRegex(coagula.InputError, "the structure says nothing about the stiffness of its bonds, which stiffness_from="):
            coagula.shear(made.packing, stiffness_from="potential")


if __name__ == "__main__":
    unittest.main()
