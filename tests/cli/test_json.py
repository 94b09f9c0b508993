# SPDX-License-Identifier: GPL-3.0-or-later
"""The machine-readable results: keys, shapes and relations between the values."""

import csv
import io
import math
import unittest

from support import SMALL, VEM, ProgramTest

R0 = 0.25e-6


class Characterize(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()

    def test_keys_and_values(self):
        found = self.succeed_json("characterize", "packing.h5")
        self.assertEqual(found["particles"], 500)
        self.assertAlmostEqual(found["volume_fraction"], 0.4, delta=1e-9)
        edge = (500 * 4 / 3 * math.pi * R0**3 / 0.4) ** (1 / 3)
        for length in found["box"]:
            self.assertAlmostEqual(length / edge, 1, delta=1e-9)
        self.assertEqual(found["contact_tolerance"], 0.01)
        self.assertGreater(found["coordination"], 4.5)
        self.assertLess(found["coordination"], 5.0)
        self.assertTrue(0 <= found["rattler_fraction"] < 0.2)
        self.assertEqual(set(found["doh"]), {"a", "b", "a_stderr", "b_stderr", "rms_residual", "a_main_part", "b_main_part"})
        self.assertTrue(0.38 < found["doh"]["a"] < 0.55)
        self.assertLess(found["doh"]["rms_residual"], 0.03)
        self.assertTrue(0 <= found["overlap"]["mean"] <= found["overlap"]["max"] < 0.02)

    def test_histogram_adds_up(self):
        found = self.succeed_json("characterize", "packing.h5", "--only", "coordination")
        histogram = found["coordination_histogram"]
        self.assertEqual(sum(histogram), 500)
        contacts = sum(count * number for number, count in enumerate(histogram))
        self.assertAlmostEqual(contacts / 500, found["coordination"], delta=1e-12)
        self.assertEqual(contacts, 2 * found["contacts"])

    def test_pore_sizes_in_radii_and_metres(self):
        pores = self.succeed_json("characterize", "packing.h5", "--only", "pores")["pore_size"]
        for name, suffix, unit in (("mean", "_m", R0), ("median", "_m", R0), ("max", "_m", R0), ("second_moment", "_m2", R0**2)):
            self.assertAlmostEqual(pores[name + suffix] / unit / pores[name], 1, delta=1e-6)
        self.assertLess(pores["median"], pores["max"])
        self.assertGreater(pores["second_moment"], pores["mean"] ** 2)

    def test_pore_curve(self):
        curve = self.succeed_json("characterize", "packing.h5", "--radii", "50", "--only", "doh")["pore_curve"]
        probability = curve["exclusion_probability"]
        self.assertEqual([len(values) for values in curve.values()], [50, 50, 50])
        self.assertAlmostEqual(probability[0], 1, delta=1e-9)
        self.assertAlmostEqual(probability[-1], 0, delta=1e-9)
        self.assertEqual(probability, sorted(probability, reverse=True))

    def test_only_leaves_out_the_rest(self):
        found = self.succeed_json("characterize", "packing.h5", "--only", "overlap")
        self.assertIn("overlap", found)
        for name in ("doh", "pore_size", "coordination"):
            self.assertNotIn(name, found)

    def test_exact_curve_agrees_with_samples(self):
        check = self.succeed_json("characterize", "packing.h5", "--samples", "200000", "--seed", "3")["sampled_check"]
        self.assertGreater(check["radii"], 100)
        self.assertGreater(check["void_points"], 100000)
        # The 200 radii share their points; the largest deviation of such a curve exceeds 4 in fewer than one seed in a thousand.
        self.assertLess(check["largest_z"], 4)
        self.assertGreater(check["largest_z"], 0.1)


class Shear(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()

    def test_keys_and_values(self):
        found = self.succeed_json("shear", "packing.h5")
        self.assertEqual(found["method"], "linear")
        self.assertAlmostEqual(found["contact_stiffness"]["normal"], 50, delta=1e-9)
        self.assertAlmostEqual(found["contact_stiffness"]["shear"], 5, delta=1e-9)
        self.assertTrue(1000 < found["contacts"] < 1300)
        self.assertIn("floppy_modes", found)
        self.assertGreaterEqual(found["rattlers"], 0)
        planes = {"xy", "xz", "yx", "yz", "zx", "zy"}
        self.assertEqual(set(found["storage_modulus"]), planes | {"mean", "std"})
        self.assertEqual(set(found["loss_modulus"]), planes | {"mean", "std"})
        self.assertEqual(found["phase"], 0)
        self.assertGreater(found["seconds"], 0)

    def test_moduli_are_those_of_the_tensor(self):
        found = self.succeed_json("shear", "packing.h5")
        tensor = found["elastic_tensor"]
        self.assertEqual([len(row) for row in tensor], [6] * 6)
        largest = max(abs(value) for row in tensor for value in row)
        for i in range(6):
            for j in range(6):
                self.assertAlmostEqual(tensor[i][j] / largest, tensor[j][i] / largest, delta=1e-8)
        modulus = found["storage_modulus"]
        for place, names in ((3, ("yz", "zy")), (4, ("xz", "zx")), (5, ("xy", "yx"))):
            for name in names:
                self.assertAlmostEqual(modulus[name] / tensor[place][place], 1, delta=1e-12)
        six = [modulus[name] for name in ("xy", "xz", "yx", "yz", "zx", "zy")]
        self.assertAlmostEqual(sum(six) / 6 / modulus["mean"], 1, delta=1e-12)
        self.assertTrue(0 < modulus["mean"] < found["affine_modulus"])

    def test_modulus_is_proportional_to_the_stiffness(self):
        once = self.succeed_json("shear", "packing.h5", "-o", "a.h5")
        twice = self.succeed_json("shear", "packing.h5", "-o", "b.h5", "--normal-stiffness", "200N/m", "--shear-stiffness", "20N/m")
        ratio = twice["storage_modulus"]["mean"] / once["storage_modulus"]["mean"]
        self.assertAlmostEqual(ratio, 2, delta=1e-6)

    def test_direct_and_iterative_agree(self):
        direct = self.succeed_json("shear", "packing.h5", "-o", "a.h5", "--solver", "direct")
        iterative = self.succeed_json("shear", "packing.h5", "-o", "b.h5", "--solver", "iterative")
        self.assertEqual((direct["solver"], iterative["solver"]), ("direct", "iterative"))
        ratio = iterative["storage_modulus"]["mean"] / direct["storage_modulus"]["mean"]
        self.assertAlmostEqual(ratio, 1, delta=1e-6)


class OtherVerbs(ProgramTest):
    def test_generate(self):
        made = self.succeed_json(*VEM, "--seed", "2", "-o", "a.h5")
        self.assertEqual((made["particles"], made["voids"], made["seed"]), (500, 250, 2))
        self.assertAlmostEqual(made["coordination"], 4.69, delta=0.15)
        self.assertLess(made["overlap"]["rms"], 0.005)

    def test_info_of_many_files_is_a_table(self):
        self.copy_of_packing("a.h5")
        self.copy_of_packing("b, c.h5")
        found = self.succeed_json("characterize", "a.h5", "--only", "coordination")
        sheared = self.succeed_json("shear", "b, c.h5")
        rows = list(csv.DictReader(io.StringIO(self.succeed("info", "a.h5", "b, c.h5", "--csv"))))
        self.assertEqual([row["file"] for row in rows], ["a.h5", "b, c.h5"])
        self.assertEqual([row["particles"] for row in rows], ["500", "500"])
        self.assertEqual(float(rows[0]["characterization/coordination"]), found["coordination"])
        self.assertEqual(rows[1]["characterization/coordination"], "")
        self.assertEqual(rows[0]["mechanics/linear/storage_modulus/mean [Pa]"], "")
        self.assertEqual(float(rows[1]["mechanics/linear/storage_modulus/mean [Pa]"]), sheared["storage_modulus"]["mean"])
        self.assertEqual(float(rows[1]["box_x [m]"]), self.succeed_json("info", "a.h5")["box"][0])
        both = self.succeed_json("info", "a.h5", "b, c.h5")["files"]
        self.assertEqual([file["file"] for file in both], ["a.h5", "b, c.h5"])
        self.assertEqual(both[1]["results"]["/mechanics/linear/contacts"]["value"], sheared["contacts"])
        self.assertEqual((rows[0]["generator"], rows[0]["voids"], rows[0]["target-coordination"]), ("vem", "250", "4.69"))
        self.fail_with(2, "info", "a.h5", "--csv", "--json", says="--json")
        self.fail_with(2, "info", "a.h5", "absent.h5", "--csv", says="absent.h5")

    def test_the_table_has_the_recipes(self):
        self.succeed(*SMALL, "--seed", "3", "--target-coordination", "4.2", "-o", "few.h5")
        self.succeed("generate", "vem", "--particles", "61", "--volume-fraction", "0.35", "--radius", "1um", "--seed", "4", "-o", "usual.h5")
        self.succeed("generate", "brownian", "--particles", "50", "--surface-potential", "0mV", "--volume-fraction", "0.2", "--radius",
                     "0.25um", "--equilibration-time", "1us", "--stop-time", "10us", "--seed", "5", "-o", "moving.h5")
        self.write("p.csv", "x [um],y [um],z [um]\n1,1,1\n2,2,2\n")
        self.succeed("import", "p.csv", "--radius", "0.2um", "--box", "4um", "-o", "points.h5")
        rows = list(csv.DictReader(io.StringIO(self.succeed("info", "few.h5", "usual.h5", "moving.h5", "points.h5", "--csv"))))
        self.assertEqual([row["generator"] for row in rows], ["vem", "vem", "brownian", "import"])
        self.assertEqual([row["seed"] for row in rows], ["3", "4", "5", ""])
        self.assertEqual([row["voids"] for row in rows], ["30", "30", "", ""])  # half of the particles when not given
        self.assertEqual([row["target-coordination"] for row in rows], ["4.2", "4.69", "", ""])
        self.assertEqual([row["volume-fraction"] for row in rows], ["0.4", "0.35", "0.2", ""])
        self.assertEqual([float(row["radius [m]"] or 0) for row in rows], [2.5e-7, 1e-6, 2.5e-7, 0])
        self.assertEqual([float(row["stop-time [s]"] or 0) for row in rows], [0, 0, 1e-5, 0])
        self.assertFalse({"output", "force", "quiet", "checkpoint-interval [s]"} & set(rows[0]))

    def test_info_lists_results_with_units_and_history(self):
        self.copy_of_packing()
        found = self.succeed_json("characterize", "packing.h5", "--only", "coordination")
        sheared = self.succeed_json("shear", "packing.h5")
        info = self.succeed_json("info", "packing.h5")
        self.assertEqual((info["particles"], info["periodic"]), (500, True))
        self.assertEqual(info["bonds"], sheared["contacts"])
        self.assertEqual(info["results"]["/characterization/coordination"]["value"], found["coordination"])
        modulus = info["results"]["/mechanics/linear/storage_modulus/mean"]
        self.assertEqual((modulus["value"], modulus["unit"]), (sheared["storage_modulus"]["mean"], "Pa"))
        for result in info["results"].values():
            self.assertTrue(result["unit"] and result["description"])
        history = info["provenance"]
        self.assertEqual([entry["stage"] for entry in history], ["generate vem", "characterize", "shear"])
        self.assertEqual(history[0]["options"]["particles"], 500)
        self.assertEqual(history[0]["seed"], 1)
        self.assertEqual(history[1]["positions_sha256"], history[2]["positions_sha256"])
        self.assertRegex(history[1]["positions_sha256"], "^[0-9a-f]{64}$")
        self.assertIn("coagula shear packing.h5", history[2]["command_line"])

    def test_tables_for_people(self):
        self.copy_of_packing()
        self.assertRegex(self.succeed("characterize", "packing.h5"), r"degree of heterogeneity a +0\.\d+ \+- ")
        self.assertRegex(self.succeed("shear", "packing.h5"), r"shear modulus G' +\d.* [kM]Pa")
        self.assertEqual(self.succeed("shear", "packing.h5", "--quiet"), "")


if __name__ == "__main__":
    unittest.main()
