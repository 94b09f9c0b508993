# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequency response: keys, arrays, the limit without losses, models and frequencies that are refused."""

import math
import unittest

from support import ProgramTest

MODEL = """normal_viscosity = "0.2 mN.s/m"
shear_springpot_stiffness = "2 N/m"
shear_springpot_time = "10 ms"
shear_springpot_exponent = 0.3
solvent_viscosity = "1 mPa.s"
"""


class Frequency(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()
        self.write("model.toml", MODEL)

    def sweep(self, *words):
        return self.succeed_json("shear", "packing.h5", "-o", "out.h5", "--force", *words)

    def test_angular_frequencies(self):
        one = self.sweep("--frequency", "1Hz,10Hz", "--model", "model.toml")
        other = self.sweep("--frequency", f"{2 * math.pi!r}rad/s,{20 * math.pi!r} rad/s", "--model", "model.toml")
        for found, wanted in zip(other["frequency"], one["frequency"]):
            self.assertAlmostEqual(found / wanted, 1, delta=1e-12)
        self.assertAlmostEqual(other["loss_modulus"]["mean"][1] / one["loss_modulus"]["mean"][1], 1, delta=1e-9)

    def test_keys_and_arrays(self):
        found = self.sweep("--frequency", "1Hz,10Hz,2kHz", "--model", "model.toml")
        self.assertEqual(found["method"], "frequency")
        self.assertEqual(found["frequency"], [1, 10, 2000])
        planes = {"xy", "xz", "yx", "yz", "zx", "zy"}
        for part in ("storage", "loss"):
            modulus = found[part + "_modulus"]
            self.assertEqual(set(modulus), planes | {"mean", "std"})
            tensor = found[part + "_tensor"]
            for k in range(3):
                self.assertAlmostEqual(modulus["xy"][k] / tensor[k][5][5], 1, delta=1e-12)
                self.assertAlmostEqual(sum(modulus[name][k] for name in planes) / 6 / modulus["mean"][k], 1, delta=1e-12)
                self.assertGreater(modulus["mean"][k], 0)
        for k in range(3):
            storage, loss = found["storage_modulus"]["mean"][k], found["loss_modulus"]["mean"][k]
            self.assertAlmostEqual(found["phase"][k], math.atan2(loss, storage), delta=1e-12)
            self.assertAlmostEqual(found["dissipation"][k][5] / (math.pi * found["loss_modulus"]["xy"][k]), 1, delta=1e-6)
        self.assertEqual(set(found["derivative"]), {"normal_stiffness", "shear_stiffness", "normal_viscosity", "solvent_viscosity",
                                                    "shear_springpot_stiffness", "shear_springpot_time", "shear_springpot_exponent"})
        self.assertIn("solvent_viscosity", found["model"])

    def test_derivative_is_the_slope(self):
        low = self.sweep("--frequency", "50Hz", "--model", "model.toml", "--normal-stiffness", "99.9N/m")
        high = self.sweep("--frequency", "50Hz", "--model", "model.toml", "--normal-stiffness", "100.1N/m")
        middle = self.sweep("--frequency", "50Hz", "--model", "model.toml")
        for part in ("storage_modulus", "loss_modulus"):
            slope = (high[part]["mean"][0] - low[part]["mean"][0]) / 0.2
            self.assertAlmostEqual(middle["derivative"]["normal_stiffness"][part][0] / slope, 1, delta=1e-4)

    def test_without_losses_it_is_the_linear_response(self):
        linear = self.succeed_json("shear", "packing.h5", "-o", "linear.h5")
        found = self.sweep("--frequency-sweep", "0.1Hz:1kHz:5")
        for k, frequency in enumerate((0.1, 1, 10, 100, 1000)):
            self.assertAlmostEqual(found["frequency"][k] / frequency, 1, delta=1e-12)
            self.assertAlmostEqual(found["storage_modulus"]["mean"][k] / linear["storage_modulus"]["mean"], 1, delta=1e-9)
            self.assertEqual(found["loss_modulus"]["mean"][k], 0)

    def test_stored_with_units_beside_the_linear_response(self):
        self.succeed("shear", "packing.h5")
        self.succeed("shear", "packing.h5", "--frequency", "1Hz", "--model", "model.toml")
        results = self.succeed_json("info", "packing.h5")["results"]
        self.assertIn("/mechanics/linear/storage_modulus/mean", results)
        self.assertEqual(results["/mechanics/frequency/storage_modulus/mean"]["unit"], "Pa")
        self.assertEqual(results["/mechanics/frequency/derivative/normal_viscosity/loss_modulus"]["unit"], "Pa/(N.s/m)")

    def test_table_for_people(self):
        self.assertRegex(self.succeed("shear", "packing.h5", "--frequency", "20Hz", "--model", "model.toml"),
                         r"20 Hz +G' \d.*Pa, G'' \d.*Pa, phase \d.* rad\n")

    def test_model_gives_the_springs_of_the_linear_response(self):
        self.write("stiff.toml", 'normal_stiffness = "200 N/m"\nshear_stiffness = 20\n')
        self.assertAlmostEqual(self.sweep("--model", "stiff.toml")["contact_stiffness"]["normal"], 100, delta=1e-9)

    def test_bad_models(self):
        def refuse(text, says):
            self.write("bad.toml", text)
            self.fail_with(2, "shear", "packing.h5", "--frequency", "1Hz", "--model", "bad.toml", says=["bad.toml", says])

        refuse('stickiness = "3 N/m"\n', "stickiness")
        refuse('normal_viscosity = "3 N/m"\n', "normal_viscosity")
        refuse("normal_viscosity = -1\n", "normal_viscosity")
        refuse("shear_maxwell_time = 1\n", "shear_maxwell_stiffness")
        refuse("shear_springpot_stiffness = 1\nshear_springpot_time = 1\nshear_springpot_exponent = 2\n", "exponent")
        refuse("normal_viscosity = \n", "line 1")
        self.fail_with(2, "shear", "packing.h5", "--model", "absent.toml", says="absent.toml")
        self.fail_with(2, "shear", "packing.h5", "--model", "model.toml", says=["model.toml", "--frequency"])

    def test_bad_frequencies(self):
        for words in (["--frequency", "0Hz"], ["--frequency", "-1Hz"], ["--frequency", "1s"], ["--frequency", "1Hz,,2Hz"],
                      ["--frequency-sweep", "1Hz:10Hz"], ["--frequency-sweep", "10Hz:1Hz:5"], ["--frequency-sweep", "1Hz:10Hz:1"],
                      ["--frequency-sweep", "1Hz:10Hz:many"], ["--frequency", "1Hz", "--frequency-sweep", "1Hz:10Hz:3"]):
            with self.subTest(words=words):
                self.fail_with(2, "shear", "packing.h5", *words, says=words[0])

    def test_same_results_for_any_number_of_threads(self):
        one, two = (self.sweep("--frequency", "1Hz,100Hz", "--model", "model.toml", "--threads", n) for n in ("1", "2"))
        for name in ("storage_tensor", "loss_tensor", "derivative", "dissipation"):
            self.assertEqual(one[name], two[name])


if __name__ == "__main__":
    unittest.main()
