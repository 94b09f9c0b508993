# SPDX-License-Identifier: GPL-3.0-or-later
"""The contact model in the linear and the frequency response: terms that act, that do not act, and that cannot be."""

import unittest

from support import ProgramTest

MOMENTS = 'bending_stiffness = "3e-15 N.m"\ntwisting_stiffness = "1e-15 N.m"\n'
LIMITS = 'normal_strength = "0.1 mN"\nfriction = 0.3\nageing_rate = 0.1\nageing_time = "10 s"\n'


class Model(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()

    def shear(self, model, *words):
        self.write("model.toml", model)
        return self.succeed_json("shear", "packing.h5", "-o", "out.h5", "--force", "--model", "model.toml", *words)

    def refuse(self, code, model, *words, says):
        self.write("model.toml", model)
        self.fail_with(code, "shear", "packing.h5", "--model", "model.toml", *words, says=says)

    def test_moments_stiffen(self):
        plain = self.shear("")["storage_modulus"]["mean"]
        moments = self.shear(MOMENTS)
        self.assertGreater(moments["storage_modulus"]["mean"], 1.02 * plain)
        harmonic = self.shear(MOMENTS, "--frequency", "1Hz")
        self.assertAlmostEqual(harmonic["storage_modulus"]["mean"][0] / moments["storage_modulus"]["mean"], 1, delta=1e-6)
        self.assertGreater(harmonic["derivative"]["bending_stiffness"]["storage_modulus"][0], 0)

    def test_limits_play_no_part_and_are_named(self):
        plain = self.shear("")
        self.assertNotIn("without_effect", plain)
        limited = self.shear(LIMITS)
        self.assertEqual(limited["storage_modulus"], plain["storage_modulus"])
        self.assertEqual(limited["without_effect"], "normal_strength, friction, ageing_rate, ageing_time")
        self.assertEqual(self.shear(LIMITS, "--frequency", "1Hz")["without_effect"], limited["without_effect"])

    def test_adhesive_contacts(self):
        adhesive = 'young_modulus = "70 GPa"\npoisson_ratio = 0.25\nwork_of_adhesion = "0.5 J/m2"\n'
        found = self.shear(adhesive)
        # 6/5 E* a with the contact radius a at rest, R = 0.125 um.
        modulus = 70e9 / (2 * (1 - 0.25**2))
        radius = (4.5 * 3.141592653589793 * 0.5 * 0.125e-6**2 / modulus) ** (1 / 3)
        self.assertAlmostEqual(found["contact_stiffness"]["normal"] / (1.2 * modulus * radius), 1, delta=1e-6)

    def test_losses_and_contacts_without_stiffness_are_refused(self):
        self.refuse(2, 'normal_viscosity = "1 mN.s/m"\n', says=["normal_viscosity", "--frequency"])
        self.refuse(2, 'young_modulus = "70 GPa"\npoisson_ratio = 0.25\n', says="needs prestress or adhesion")
        self.refuse(2, 'young_modulus = "70 GPa"\n', says="poisson_ratio")
        self.refuse(2, 'shear_stiffness = 0\nshear_strength = "1 uN"\n', says="no bond would feel shear")
        self.refuse(2, 'prestress = "1 nN"\n', "--relax", "minimise", says=["--relax", "prestress"])
        self.refuse(1, 'shear_stiffness = 0\nprestress = "1 uN"\n', says="not stable under its prestress")


if __name__ == "__main__":
    unittest.main()
