# SPDX-License-Identifier: GPL-3.0-or-later
"""The structures of the paper as a data set: what was made lies beside what was published."""

import csv
import math
import os
import pathlib
import unittest

from support import ProgramTest

try:
    import h5py
except ImportError:
    h5py = None

FOLDER = pathlib.Path(os.environ["COAGULA_DATASETS"]) / "schenker2012"


class PublishedStructures(ProgramTest):
    def table(self):
        return list(csv.DictReader(self.succeed("dataset", "table", FOLDER / "structures.h5").splitlines()))

    def published(self):
        with open(FOLDER / "published_structures.csv", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    def test_heterogeneity_and_coordination_are_the_published(self):
        made = self.table()
        self.assertEqual(len(made), 12)
        for ours, theirs in zip(made, self.published()):  # both in the order of the paper's table
            self.assertAlmostEqual(float(ours["coordination"]), float(theirs["coordination"]), delta=0.06)
            self.assertAlmostEqual(float(ours["doh.a"]), float(theirs["doh_a"]), delta=0.035)
            parameter = "voids" if theirs["generator"] == "vem" else "surface-potential [V]"
            self.assertTrue(math.isclose(float(ours[parameter]), float(theirs["parameter"]) * (1 if parameter == "voids" else 1e-3)))

    def test_structures_have_their_checksums(self):
        self.assertIn("all with the checksums", self.succeed("dataset", "verify", FOLDER / "structures.h5", "--sample", "0"))

    @unittest.skipIf(h5py is None, "h5py is not installed (Debian: python3-h5py)")
    def test_a_structure_is_measured_as_in_the_table(self):
        row = self.table()[6]
        with h5py.File(FOLDER / "structures.h5") as whole, h5py.File(self.folder / "structure.h5", "w") as alone:
            for name in whole["structures"][row["id"]]:
                whole.copy(f"structures/{row['id']}/{name}", alone)
        found = self.succeed_json("characterize", "structure.h5", "--only", "coordination,doh,topology")
        self.assertAlmostEqual(found["coordination"], float(row["coordination"]), places=12)
        self.assertAlmostEqual(found["doh"]["a"], float(row["doh.a"]), places=9)
        self.assertAlmostEqual(found["topology"]["triangles"], float(row["topology.triangles"]), places=12)

    def test_a_structure_has_a_page(self):
        row = self.table()[6]
        page = self.folder / "structure.html"
        self.succeed("report", FOLDER / "structures.h5", "--structure", row["id"], "-o", page)
        self.assertGreater(page.stat().st_size, 100000)


if __name__ == "__main__":
    unittest.main()
