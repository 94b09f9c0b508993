# SPDX-License-Identifier: GPL-3.0-or-later
"""Quasi-static shear: keys, agreement with the linear response, options and models that are refused."""

import math
import subprocess
import time
import unittest

from support import PROGRAM, ProgramTest

MODEL = """normal_strength = "12 nN"
bending_stiffness = "3e-14 N.m"
twisting_stiffness = "3e-14 N.m"
friction = 0.3
"""


class Quasistatic(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()

    def shear(self, *words):
        return self.succeed_json("shear", "packing.h5", "--method", "quasistatic", "-o", "out.h5", "--force", *words)

    def test_small_strain_is_the_linear_response(self):
        linear = self.succeed_json("shear", "packing.h5", "-o", "linear.h5")
        found = self.shear()
        self.assertEqual(found["method"], "quasistatic")
        for key in ("contacts", "rattlers", "floppy_modes", "contact_stiffness"):
            self.assertEqual(found[key], linear[key])
        self.assertAlmostEqual(found["affine_modulus"] / linear["affine_modulus"], 1, delta=1e-12)
        self.assertIsNone(found["phase"])
        self.assertIn("seconds", found)
        for name in ("xy", "xz", "yx", "yz", "zx", "zy", "mean"):
            self.assertAlmostEqual(found["storage_modulus"][name] / linear["storage_modulus"][name], 1, delta=1e-3)

    def test_a_killed_run_goes_on(self):
        self.write("model.toml", MODEL)
        for name, words in (("sweep", ["--amplitudes", "1e-4,1e-3", "--steps-per-cycle", "8"]), ("ramp", ["--ramp", "1e-3", "--ramp-steps", "8"])):
            call = ["shear", "packing.h5", "--method", "quasistatic", "--model", "model.toml", "--orientation", "xy,zx", *words]
            whole = self.succeed_json(*call, "-o", f"{name}_whole.h5")
            checkpoint = f"{name}_state.h5"
            running = subprocess.Popen([PROGRAM, *call, "-o", f"{name}.h5", "--checkpoint", checkpoint, "--quiet"], cwd=self.folder)
            while running.poll() is None and not (self.folder / checkpoint).exists():
                time.sleep(0.005)
            running.kill()
            running.wait()
            again = self.succeed_json(*call, "-o", f"{name}.h5", "--checkpoint", checkpoint, "--force")
            for entry in (whole, again):
                del entry["seconds"], entry["output"]
            self.assertEqual(again, whole)
            self.fail_with(2, *call, "--rest-length", "radii", "-o", f"{name}.h5", "--force", "--checkpoint", checkpoint, says=[checkpoint, "other options"])

    def test_sweep_with_breakage(self):
        self.write("model.toml", MODEL)
        found = self.shear("--amplitudes", "1e-4,1e-3", "--reverse", "--orientation", "zx", "--model", "model.toml",
                           "--steps-per-cycle", "16")
        self.assertEqual(found["amplitude"], [1e-4, 1e-3, 1e-3, 1e-4])
        for k, amplitude in enumerate(found["amplitude"]):
            storage, loss = found["storage_modulus"]["zx"][k], found["loss_modulus"]["zx"][k]
            self.assertGreater(storage, 0)
            self.assertAlmostEqual(found["sweep"]["zx"]["loop_area"][k] / (math.pi * amplitude ** 2), loss, delta=1e-6 * storage)
            self.assertLess(found["sweep"]["zx"]["balance_error"][k], 1e-5)

    def test_uniaxial_compression(self):
        linear = self.succeed_json("shear", "packing.h5", "-o", "linear.h5")
        found = self.shear("--strain", "uniaxial", "--ramp", "1e-6", "--ramp-steps", "1")
        for axis, name in enumerate(("xx", "yy", "zz")):
            expected = linear["elastic_tensor"][axis][axis]
            self.assertAlmostEqual(found["longitudinal_modulus"][name] / expected, 1, delta=1e-3)
            self.assertAlmostEqual(found["ramp"][name]["stress"][-1] / (1e-6 * expected), 1, delta=1e-3)
        self.assertNotIn("storage_modulus", found)
        self.write("model.toml", MODEL + 'shear_strength = "6 nN"\n')
        self.succeed("generate", "vem", "--particles", "60", "--volume-fraction", "0.4", "--radius", "0.25um", "-o", "small.h5")
        words = ("shear", "small.h5", "--method", "quasistatic", "--strain", "uniaxial", "--ramp", "0.006", "--orientation", "zz", "--model", "model.toml")
        pressed = self.succeed_json(*words, "--ramp-steps", "6", "-o", "pressed.h5")["ramp"]["zz"]
        fraction = self.succeed_json("info", "small.h5")["volume_fraction"]
        self.assertEqual(pressed["strain"][-1], 0.006)
        for strain, there in zip(pressed["strain"], pressed["volume_fraction"]):
            self.assertAlmostEqual(there / (fraction / (1 - strain)), 1, delta=1e-12)
        self.assertGreater(pressed["broken_bonds"], 0)
        self.assertTrue(all(strain > 0 for strain in pressed["broken"]["strain"]))
        self.assertGreater(pressed["work"][-1], 0)
        self.assertEqual(pressed["peak_stress"], max(pressed["stress"]))
        secant = 0.9 * pressed["stress"][1] / pressed["strain"][1] * pressed["yield_strain"]
        self.assertAlmostEqual(pressed["yield_stress"] / secant, 1, delta=1e-9)
        self.assertAlmostEqual(pressed["yield_volume_fraction"] / (fraction / (1 - pressed["yield_strain"])), 1, delta=1e-9)
        self.assertLess(pressed["plateau_stress"], pressed["peak_stress"])
        self.assertRegex(self.succeed(*words, "--ramp-steps", "1", "-o", "again.h5"),
                         "zz, compression 0.006 +normal stress .*Pa, [0-9]+ bonds broken")

    def test_every_broken_bond_says_why(self):
        self.write("model.toml", MODEL.replace("12 nN", "5 uN") + 'shear_strength = "2 nN"\n')
        found = self.shear("--ramp", "1e-3", "--ramp-steps", "4", "--orientation", "zx", "--model", "model.toml")
        ramp = found["ramp"]["zx"]
        self.assertGreater(ramp["broken_bonds"], 0)
        self.assertEqual(ramp["broken"]["cause"], [1] * ramp["broken_bonds"])
        self.assertEqual(ramp["broken_by_cause"], {"normal": 0, "shear": ramp["broken_bonds"], "bending": 0, "pull_off": 0})
        self.assertEqual(ramp["broken"]["strain"], sorted(ramp["broken"]["strain"]))

    def test_failure_is_a_result(self):
        """A chain across the cell breaks where sqrt(1 + strain^2) - 1 is its strength over 50 N/m times its length."""
        self.write("chain.csv", "x [um],y [um],z [um]\n1,1,0.25\n1,1,0.75\n1,1,1.25\n")
        self.succeed("import", "chain.csv", "--radius", "0.25um", "--box", "5um,5um,1.5um", "-o", "chain.h5")
        self.write("model.toml", 'normal_strength = "0.5 uN"\n')  # 0.02 of the stiffness times the distance
        words = ("shear", "chain.h5", "--method", "quasistatic", "-o", "out.h5", "--force", "--orientation", "zx", "--model",
                 "model.toml")
        found = self.succeed_json(*words, "--ramp", "0.3")["ramp"]["zx"]
        self.assertAlmostEqual(found["failure_strain"], math.sqrt(1.02 ** 2 - 1), delta=1e-6)
        self.assertEqual(found["strain"][-1], found["failure_strain"])
        self.assertIn(f"{found['broken_bonds']} bonds broken", found["failure"])
        swept = self.succeed_json(*words, "--amplitudes", "0.1,0.3,0.1")
        self.assertIsNone(swept["storage_modulus"]["zx"][1])
        self.assertGreater(swept["storage_modulus"]["zx"][0], 0)
        self.assertAlmostEqual(swept["sweep"]["zx"]["failure_strain"], found["failure_strain"], delta=1e-6)
        self.assertRegex(self.succeed(*words, "--ramp", "0.3"), "zx +failed at strain 0.201, [1-3] bonds broken")
        self.assertIsNone(self.succeed_json(*words, "--ramp", "0.1")["ramp"]["zx"]["failure_strain"])

    def test_refused(self):
        def refuse(says, *words):
            self.fail_with(2, "shear", "packing.h5", "--method", "quasistatic", *words, says=says)

        refuse("exclude", "--amplitudes", "1e-3", "--ramp", "1e-3")
        refuse(["--ramp is 1", "below 1"], "--ramp", "1", "--strain", "uniaxial")
        refuse("--strain is read only with --ramp", "--strain", "uniaxial")
        refuse("'zx' is not one of xx, yy, zz (axis of the compression) or all", "--ramp", "0.1", "--strain", "uniaxial", "--orientation", "zx")
        refuse("'zz' is not one of xy", "--ramp", "0.1", "--orientation", "zz")
        refuse("--amplitudes", "--amplitudes", "1e-3:1e-2")
        refuse("--amplitudes", "--amplitudes", "-1")
        refuse("--amplitudes: '10x' is not a number", "--amplitudes", "1e-3:1e-2:10x")
        refuse("--amplitudes: '-1' is out of range", "--amplitudes", "-1:1e-2:10")
        self.write("model.toml", 'normal_viscosity = "1 mN.s/m"\n')
        refuse("dashpot", "--model", "model.toml")
        self.write("model.toml", 'young_modulus = "70 GPa"\npoisson_ratio = 0.25\n')
        refuse("stiffness at rest", "--model", "model.toml")


if __name__ == "__main__":
    unittest.main()
