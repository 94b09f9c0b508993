"""Pair measures against scipy: neighbours by its k-d tree, q4 and q6 by its Voronoi diagram and spherical harmonics."""

import random
import unittest

from support import ProgramTest

try:
    import numpy
    from scipy.spatial import Voronoi, cKDTree
    from scipy.special import sph_harm
except ImportError:  # python3-scipy
    numpy = None

BOX = (9.0, 10.0, 11.0)


def polygon_area(corners):
    middle = corners.mean(axis=0)
    rays = corners - middle
    return 0.5 * numpy.linalg.norm(numpy.cross(rays, numpy.roll(rays, -1, axis=0)).sum(axis=0))


def bond_order(points, degree):
    """Mean over the particles of q_l with the areas of the Voronoi facets as weights."""
    shifts = [numpy.array((x, y, z)) * BOX for x in (0, -1, 1) for y in (0, -1, 1) for z in (0, -1, 1)]
    images = numpy.concatenate([points + shift for shift in shifts])
    diagram = Voronoi(images)
    count = len(points)
    moments = numpy.zeros((count, 2 * degree + 1), dtype=complex)
    surface = numpy.zeros(count)
    for (one, other), corners in zip(diagram.ridge_points, diagram.ridge_vertices):
        for site, neighbour in ((one, other), (other, one)):
            if site < count:
                area = polygon_area(diagram.vertices[corners])
                x, y, z = images[neighbour] - images[site]
                azimuth, polar = numpy.arctan2(y, x), numpy.arctan2(numpy.hypot(x, y), z)
                moments[site] += area * sph_harm(numpy.arange(-degree, degree + 1), degree, azimuth, polar)
                surface[site] += area
    squares = (abs(moments / surface[:, None]) ** 2).sum(axis=1)
    return numpy.sqrt(4 * numpy.pi / (2 * degree + 1) * squares).mean()


@unittest.skipIf(numpy is None, "python3-scipy is not installed")
class AgainstScipy(ProgramTest):
    def packing(self, count, low, high):
        generator = random.Random(7)
        rows = [[generator.uniform(0, length) for length in BOX] + [generator.uniform(low, high)] for _ in range(count)]
        lines = ["x [um],y [um],z [um],radius [um]"] + [",".join(map(repr, row)) for row in rows]
        self.write("random.csv", "\n".join(lines) + "\n")
        self.succeed("import", "random.csv", "--box", "9um,10um,11um", "-o", "random.h5")
        return numpy.array(rows)

    def test_neighbours(self):
        rows = self.packing(1500, 0.2, 0.5)
        found = self.succeed_json("characterize", "random.h5", "--only", "pair_correlation,neighbour_distances", "-o", "out.h5")
        tree = cKDTree(rows[:, :3], boxsize=BOX)
        upper = numpy.array(found["pair_correlation"]["upper"]) * 1e6
        neighbours = tree.count_neighbors(tree, upper) / 1500 - 1
        self.assertGreater(neighbours[-1], 500)
        for expected, value in zip(neighbours, found["pair_correlation"]["neighbours"]):
            self.assertAlmostEqual(value, expected, delta=1e-9 * (1 + expected))
        distances, _ = tree.query(rows[:, :3], k=13)
        for order, value in enumerate(found["neighbour_distances"]["mean"], start=1):
            self.assertAlmostEqual(value * 1e6, distances[:, order].mean(), delta=1e-9)

    def test_bond_order(self):
        rows = self.packing(150, 0.3, 0.3)
        found = self.succeed_json("characterize", "random.h5", "--only", "bond_order", "-o", "out.h5")["bond_order"]
        self.assertAlmostEqual(found["q4"], bond_order(rows[:, :3], 4), delta=1e-9)
        self.assertAlmostEqual(found["q6"], bond_order(rows[:, :3], 6), delta=1e-9)


if __name__ == "__main__":
    unittest.main()
