# SPDX-License-Identifier: GPL-3.0-or-later
"""The explicit rheometer: keys, agreement with the linear method, checkpoints of killed runs, what is refused."""

import math
import subprocess
import time
import unittest

import h5py

from support import PROGRAM, ProgramTest

QUICK = ["--method", "dem", "--boundary", "periodic", "--bond-tolerance", "0.1", "--amplitude", "1e-5", "--steps-per-oscillation",
         "6000"]


class Rheometer(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()

    def shear(self, *words):
        return self.succeed_json("shear", "packing.h5", "-o", "out.h5", "--force", *QUICK, "--oscillations", "2", *words)

    def test_keys_and_agreement_with_the_linear_method(self):
        found = self.shear("--orientation", "zx,xy")
        linear = self.succeed_json("shear", "packing.h5", "--bond-tolerance", "0.1", "-o", "linear.h5")
        self.assertEqual(found["method"], "dem")
        for key in ("contacts", "rattlers", "floppy_modes", "affine_modulus"):
            self.assertEqual(found[key], linear[key])
        self.assertEqual(found["contact_stiffness"], linear["contact_stiffness"])
        self.assertEqual(set(found["storage_modulus"]), {"mean", "std", "zx", "xy"})
        for name in ("zx", "xy"):
            self.assertAlmostEqual(found["storage_modulus"][name] / linear["storage_modulus"][name], 1, delta=0.01)
        self.assertLess(abs(found["phase"]), 0.05)
        self.assertEqual(found["broken_bonds"], 0)
        self.assertEqual(len(found["oscillations"]["amplitude"]), 2)
        self.assertEqual(found["oscillations"]["amplitude"][0], [5e-6, 1e-5])
        self.assertEqual(len(found["rate_error"]), 2)
        with h5py.File(self.folder / "out.h5") as file:
            samples = file["mechanics/dem/samples/stress"]
            self.assertEqual(samples.shape, (2, 200))
            self.assertEqual(samples.attrs["unit"], b"Pa")

    def test_plates(self):
        found = self.succeed_json("shear", "packing.h5", "-o", "out.h5", "--method", "dem", "--orientation", "yz", "--oscillations",
                                  "1", "--bond-tolerance", "0.1", "--steps-per-oscillation", "6000")
        self.assertEqual(found["boundary"], "plates")
        self.assertEqual(len(found["sphere_storage_modulus"][0]), 5)
        self.assertAlmostEqual(found["plate_storage_modulus"][0] / found["storage_modulus"]["yz"], 1, delta=0.1)

    def test_what_the_plates_do(self):
        """The linear modulus of the same structure without plates, and by how much the plates stiffen it."""
        words = ["--method", "dem", "--orientation", "yz,zx", "--oscillations", "1", "--bond-tolerance", "0.1", "--steps-per-oscillation",
                 "6000", "--amplitude", "1e-5"]
        found = self.succeed_json("shear", "packing.h5", "-o", "out.h5", *words)
        linear = self.succeed_json("shear", "packing.h5", "--bond-tolerance", "0.1", "-o", "linear.h5")
        plates = found["plates"]
        for place, name in enumerate(("yz", "zx")):
            self.assertAlmostEqual(plates["periodic_linear_modulus"][place] / linear["storage_modulus"][name], 1, delta=1e-6)
            self.assertAlmostEqual(plates["linear_modulus"][place] / found["rest_modulus"][place], 1, delta=0.02)
        self.assertGreater(plates["modulus_ratio"], 1.05)
        self.assertAlmostEqual(plates["modulus_ratio"], sum(plates["linear_modulus"]) / sum(plates["periodic_linear_modulus"]), delta=1e-9)
        periodic = self.shear("--orientation", "yz,zx")  # what the estimate is about, measured
        self.assertAlmostEqual(plates["periodic_storage_modulus"] / periodic["storage_modulus"]["mean"], 1, delta=0.03)
        self.assertNotIn("plates", periodic)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertNotIn("plates", file["mechanics/dem"])  # shear() above has written the file anew
        table = self.succeed("shear", "packing.h5", "-o", "out.h5", "--force", *words)
        self.assertIn(f"raise G' by {100 * (plates['modulus_ratio'] - 1):.3g}"[:15], table)
        with h5py.File(self.folder / "out.h5") as file:
            stored = file["mechanics/dem/plates/periodic_storage_modulus"]
            self.assertEqual((stored[()], stored.attrs["unit"]), (plates["periodic_storage_modulus"], b"Pa"))

    def test_plates_without_a_linear_modulus(self):
        """Hertz's contacts, unstressed as found, have no stiffness at vanishing strain."""
        model = self.write("hertz.toml", 'young_modulus = "70 GPa"\npoisson_ratio = 0.2\n')
        call = ["shear", "packing.h5", "-o", "out.h5", "--method", "dem", "--orientation", "yz", "--oscillations", "1", "--bond-tolerance",
                "0.1", "--steps-per-oscillation", "600", "--model", str(model)]
        found = self.succeed_json(*call)
        self.assertEqual((found["plates"]["modulus_ratio"], found["plates"]["periodic_storage_modulus"]), (None, None))
        self.assertIn("no linear modulus", self.succeed(*call, "--force"))

    def test_a_killed_run_goes_on_to_the_same_bits(self):
        model = self.write("model.toml", 'friction = 0.2\nnormal_strength = "20 pN"\n')
        words = [*QUICK[:-1], "1500", "--oscillations", "6", "--orientation", "zx,xy", "--model", str(model)]
        whole = self.succeed_json("shear", "packing.h5", "-o", "whole.h5", *words)
        call = ["shear", "packing.h5", "-o", "killed.h5", "--checkpoint", "state.h5", *words]
        running = subprocess.Popen([PROGRAM, *call], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.folder / "state.h5").exists() and running.poll() is None:
            time.sleep(0.002)
        running.kill()
        running.wait()
        self.assertTrue((self.folder / "state.h5").exists())
        self.assertFalse((self.folder / "killed.h5").exists())
        again = self.succeed_json(*call)
        self.assertGreater(whole["broken_bonds"], 0)
        self.assertEqual(whole["broken"]["cause"], [0] * whole["broken_bonds"])
        self.assertEqual(whole["broken_by_cause"], {"normal": whole["broken_bonds"], "shear": 0, "bending": 0, "pull_off": 0})
        for key in ("storage_modulus", "loss_modulus", "oscillations", "samples", "broken", "rate_error"):
            self.assertEqual(again[key], whole[key])
        self.fail_with(2, *call, "--damping", "0.8", "--force", says=["state.h5", "other options"])
        damaged = bytearray((self.folder / "state.h5").read_bytes())
        (self.folder / "state.h5").write_bytes(damaged[:len(damaged) // 2])
        self.fail_with(2, *call, "--force", says="state.h5")

    def test_a_floppy_network_has_no_rate_error(self):
        """Three particles in a row and two: no stress at rest, over which an error could be taken."""
        self.write("rows.csv", "x [um],y [um],z [um]\n1,1,1\n1.5,1,1\n2,1,1\n3.5,3,3\n3.5,3.5,3\n")
        self.succeed("import", "rows.csv", "--radius", "0.25um", "--box", "5um", "-o", "rows.h5")
        call = ["shear", "rows.h5", *QUICK, "--oscillations", "1", "--orientation", "zx,xy", "-o", "out.h5"]
        found = self.succeed_json(*call)
        self.assertEqual((found["contacts"], found["storage_modulus"]["zx"], found["storage_modulus"]["xy"]), (3, 0, 0))
        self.assertEqual((found["rate_error"], found["rest_modulus"]), ([None, None], [None, None]))
        with h5py.File(self.folder / "out.h5") as file:
            self.assertTrue(all(math.isnan(value) for value in file["mechanics/dem/rate_error"]))
        self.assertIn("error of the stress unknown", self.succeed(*call, "--force"))

    def test_refusals(self):
        def refused(*words, says):
            self.fail_with(2, "shear", "packing.h5", "-o", "new.h5", "--method", "dem", *words, says=says)

        refused("--steps-per-oscillation", "150", says="multiple of the 100 samples")
        refused("--amplitude", "0", says="amplitude")
        refused("--orientation", "xx", says="'xx'")
        refused("--orientation", "xy,xy", says="twice")
        refused("--frequency", "1Hz,2Hz", says="one frequency")
        refused("--checkpoint", "packing.h5", says="packing.h5")
        springpot = 'normal_springpot_stiffness = 1\nnormal_springpot_time = 1\nnormal_springpot_exponent = 0.5\n'
        refused("--model", self.write("pot.toml", springpot), says="springpot")
        refused("--model", self.write("weak.toml", "normal_strength = -1\n"), says=["weak.toml", "normal_strength"])


if __name__ == "__main__":
    unittest.main()
