# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of two structures is more heterogeneous, by three measures."""

from support import VEM, ProgramTest, checksum


class Compare(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing("even.h5")  # with 250 voids

    def uneven(self):
        self.succeed(*VEM[:5], "30", *VEM[6:], "--seed", "3", "-o", "uneven.h5")

    def test_fewer_voids_are_more_heterogeneous(self):
        self.uneven()
        before = [checksum(self.folder / name) for name in ("even.h5", "uneven.h5")]
        found = self.succeed_json("characterize", "even.h5", "uneven.h5", "--compare")
        self.assertEqual(found["files"], ["even.h5", "uneven.h5"])
        self.assertEqual(found["more_heterogeneous"], "uneven.h5")
        self.assertIn(found["agreement"], ("all", "some"))
        self.assertTrue(found["fair"])
        self.assertEqual(found["unfair"], [])
        self.assertEqual(set(found["measures"]), {"pore_sizes", "voronoi_volumes", "density_fluctuations"})
        for measure in found["measures"].values():
            first, second = measure["values"]
            error = sum(value * value for value in measure["standard_errors"]) ** 0.5
            self.assertAlmostEqual(measure["difference"], second - first, places=12)
            self.assertAlmostEqual(measure["difference_error"], error, places=12)
            told = "uneven.h5" if second - first > 2 * error else ("even.h5" if first - second > 2 * error else None)
            self.assertEqual(measure["more_heterogeneous"], told)
        alone = self.succeed_json("characterize", "even.h5", "-o", "out.h5")
        self.assertEqual(found["measures"]["pore_sizes"]["values"][0], alone["doh"]["a"])
        self.assertEqual(found["measures"]["pore_sizes"]["standard_errors"][0], alone["uncertainty"]["doh"]["a"])
        self.assertEqual(found["pore_sizes_main_part"]["values"][0], alone["doh"]["a_main_part"])
        self.assertEqual([checksum(self.folder / name) for name in ("even.h5", "uneven.h5")], before)

    def test_table(self):
        self.uneven()
        table = self.succeed("characterize", "even.h5", "uneven.h5", "--compare")
        for part in ("pore sizes", "voronoi volumes", "density fluctuations", "fit to P >= 0.1 only", "verdict", "uneven.h5 is more"):
            self.assertIn(part, table)
        self.assertNotIn("not a fair comparison", table)

    def test_it_says_when_a_comparison_is_not_fair(self):
        self.succeed(*VEM[:3], "200", "--voids", "100", "--volume-fraction", "0.3", *VEM[8:], "-o", "other.h5")
        found = self.succeed_json("characterize", "even.h5", "other.h5", "--compare")
        self.assertFalse(found["fair"])
        self.assertIn("volume fractions are 0.4 and 0.3", found["unfair"][0])
        self.assertIn("not a fair comparison", self.succeed("characterize", "even.h5", "other.h5", "--compare"))

    def test_what_is_refused(self):
        self.copy_of_packing("uneven.h5")
        self.fail_with(2, "characterize", "even.h5", "--compare", says="two files")
        self.fail_with(2, "characterize", "even.h5", "uneven.h5", says="--compare")
        self.fail_with(2, "characterize", "even.h5", "none.h5", "--compare", says="none.h5")
        for option in (["--only", "doh"], ["-o", "c.h5"], ["--position-noise", "1nm"], ["--samples", "100"]):
            self.fail_with(2, "characterize", "even.h5", "uneven.h5", "--compare", *option, says="--compare")
