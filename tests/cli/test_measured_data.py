# SPDX-License-Identifier: GPL-3.0-or-later
"""Packings that somebody measured or computed elsewhere, from import to modulus."""

import json
import os
import unittest
from pathlib import Path

from support import ProgramTest

DATA = Path(os.environ["COAGULA_DATASETS"])


class FinneyBallBearings(ProgramTest):
    """Finney's measured random close packing (1970): a heap with a free surface, in units of the radius."""

    def setUp(self):
        super().setUp()
        self.succeed("import", DATA / "finney_pack" / "finney.csv", "--radius", "1mm", "--length-unit", "1mm", "--open", "-o", "f.h5")

    def test_coordination_of_the_inner_part(self):
        for tolerance, published in (("0.01", 6.3), ("0.02", 6.9), ("0.05", 7.9), ("0.10", 9.0)):
            found = self.succeed_json("characterize", "f.h5", "--only", "coordination", "--contact-tolerance", tolerance)
            self.assertAlmostEqual(found["coordination"], published, delta=0.06)

    def test_pore_curve_of_a_dense_packing(self):
        found = self.succeed_json("characterize", "f.h5")
        self.assertAlmostEqual(found["pore_space"]["void_fraction"], 0.36, delta=0.01)
        self.assertTrue(0.12 < found["doh"]["a"] < 0.18)  # far below the gels: nearly homogeneous

    def test_modulus_grows_with_the_bonds_and_stays_below_the_affine_one(self):
        near = self.succeed_json("shear", "f.h5", "--bond-tolerance", "0.01")
        far = self.succeed_json("shear", "f.h5", "--bond-tolerance", "0.05", "--force")
        self.assertEqual(near["boundary"], "held surface")
        self.assertTrue(0 < near["storage_modulus"]["mean"] < far["storage_modulus"]["mean"] < far["affine_modulus"])


class ConfocalImage(ProgramTest):
    """200 particles of a gel, in voxels: an image so small that no particle is far inside."""

    def test_what_needs_no_inner_particle_is_measured(self):
        self.succeed("import", DATA / "silica_gel_confocal" / "peri_static.csv", "--length-unit", "0.127um,0.127um,0.12um,0.127um",
                     "--open", "--frame", "first", "-o", "gel.h5")
        found = self.succeed_json("characterize", "gel.h5", "--contact-tolerance", "0.1")
        self.assertGreater(found["coordination"], 1)
        self.assertNotIn("pore_size", found)
        self.assertIn("none lies so far inside", self.succeed("characterize", "gel.h5"))
        self.fail_with(2, "characterize", "gel.h5", "--only", "pores", says=["pores", "larger sample"])
        self.fail_with(2, "shear", "gel.h5", says=["200 particles", "larger sample"])


def numbers_in(tree, name=""):
    """Names and values of the numbers that are no whole ones."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from numbers_in(value, f"{name}{key}/")
        elif isinstance(value, float):
            yield name + key, value


class ConfocalGel(ProgramTest):
    """A colloidal gel imaged four times, a few particles deep: its noise is the scatter between the images."""

    def test_the_noise_moves_every_measure_by_a_known_amount(self):
        self.succeed("import", DATA / "silica_gel_confocal" / "peri_static.csv", "--columns", "x=xum,y=yum,z=zum", "--frame", "0",
                     "--length-unit", "1um", "--radius", "0.92um", "--open", "-o", "gel.h5")
        noise = ["--position-noise", "5.5nm,5.5nm,7.8nm", "--realizations", "3"]
        self.assertIn("pores  ", self.succeed("characterize", "gel.h5", *noise))
        found = self.succeed_json("characterize", "gel.h5", *noise, "--force", "-o", "out.h5")
        shift, error = (dict(numbers_in(found["noise"][part])) for part in ("shift", "shift_error"))
        self.assertEqual(shift.keys(), error.keys())
        given = {"mean_radius", "contact_tolerance", "seconds"}
        measured = {name for name, _ in numbers_in(found) if not name.startswith(("noise/", "uncertainty/"))} - given
        self.assertEqual(set(shift), measured)
        self.assertGreater(len(measured), 25)
        # The nearest neighbours are 1.77 um away: noise of some nanometres hardly moves their distance, but it opens contacts.
        self.assertLess(abs(shift["neighbour_distances/nearest"]), 2e-9)
        # The overlaps imply far more than the scatter between the images: missed radii and particles.
        self.assertAlmostEqual(found["overlap"]["implied_noise"], 1.74e-7, delta=2e-9)


class ReferenceStructure(ProgramTest):
    """A gel of 8000 particles against values from another program."""

    def test_from_csv_to_modulus(self):
        name = "brownian_15mV"
        expected = json.loads((DATA / "reference_structures" / "reference.json").read_text())[name]
        self.succeed("import", DATA / "reference_structures" / f"{name}.csv", "--radius", "0.25um", "--box",
                     str(expected["box_m"]), "-o", "b.h5")
        found = self.succeed_json("characterize", "b.h5", "--only", "coordination,doh")
        self.assertAlmostEqual(found["doh"]["a"], expected["doh_a"], delta=0.002)
        self.assertAlmostEqual(found["coordination"], expected["coordination_1pct"], delta=0.0005)
        moduli = self.succeed_json("shear", "b.h5")["storage_modulus"]
        for plane, value in expected["G_MPa"].items():
            self.assertAlmostEqual(moduli[plane] / 1e6, value, delta=1e-4)
