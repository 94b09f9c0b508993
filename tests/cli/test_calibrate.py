# SPDX-License-Identifier: GPL-3.0-or-later
"""Stiffness series and calibration: proportionality, agreement with `coagula shear`, ratios, what is refused."""

import csv
import unittest

from support import ProgramTest

CUBE = "x [um],y [um],z [um]\n" + "".join(f"{x},{y},{z}\n" for x in range(3) for y in range(3) for z in range(3))


class Calibrate(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()
        self.write("cube.csv", CUBE)  # simple cubic: carries shear by its shear springs
        self.succeed("import", "cube.csv", "--radius", "0.5um", "--box", "3um", "-o", "cube.h5")

    def test_modulus_is_proportional_to_stiffness(self):
        found = self.succeed_json("calibrate", "packing.h5", "cube.h5")
        self.assertEqual(found["normal_stiffness"], [50, 75, 100, 125, 150])
        self.assertEqual(found["shear_stiffness"], [5, 7.5, 10, 12.5, 15])
        self.assertEqual([structure["file"] for structure in found["structures"]], ["packing.h5", "cube.h5"])
        for structure in found["structures"]:
            modulus = structure["storage_modulus"]["mean"]
            for stiffness, value in zip(found["normal_stiffness"], modulus):
                self.assertAlmostEqual(value / modulus[0] / (stiffness / 50), 1, delta=1e-9)
            self.assertAlmostEqual(structure["line"]["slope"] / structure["line_through_origin"]["slope"], 1, delta=1e-9)
            self.assertLess(abs(structure["line"]["intercept"]), 1e-8 * modulus[0])
        first, second = found["structures"]
        self.assertEqual(first["ratio_to_first"], [1] * 5)
        for k in range(5):
            self.assertAlmostEqual(second["ratio_to_first"][k] / second["ratio_to_first"][0], 1, delta=1e-9)
            ratio = second["storage_modulus"]["mean"][k] / first["storage_modulus"]["mean"][k]
            self.assertAlmostEqual(second["ratio_to_first"][k] / ratio, 1, delta=1e-12)

    def test_values_are_those_of_shear(self):
        sheared = self.succeed_json("shear", "packing.h5", "-o", "s.h5", "--normal-stiffness", "80N/m", "--shear-stiffness", "20N/m")
        found = self.succeed_json("calibrate", "packing.h5", "--from", "40N/m", "--to", "80N/m", "--steps", "2",
                                  "--stiffness-ratio", "4")
        self.assertEqual(found["structures"][0]["storage_modulus"]["mean"][1], sheared["storage_modulus"]["mean"])
        self.assertEqual(found["structures"][0]["storage_modulus"]["std"][1], sheared["storage_modulus"]["std"])
        self.assertEqual(found["structures"][0]["contacts"], sheared["contacts"])

    def test_methods_agree(self):
        words = ("calibrate", "packing.h5", "--bond-tolerance", "0.1", "--steps", "2")
        linear, quasistatic, dem = (self.succeed_json(*words, "--method", *method) for method in (
            ["linear"], ["quasistatic"],
            ["dem", "--boundary", "periodic", "--amplitude", "1e-5", "--oscillations", "1", "--steps-per-oscillation", "6000"]))
        for found, tolerance in ((quasistatic, 1e-4), (dem, 0.01)):
            for k in range(2):
                for value in ("mean", "std"):
                    moduli = [series["structures"][0]["storage_modulus"][value][k] for series in (found, linear)]
                    self.assertAlmostEqual(moduli[0] / moduli[1], 1, delta=tolerance if value == "mean" else 20 * tolerance)
            self.assertNotEqual(found["structures"][0]["storage_modulus"], linear["structures"][0]["storage_modulus"])
        self.assertEqual([found["method"] for found in (linear, quasistatic, dem)], ["linear", "quasistatic", "dem"])
        sheared = self.succeed_json("shear", "packing.h5", "--bond-tolerance", "0.1", "--method", "dem", "--boundary", "periodic",
                                    "--amplitude", "1e-5", "--oscillations", "1", "--steps-per-oscillation", "6000",
                                    "--normal-stiffness", "50N/m", "--shear-stiffness", "5N/m", "-o", "dem.h5")
        self.assertEqual(dem["structures"][0]["storage_modulus"]["mean"][0], sheared["storage_modulus"]["mean"])
        self.assertEqual(dem["structures"][0]["storage_modulus"]["std"][0], sheared["storage_modulus"]["std"])

    def test_simple_cubic_lattice_in_closed_form(self):
        """A strain gamma slides the bonds along x and y by gamma d / 2 each, and none rotates: G = (k_s / 2) / (2 d)."""
        found = self.succeed_json("calibrate", "cube.h5", "--steps", "2")
        for stiffness, modulus in zip(found["shear_stiffness"], found["structures"][0]["storage_modulus"]["mean"]):
            self.assertAlmostEqual(modulus / (stiffness / 2 / 2e-6), 1, delta=1e-9)

    def test_matching_stiffness_gives_the_measured_modulus(self):
        found = self.succeed_json("calibrate", "packing.h5", "cube.h5", "--measured", "1.2MPa,2.5MPa")["calibration"]
        for file, measured, stiffness in zip(("packing.h5", "cube.h5"), (1.2e6, 2.5e6), found["matching_normal_stiffness"]):
            sheared = self.succeed_json("shear", file, "-o", "s.h5", "--force", "--normal-stiffness", stiffness,
                                        "--shear-stiffness", stiffness / 10)
            self.assertAlmostEqual(sheared["storage_modulus"]["mean"] / measured, 1, delta=1e-8)
        common = found["common"]
        low, high = sorted(found["matching_normal_stiffness"])
        self.assertTrue(low < common["normal_stiffness"] < high)
        for measured, modulus, difference in zip(found["measured_modulus"], common["storage_modulus"],
                                                 common["relative_difference"]):
            self.assertAlmostEqual((modulus - measured) / measured, difference, delta=1e-12)

    def test_table_and_csv(self):
        text = self.succeed("calibrate", "packing.h5", "cube.h5", "--measured", "1.2MPa,900MPa", "-o", "series.csv")
        self.assertRegex(text, r"G' at 75 N/m +\d.*Pa \+- .*, .*; ratio 1 : \d")
        self.assertRegex(text, r"matches 900 MPa +structure 2 at .* \(outside the series\)")
        with open(self.folder / "series.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["structure"] for row in rows], ["packing.h5"] * 5 + ["cube.h5"] * 5)
        self.assertEqual([float(row["normal stiffness [N/m]"]) for row in rows[:5]], [50, 75, 100, 125, 150])
        json = self.succeed_json("calibrate", "packing.h5", "cube.h5")
        self.assertEqual([float(row["modulus [Pa]"]) for row in rows[5:]], json["structures"][1]["storage_modulus"]["mean"])

    def test_structure_without_modulus(self):
        self.write("loose.csv", "x [um],y [um],z [um]\n1,1,1\n2,1,1\n")
        self.succeed("import", "loose.csv", "--radius", "0.5um", "--box", "8um", "-o", "loose.h5")
        found = self.succeed_json("calibrate", "loose.h5", "packing.h5")
        self.assertEqual(found["structures"][0]["storage_modulus"]["mean"], [0] * 5)
        self.assertIsNone(found["structures"][1]["ratio_to_first"])
        self.fail_with(2, "calibrate", "packing.h5", "loose.h5", "--measured", "1MPa,1MPa", says=["loose.h5", "no shear"])

    def test_refused(self):
        for words, says in ((["--from", "150", "--to", "50"], "upwards"), (["--from", "0"], "--from"), (["--steps", "1"], "--steps"),
                            (["--stiffness-ratio", "0"], "--stiffness-ratio"), (["--measured", "1MPa,2MPa"], "--measured"),
                            (["--measured", "1s"], "--measured"), (["--measured", "-1"], "--measured"), (["absent.h5"], "absent.h5"),
                            (["-o", "packing.h5"], "packing.h5"),
                            (["--method", "dem", "--steps-per-oscillation", "150"], "steps per oscillation"),
                            (["--method", "static"], "--method")):
            with self.subTest(words=words):
                self.fail_with(2, "calibrate", "packing.h5", *words, says=says)

    def test_same_results_for_any_number_of_threads(self):
        one, two = (self.succeed_json("calibrate", "packing.h5", "--threads", n) for n in ("1", "2"))
        self.assertEqual(one["structures"], two["structures"])


if __name__ == "__main__":
    unittest.main()
