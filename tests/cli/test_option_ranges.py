# SPDX-License-Identifier: GPL-3.0-or-later
"""Values far outside physics are refused before anything is computed, and results say where they miss what was asked for."""

import unittest

from support import PACKING, VEM, ProgramTest

BROWNIAN = ["generate", "brownian", "--particles", "100", "--volume-fraction", "0.2", "--radius", "0.25um", "--stop-time", "1us",
            "--surface-potential", "0", "-o", "out.h5"]


class Ranges(ProgramTest):
    def refuse(self, option, *words):
        self.fail_with(2, *words, says=option)

    def test_what_once_crashed_or_gave_no_number(self):
        for option, value in (("--permittivity", "1e300"), ("--gravity", "1e300"), ("--yukawa-energy", "1e300"),
                              ("--cutoff-gap", "1e300"), ("--viscosity", "5e-324"), ("--temperature", "1e300")):
            more = ["--yukawa-length", "1nm"] if "yukawa" in option else ["--density-difference", "1e3"] if "gravity" in option else []
            self.refuse(option, *BROWNIAN, *more, option, value)
        for value in ("5e-324", "1e-300", "1e150", "1e300"):
            self.refuse("--radius", *VEM[:-1], value, "-o", "out.h5")
        self.refuse("--shear-stiffness", "shear", PACKING, "--shear-stiffness", "1e300", "-o", "out.h5")
        self.refuse("--normal-stiffness", "shear", PACKING, "--normal-stiffness", "5e-324", "-o", "out.h5")
        self.refuse("--stiffness-ratio", "calibrate", PACKING, "--stiffness-ratio", "1e300")

    def test_what_options_make_together(self):
        self.fail_with(2, *BROWNIAN, "--cutoff-gap", "1mm", says="cut-off gap")
        self.fail_with(2, *BROWNIAN, "--cutoff-gap", "0.1nm", says="cut-off")

    def test_a_length_without_its_unit(self):
        for words in (VEM[:-1], BROWNIAN[:7]):
            self.fail_with(2, *words, "0.25", "-o", "out.h5", says=["--radius", "0.25um"])
        self.write("points.csv", "x [um],y [um],z [um]\n1,1,1\n3,1,1\n")
        self.fail_with(2, "import", "points.csv", "--radius", "0.5", "--box", "8um", "-o", "out.h5", says=["--radius", "0.5um"])
        self.fail_with(2, "import", "points.csv", "--radius", "0.5um", "--box", "10.94", "-o", "out.h5", says=["--box", "10.94um"])
        self.succeed("import", "points.csv", "--radius", "5e-7", "--box", "8e-6", "-o", "out.h5")
        self.write("rocks.csv", "x [m],y [m],z [m]\n1,1,1\n3,1,1\n")
        self.succeed("import", "rocks.csv", "--radius", "0.5m", "--box", "8m", "-o", "rocks.h5")

    def test_keys_of_an_experiment(self):
        self.write("sweep.csv", "strain [1],storage modulus [Pa]\n1e-5,500\n1e-4,490\n1e-3,470\n1e-2,400\n")
        for line, says in (("particle_radius = 0.25", ["particle_radius", "0.25 um"]), ("temperature = 5e-324", ["temperature", "between"]),
                           ("density = 1e300", ["density", "between"])):
            self.write("e.toml", f'[sample]\n{line}\n[[measurement]]\nkind = "amplitude-sweep"\nfile = "sweep.csv"\n')
            self.fail_with(2, "diagnose", "check", "e.toml", says=["e.toml", *says])

    def test_a_result_that_is_no_number_is_an_error(self):
        self.write("huge.toml", "bending_stiffness = 1e300\ntwisting_stiffness = 1e300\n")
        self.copy_of_packing()
        before = self.succeed_json("info", "packing.h5")["results"]
        done = self.run_program("shear", "packing.h5", "--model", "huge.toml", "--json")
        self.assertIn(done.returncode, (1, 2), done.stdout)
        self.check_sentence(done.stderr, may_say_nan=True)
        self.assertEqual(self.succeed_json("info", "packing.h5")["results"], before)


class Targets(ProgramTest):
    def test_the_target_stands_beside_what_was_reached(self):
        made = self.succeed_json(*VEM, "--target-coordination", "4.5", "-o", "out.h5")
        self.assertEqual(made["target_coordination"], 4.5)
        self.assertGreaterEqual(made["coordination"], 4.5)
        self.assertEqual(made["notes"] != [], made["coordination"] - 4.5 >= 0.1)
        self.assertIn("asked for 4.5", self.succeed(*VEM, "--target-coordination", "4.5", "-o", "out.h5", "--force"))

    def test_a_target_that_is_overshot_is_named(self):
        few = ["generate", "vem", "--particles", "20", "--voids", "10", "--volume-fraction", "0.4", "--radius", "1um"]
        overshot = 0
        for seed in range(1, 6):
            made = self.succeed_json(*few, "--target-coordination", "4.05", "--seed", seed, "-o", f"{seed}.h5")
            far = made["coordination"] - 4.05 >= 0.1
            overshot += far
            self.assertEqual([f"{made['coordination']:.5g}" in note for note in made["notes"]], [True] * far)
        self.assertGreater(overshot, 0)

    def test_advice_that_can_be_followed(self):
        words = ["generate", "vem", "--particles", "100", "--voids", "50", "--radius", "1um", "-o", "out.h5", "--volume-fraction"]
        dense = self.fail_with(4, *words, "0.62", says="ask for a lower volume fraction")
        self.assertNotIn("higher coordination", dense)
        self.fail_with(4, *words, "0.5", "--target-coordination", "1", says="ask for a higher coordination")
        thin = self.fail_with(4, *words, "0.2", "--target-coordination", "5.5", says="the packing comes to ")
        self.assertLess(float(thin.split("comes to ")[1].split()[0]), 5.5)


if __name__ == "__main__":
    unittest.main()
