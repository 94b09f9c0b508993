# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures against numpy and scipy: neighbours and pores by a k-d tree, q4 and q6 by a Voronoi diagram and spherical harmonics, S(q),
angles, common neighbours and windows by brute force, shortest ways and clusters of the network, and the rank of the rigidity matrix."""

import itertools
import random
import unittest

from support import PACKING, ProgramTest

try:
    import h5py
    import numpy
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components, shortest_path
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


def signature(one, other, near):
    """Common neighbours of a contact, contacts among these, and those of the largest connected set."""
    common = near[one] & near[other]
    bonds = [pair for pair in itertools.combinations(sorted(common), 2) if pair[1] in near[pair[0]]]
    largest, left = 0, set(common)
    while left:
        group, border = set(), {left.pop()}
        while border:
            group |= border
            border = {end for pair in bonds for end in pair if set(pair) & border} - group
        left -= group
        largest = max(largest, sum(pair[0] in group for pair in bonds))
    return len(common), len(bonds), largest


def window_deviation(points, box, width, spacing):
    """Standard deviation over mean of the number of points in all cubes of width^3 cells of a grid, corrected for a fixed number."""
    count = numpy.rint(numpy.array(box) / spacing).astype(int)
    cells = numpy.histogramdd(points, bins=count, range=[(0, length) for length in box])[0]
    for axis in range(3):
        cells = sum(numpy.roll(cells, -step, axis=axis) for step in range(width))
    share = width**3 / count.prod()
    return cells.std() / cells.mean() / numpy.sqrt(1 - share)


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

    def measure(self, *names, **options):
        words = [word for name, value in options.items() for word in ("--" + name.replace("_", "-"), value)]
        return self.succeed_json("characterize", "random.h5", "--only", ",".join(names), *words, "--force", "-o", "out.h5")

    def test_structure_factor(self):
        points = self.packing(300, 0.3, 0.3)[:, :3]
        found = self.measure("structure_factor", largest_wave_number="6")["structure_factor"]
        steps = 2 * numpy.pi / numpy.array(BOX)
        multiples = numpy.array(list(itertools.product(range(-20, 21), repeat=3)))
        vectors = multiples * steps
        lengths = numpy.linalg.norm(vectors, axis=1)
        shell = numpy.floor(lengths / steps.prod() ** (1 / 3) - 0.5)
        compared = 0
        for k, (direct, used) in enumerate(zip(found["direct"], found["vectors"])):
            inside = vectors[(shell == k) & (lengths > 0)]
            if len(inside) == 2 * used:  # no vector was left out
                scattered = (abs(numpy.exp(1j * inside @ points.T).sum(axis=1)) ** 2).mean() / len(points)
                self.assertAlmostEqual(direct, scattered, delta=1e-8 * scattered)
                self.assertAlmostEqual(found["wave_number"][k] * 1e-6, lengths[(shell == k) & (lengths > 0)].mean(), delta=1e-9)
                compared += 1
        self.assertGreater(compared, 4)

    def neighbours_of(self, points, reach):
        near = [set() for _ in points]
        for one, other in cKDTree(points, boxsize=BOX).query_pairs(reach):
            near[one].add(other)
            near[other].add(one)
        return near

    def test_angles_and_common_neighbours_of_contacts(self):
        points = self.packing(1500, 0.4, 0.4)[:, :3]
        found = self.measure("bond_angles", "common_neighbours")
        near = self.neighbours_of(points, 0.8 * 1.01)
        angles = []
        for centre, others in enumerate(near):
            rays = points[sorted(others)] - points[centre]
            rays -= numpy.round(rays / BOX) * BOX
            rays /= numpy.linalg.norm(rays, axis=1)[:, None]
            angles += [numpy.arccos(one @ other) for one, other in itertools.combinations(rays, 2)]
        density, _ = numpy.histogram(angles, bins=60, range=(0, numpy.pi), density=True)
        self.assertEqual(found["bond_angles"]["angles"], len(angles))
        self.assertAlmostEqual(found["bond_angles"]["mean"], numpy.mean(angles), delta=1e-9)
        self.assertLess(abs(numpy.array(found["bond_angles"]["density"]) - density).max(), 1e-9)
        contacts = [(one, other) for one, others in enumerate(near) for other in others if one < other]
        signatures = [signature(one, other, near) for one, other in contacts]
        expected = {kind: signatures.count(kind) / len(contacts) for kind in set(signatures)}
        table = {tuple(map(int, row[:3])): row[3] for row in found["common_neighbours"]["signatures"]}
        self.assertGreater(len(expected), 5)
        self.assertEqual(table.keys(), expected.keys())
        for kind, fraction in expected.items():
            self.assertAlmostEqual(table[kind], fraction, delta=1e-9)

    def test_pores(self):
        points = self.packing(500, 0.4, 0.4)[:, :3]
        found = self.measure("pores")
        samples = numpy.random.default_rng(1).uniform(0, BOX, (200000, 3))
        distances, _ = cKDTree(points, boxsize=BOX).query(samples)
        sizes = numpy.sort(distances[distances > 0.4]) - 0.4
        for radius, exact in zip(found["pore_curve"]["radius"][5:-5:10], found["pore_curve"]["exclusion_probability"][5:-5:10]):
            sampled = 1 - numpy.searchsorted(sizes, radius * 1e6) / len(sizes)
            self.assertAlmostEqual(sampled, exact, delta=5 * (exact * (1 - exact) / len(sizes)) ** 0.5 + 1e-4)
        error = sizes.std() / sizes.mean() / len(sizes) ** 0.5
        self.assertAlmostEqual(sizes.mean() * 1e-6 / found["pore_size"]["mean_m"], 1, delta=5 * error)

    def test_density_fluctuations(self):
        points = self.packing(1500, 0.4, 0.4)[:, :3]
        found = self.measure("density_fluctuations")["density_fluctuations"]
        counts = numpy.rint(numpy.array(BOX) / 0.2)
        spacing = numpy.array(BOX) / counts
        compared = 0
        for edge, deviation in zip(found["edge"], found["deviation"]):
            width = round(edge * 1e6 / spacing.prod() ** (1 / 3))
            self.assertAlmostEqual(deviation, window_deviation(points, BOX, width, 0.2), delta=1e-9)
            compared += 1
        self.assertGreater(compared, 3)

    def test_shortest_ways(self):
        found = self.succeed_json("characterize", PACKING, "--only", "betweenness,coordination_percolation", "-o", "out.h5")
        self.assertNotIn("of_contact", found["betweenness"])
        with h5py.File(self.folder / "out.h5") as file:
            group = file["characterization/betweenness"]
            pairs, values, branches = group["contacts"][()], group["of_contact"][()], group["branch_vectors"][()]
            particles = len(file["particles/trajectory/radius"])
        self.assertEqual((pairs.shape, branches.shape), ((len(values), 2), (len(values), 3)))
        network = coo_matrix((numpy.ones(len(pairs)), pairs.T), (particles, particles)).tocsr()
        ways = shortest_path(network, directed=False, unweighted=True)
        joined = numpy.isfinite(ways) & (ways > 0)
        self.assertAlmostEqual(found["betweenness"]["mean_distance"], ways[joined].mean(), delta=1e-9)
        self.assertAlmostEqual(values.sum(), ways[joined].sum() / (particles * (particles - 1)), delta=1e-9)
        degrees = numpy.bincount(pairs.ravel(), minlength=particles)
        for least, word in ((3, "three"), (6, "six")):
            chosen = network[degrees >= least][:, degrees >= least]
            largest = numpy.bincount(connected_components(chosen, directed=False)[1]).max()
            share = found["coordination_percolation"][word + "_or_more"]
            self.assertEqual(share["fraction"], chosen.shape[0] / particles)
            self.assertEqual(share["largest_fraction"], largest / particles)

    def test_rank_of_the_central_network_and_the_count_of_maxwell(self):
        self.succeed("export", PACKING, "--format", "csv", "-o", "points.csv")
        found = self.succeed_json("characterize", PACKING, "--only", "rigidity,rigidity_central", "--force", "-o", "out.h5")
        for bonds, unknowns in (("rigidity", 3000), ("rigidity_central", 1500)):
            count = found[bonds]
            self.assertEqual(count["unknowns"], unknowns)
            self.assertEqual(count["self_stresses"] - count["floppy_modes"] - count["rigid_motions"], count["constraints"] - unknowns)
        rows = numpy.loadtxt(self.folder / "points.csv", delimiter=",", skiprows=1)
        points = rows[:, :3] / rows[0, 3]
        edge = (len(points) * 4 * numpy.pi / 3 / 0.4) ** (1 / 3)
        pairs = cKDTree(points % edge, boxsize=edge).query_pairs(2 * 1.01, output_type="ndarray")
        rays = points[pairs[:, 1]] - points[pairs[:, 0]]
        rays -= numpy.round(rays / edge) * edge
        matrix = numpy.zeros((len(pairs), unknowns))
        for row, ((one, other), ray) in enumerate(zip(pairs, rays / numpy.linalg.norm(rays, axis=1)[:, None])):
            matrix[row, 3 * one : 3 * one + 3] = -ray
            matrix[row, 3 * other : 3 * other + 3] = ray
        self.assertEqual(found["rigidity_central"]["constraints"], len(pairs))
        self.assertEqual(found["rigidity_central"]["rank"], numpy.linalg.matrix_rank(matrix, tol=1e-9))


if __name__ == "__main__":
    unittest.main()
