# SPDX-License-Identifier: GPL-3.0-or-later
"""Packings that measures cannot be made of: each is refused with one sentence that names the file, or measured without a number missing."""

import itertools
import math
import random
import re
import shutil
import unittest

import h5py
import numpy

from support import PACKING, ProgramTest, checksum

ONLY_ALL = ["--only", "all", "--samples", "1000", "--most-voxels", "20000"]


class Packings(ProgramTest):
    def packing(self, points, *options):
        self.write("p.csv", "x [um],y [um],z [um]\n" + "".join(f"{x},{y},{z}\n" for x, y, z in points))
        self.succeed("import", "p.csv", "--radius", "0.5um", *options, "--force", "-o", "p.h5")

    def random_points(self, count):
        generator = random.Random(count)
        return [[generator.uniform(0, 8) for _ in range(3)] for _ in range(count)]

    def refuse(self, only, says):
        before = checksum(self.folder / "p.h5")
        words = ["--only", only] if only else []
        sentence = self.fail_with(2, "characterize", "p.h5", *words, says=["p.h5: ", *says])
        self.assertEqual(checksum(self.folder / "p.h5"), before)
        return sentence

    @staticmethod
    def spaced(text):
        return re.sub(" {2,}", "  ", text)

    def measure_all(self):
        """Every measure that applies, and the sentences of those that do not."""
        text = self.succeed("characterize", "p.h5", "--samples", "1000", "--force", "-o", "out.h5")
        self.assertNotRegex(text, r"\bnan\b|\binf\b")
        found = self.succeed_json("characterize", "p.h5", *ONLY_ALL, "--force", "-o", "out.h5")
        self.assertIn("rigidity", found)
        return text

    def measure_in_a_periodic_box(self, *counts):
        for count in counts:
            self.packing(self.random_points(count), "--box", "8um")
            self.measure_all()

    def test_one_or_two_points_in_a_periodic_box(self):
        self.measure_in_a_periodic_box(1, 2)

    def test_three_or_four_points_in_a_periodic_box(self):
        self.measure_in_a_periodic_box(3, 4)

    def test_few_points_with_a_free_surface(self):
        for count in (1, 2, 3, 4):
            self.packing(self.random_points(count), "--open")
            for only in ("pair_correlation", "structure_factor"):
                self.refuse(only, [only, f"has {count} particles", "at least 5"])
            for only in ("pores", "doh", "bond_order", "minkowski"):
                self.refuse(only, [f"{count} particles"])
            self.refuse("voronoi", ["fewer than two"])
            text = self.spaced(self.succeed("characterize", "p.h5"))
            self.assertIn(f"doh  left out: the packing has a free surface and {count} particles", text)
            self.refuse("chord_lengths", ["periodic"])
            self.refuse("transport", ["periodic"])
            self.refuse("neighbour_distances", [f"{count} particles", "neighbour 12"])

    def test_points_in_a_plane_or_on_a_line(self):
        plane = [(1.1 * x, 1.1 * y, 2) for x in range(3) for y in range(3)]  # larger ones are refused on import
        line = [(1.1 * x, 2, 2) for x in range(7)]
        for points in (plane, line):
            self.packing(points, "--open")
            for only in ("pores", "minkowski", "pair_correlation", "structure_factor"):
                self.refuse(only, [f"{len(points)} particles", "in one plane"])
            self.packing(points, "--box", "8um")
            self.measure_all()

    def test_a_box_smaller_than_two_diameters(self):
        """Particles see their own images; what needs room says so."""
        self.packing([(0.2, 0.2, 0.2), (1.2, 1.2, 1.2)], "--box", "1.8um")
        text = self.measure_all()
        self.assertIn("too small for density fluctuations", text)
        self.refuse("density_fluctuations", ["too small for density fluctuations"])
        self.refuse_range("3um", "half the shortest length")
        self.packing([(0.6, 0.6, 0.6 + 1.1 * k) for k in range(10)], "--box", "1.2um,1.2um,12um")
        self.measure_all()

    def test_crystals_with_the_rounding_of_single_precision(self):
        """Their Voronoi cells are alike but for rounding: no gamma law is fitted, and nothing else is lost."""
        edges = (1, math.sqrt(3), 2 * math.sqrt(2 / 3))
        sites = ((0, 0, 0), (0.5, 0.5, 0), (0.5, 1 / 6, 0.5), (0, 2 / 3, 0.5))
        points = [[float(numpy.float32((cell[axis] + site[axis] + 0.0625) * edges[axis])) for axis in range(3)]
                  for cell in itertools.product(range(3), repeat=3) for site in sites]
        self.packing(points, "--box", ",".join(f"{3 * edge:.9f}um" for edge in edges))
        text = self.measure_all()
        self.assertRegex(text, r"gamma law of the free volumes +none: all cells are alike")
        found = self.succeed_json("characterize", "p.h5")
        self.assertEqual((found["coordination"], found["common_neighbours"]["hcp"]), (12, 1))
        self.assertNotIn("shape", found["voronoi"])
        self.assertAlmostEqual(found["voronoi"]["mean"] / (1e-18 / math.sqrt(2)), 1, delta=1e-7)

    def refuse_range(self, length, says):
        self.fail_with(2, "characterize", "p.h5", "--pair-range", length, says=["p.h5: ", says])

    def scale_radii(self, which, factor):
        with h5py.File(self.folder / "p.h5", "r+") as file:
            radii = file["particles/trajectory/radius"]
            radii[which] = factor * radii[which]

    def test_spheres_larger_than_the_box(self):
        self.packing(self.random_points(5), "--box", "8um")
        self.scale_radii(slice(None), 30)
        for only in (None, "pores", "coordination"):
            self.refuse(only, ["overfull"])

    def test_zero_radii(self):
        self.write("z.csv", "x [um],y [um],z [um],radius [um]\n1,1,1,0.5\n3,3,3,0\n")
        self.fail_with(2, "import", "z.csv", "--box", "8um", "-o", "z.h5", says=["z.csv, line 3", "radius is 0", "positive"])
        self.fail_with(2, "import", "z.csv", "--radius", "0", "--box", "8um", "-o", "z.h5", says="--radius")
        shutil.copy(PACKING, self.folder / "p.h5")
        self.scale_radii(7, 0)
        self.fail_with(2, "characterize", "p.h5", says=["p.h5", "particle 7", "radius"])

    def test_duplicates_and_points_outside(self):
        self.write("d.csv", "x [um],y [um],z [um]\n1,1,1\n3,3,3\n1,1,1\n")
        self.fail_with(2, "import", "d.csv", "--radius", "0.5um", "--box", "8um", "-o", "d.h5", says=["d.csv", "0 and 2", "same centre"])
        self.write("d.csv", "x [um],y [um],z [um]\n1,1,1\n3,-3,3\n")
        self.fail_with(2, "import", "d.csv", "--radius", "0.5um", "--box", "8um", "-o", "d.h5", says=["d.csv, line 3", "outside"])


if __name__ == "__main__":
    unittest.main()
