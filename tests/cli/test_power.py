# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose plan: what a planned experiment could find, without any measured value."""

import json
import unittest

from support import VEM, ProgramTest

PLAN = """[sample]
particle_radius = "0.25 um"

[structures]
files = ["packing.h5"]

[noise]
stated_relative = 0.03

[[measurement]]
kind = "frequency-sweep"
planned = { from = "0.6 rad/s", to = "600 rad/s", points = 12 }
"""
QUICK = ("--data-sets", "40", "--diagnoses", "1", "--causes", "contact-loss,bond-bending")


class Power(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed(*VEM[:3], "120", "--voids", "60", *VEM[6:], "-o", "packing.h5")
        self.write("plan.toml", PLAN)

    def test_strengths_from_which_on_a_cause_is_found(self):
        found = self.succeed_json("diagnose", "plan", "plan.toml", "-o", "power", *QUICK)
        causes = {cause["name"]: cause for cause in found["causes"]}
        self.assertEqual(sorted(causes), ["bond-bending", "contact-loss"])
        self.assertEqual(found["moduli"], 24)
        loss = causes["contact-loss"]
        self.assertLess(loss["found_half"]["value"], loss["found_most"]["value"])
        self.assertEqual(loss["diagnoses"]["runs"], 1)
        for point in loss["curve"]:
            self.assertLessEqual(point["found"]["low"], point["found"]["count"] / point["found"]["of"])
        self.assertIsNone(causes["bond-bending"]["found_half"])
        written = json.loads((self.folder / "power" / "power.json").read_text())
        self.assertEqual(written["causes"], found["causes"])
        self.fail_with(3, "diagnose", "plan", "plan.toml", "-o", "power", says="--force")
        told = self.succeed("diagnose", "plan", "plan.toml", "-o", "power", "--force", *QUICK)
        self.assertRegex(told, r"contact-loss +springpot_over_spring: found with 50 % at [0-9.]+ or more \([0-9.]+ to [0-9.]+\), with 95 % at")
        self.assertRegex(told, r"bond-bending +cannot be found: \d+ of 40")

    def test_a_table_without_moduli_gives_the_axis(self):
        self.write("axis.csv", "frequency [Hz]\n" + "".join(f"{0.1 * 2 ** k}\n" for k in range(8)))
        self.write("plan.toml", PLAN.split("planned")[0] + 'file = "axis.csv"\n')
        found = self.succeed_json("diagnose", "plan", "plan.toml", "--data-sets", "20", "--diagnoses", "0", "--causes", "ageing")
        self.assertEqual((found["moduli"], len(found["causes"])), (16, 1))

    def test_waveforms_are_planned_as_harmonics(self):
        strains = '{ from = "0.01 %", to = "1 %", points = 8 }'
        tables = "".join(f'[[measurement]]\nkind = "{kind}"\nsample = "gel"\nplanned = {strains}\n' for kind in ("amplitude-sweep", "harmonics"))
        self.write("plan.toml", PLAN.split("[[measurement]]")[0] + tables)
        words = ["diagnose", "plan", "plan.toml", "--data-sets", "20", "--diagnoses", "0", "--causes", "contact-nonlinearity"]
        found = self.succeed_json(*words)
        self.assertEqual((found["moduli"], found["third_harmonics"], len(found["causes"])), (16, 16, 1))
        self.assertRegex(self.succeed(*words), r"planned +16 moduli, G' about .*Pa, 16 parts of third harmonics")

    def test_frequencies_may_be_planned_in_cycles(self):
        words = ["diagnose", "plan", "plan.toml", "--data-sets", "20", "--diagnoses", "0", "--causes", "contact-loss"]
        self.write("plan.toml", PLAN.replace("0.6 rad/s", f"{0.6 / 6.283185307179586} Hz"))
        in_cycles = self.succeed_json(*words)
        self.write("plan.toml", PLAN)
        self.assertAlmostEqual(in_cycles["causes"][0]["found_half"]["value"], self.succeed_json(*words)["causes"][0]["found_half"]["value"])

    def test_the_expected_modulus_sets_the_stiffness(self):
        self.write("plan.toml", PLAN + '[expected]\nstorage_modulus = "5 kPa"\n')
        found = self.succeed_json("diagnose", "plan", "plan.toml", "--data-sets", "20", "--diagnoses", "0", "--causes", "ageing")
        self.assertEqual(found["storage_modulus"], 5000)
        self.assertLess(found["normal_stiffness"], 1)

    def test_refusals(self):
        for old, new, says in (
            ('from = "0.6 rad/s"', 'from = "0 rad/s"', "needs 'from' and 'to'"),
            ('from = "0.6 rad/s"', 'from = "1 m"', "planned.from"),
            ('from = "0.6 rad/s"', 'from = "x Hz"', "planned.from"),
            ("points = 12", "points = 3", "whole number from 5"),
            ("points = 12", "points = 12, mood = 1", "'mood' is not one of from, to, points"),
            ('"frequency-sweep"', '"coordinates"', "no axis"),
            ('"frequency-sweep"', '"waveform"', "waveforms are planned as a table of kind harmonics"),
            ("stated_relative = 0.03", "stated_phase = 2", "stated_phase"),
        ):
            with self.subTest(new=new):
                self.write("plan.toml", PLAN.replace(old, new))
                self.fail_with(2, "diagnose", "plan", "plan.toml", says=says)
        self.write("plan.toml", PLAN)
        self.fail_with(2, "diagnose", "plan", "plan.toml", "--causes", "magic", says="'magic' is not a cause")
        # A plan is no measurement.
        self.fail_with(2, "diagnose", "plan.toml", "-o", "results", says="a planned table has no measured moduli")


if __name__ == "__main__":
    unittest.main()
