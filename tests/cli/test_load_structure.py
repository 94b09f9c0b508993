# SPDX-License-Identifier: GPL-3.0-or-later
"""What `coagula shear` says about what carries the load."""

import math
import re
import unittest

import h5py

from support import ProgramTest

PLANES = ("xy", "xz", "yz")


def sorted_columns(values):
    values = values.copy()
    values.sort(axis=0)
    return values


class LoadStructure(ProgramTest):
    def imported(self, places, edge=8):
        self.write("points.csv", "x [um],y [um],z [um]\n" + "".join(f"{x},{y},{z}\n" for x, y, z in places))
        self.succeed("import", "points.csv", "--radius", "0.5um", "--box", f"{edge}um", "-o", "points.h5")
        return "points.h5"

    def test_keys_and_relations(self):
        self.copy_of_packing()
        sheared = self.succeed_json("shear", "packing.h5")
        found = sheared["load_structure"]
        self.assertEqual(found["summary"], "shear is carried in xy, xz, yz")
        self.assertEqual(found["percolates"], [1, 1, 1])
        self.assertAlmostEqual(sum(found["fabric"]["eigenvalues"]), 1, delta=1e-12)
        self.assertTrue(0 < found["fabric"]["anisotropy"] < 0.2)
        for plane in PLANES:
            load = found[plane]
            self.assertEqual(load["carried"], 1)
            self.assertNotIn("bonds", load)  # one value per bond stays in the file
            bonds = load["backbone"]["bonds"]
            self.assertAlmostEqual(load["backbone"]["bond_fraction"], bonds / sheared["contacts"], delta=1e-12)
            self.assertTrue(0 < bonds < load["force_distribution"]["bonds"] <= sheared["contacts"])
            self.assertTrue(0 < load["backbone"]["particles"] <= 500 - sheared["rattlers"])
            ten, twenty, half = load["strongest_share"]
            self.assertTrue(0.1 < ten < twenty < half <= 1)
            self.assertTrue(0 < load["energy_participation"] < 1)
            for motion, particles in ((load["nonaffinity"], 500 - sheared["rattlers"]),
                                      (load["backbone"]["nonaffinity"], load["backbone"]["particles"])):
                self.assertEqual(motion["particles"], particles)
                self.assertTrue(0 < motion["participation"] < 1)
                self.assertTrue(0 < motion["median"] < motion["mean_square"] ** 0.5)
            self.assertTrue(0 < load["shear_spring_share"] < 1)
            density = load["force_distribution"]["density"]
            total = sum(density) * load["force_distribution"]["bin_width"] + load["force_distribution"]["beyond"]
            self.assertAlmostEqual(total, 1, delta=1e-12)
            modulus = sheared["storage_modulus"][plane]
            volume = 500 * 4 / 3 * 3.141592653589793 * 0.25e-6**3 / 0.4
            self.assertAlmostEqual(2 * load["energy"] / volume / modulus, 1, delta=1e-6)
        fractions = [found[plane]["backbone"]["bond_fraction"] for plane in PLANES]
        self.assertAlmostEqual(found["mean"]["backbone_bond_fraction"], sum(fractions) / 3, delta=1e-12)
        self.assertRegex(self.succeed("shear", "packing.h5"), r"backbone +\d.* % of the bonds store 90 % of the energy; .* x, y, z\n")

    def test_values_of_bonds_and_particles(self):
        self.copy_of_packing()
        found = self.succeed_json("shear", "packing.h5")
        with h5py.File(self.folder / "packing.h5") as file:
            for plane in PLANES:
                bonds = file[f"mechanics/linear/load_structure/{plane}/bonds"]
                self.assertEqual({name: data.shape for name, data in bonds.items()},
                                 {name: (found["contacts"],) for name in ("normal_force", "shear_force", "energy_share", "backbone")})
                share = bonds["energy_share"][()]
                backbone = bonds["backbone"][()]
                self.assertAlmostEqual(share.sum(), 1, delta=1e-5)
                self.assertEqual(backbone.sum(), found["load_structure"][plane]["backbone"]["bonds"])
                self.assertAlmostEqual(share[backbone == 1].sum(), 0.9, delta=0.01)
                self.assertGreaterEqual(share[backbone == 1].min(), share[backbone == 0].max())
                points = file["VTKHDF/PointData"]
                self.assertAlmostEqual(points[f"energy_share_{plane}"][()].sum(), 1, delta=1e-5)
                displacement = points[f"nonaffine_displacement_{plane}"][()]
                bearing = abs(displacement).max(axis=1) > 0
                self.assertEqual(bearing.sum(), 500 - found["rattlers"])
                displacement[bearing] -= sorted_columns(displacement[bearing])[bearing.sum() // 2]
                lengths = (displacement**2).sum(axis=1) ** 0.5 / 0.25e-6
                self.assertLess(abs(points[f"nonaffinity_{plane}"][()] - lengths).max(), 1e-6 * lengths.max())

    def test_cell_data_fit_the_cells(self):
        self.copy_of_packing()
        for tolerance in ("0.01", "0.03"):
            self.succeed("shear", "packing.h5", "--bond-tolerance", tolerance, "--force")
            with h5py.File(self.folder / "packing.h5") as file:
                view = file["VTKHDF"]
                cells = view["NumberOfCells"][0]
                lines = view["Types"][()] == 3
                for plane in PLANES:
                    backbone = view[f"CellData/backbone_{plane}"][()]
                    self.assertEqual((backbone.shape, set(backbone)), ((cells,), {0, 1}))
                    self.assertEqual(backbone[~lines].max(), 0)
                    force = view[f"CellData/normal_force_{plane}"][()]
                    self.assertEqual(force.shape, (cells,))
                    stored = file[f"mechanics/linear/load_structure/{plane}/bonds/normal_force"][()]
                    self.assertTrue(set(force[lines]) <= set(stored.astype("f4")))
        # Another stage leaves cells and their data as they are.
        self.succeed("characterize", "packing.h5", "--contact-tolerance", "0.02")
        with h5py.File(self.folder / "packing.h5") as file:
            for data in file["VTKHDF/CellData"].values():
                self.assertEqual(data.shape[0], file["VTKHDF/NumberOfCells"][0])

    def test_packing_without_bonds(self):
        self.imported([(1, 1, 1), (3, 1, 1), (1, 3, 1), (5, 5, 5)])
        found = self.succeed_json("shear", "points.h5")
        self.assertEqual(found["storage_modulus"]["mean"], 0)
        self.assertEqual(found["load_structure"]["summary"], "G' = 0 in xy, xz, yz: no two particles are bonded")
        self.assertEqual(found["load_structure"]["xy"]["backbone"]["bonds"], 0)
        self.assertIn("no two particles are bonded", self.succeed("shear", "points.h5"))

    def test_clusters_that_do_not_reach_around_the_box_have_no_modulus(self):
        """Zero, with the reason, and not what rounding or inertia leaves, whatever the method and the solver."""
        tetrahedron = ((0, 0, 0), (1, 0, 0), (0.5, 0.8660254, 0), (0.5, 0.2886751, 0.8164966))

        def turned(x, y, z, a, b):
            x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
            return x, y * math.cos(b) - z * math.sin(b), y * math.sin(b) + z * math.cos(b)

        self.imported([[c + p for c, p in zip(corner, turned(*point, 0.3 + k, 0.7 + 2 * k))]
                       for k, corner in enumerate(((1.5, 1.5, 1.5), (5, 5.2, 4.9), (1.7, 5, 5), (5, 1.6, 1.7))) for point in tetrahedron])
        self.write("loss.toml", 'normal_viscosity = "1e-3 N.s/m"\n')
        dem = ["--method", "dem", "--boundary", "periodic", "--oscillations", "1", "--steps-per-oscillation", "2400"]
        for words in ([], ["--solver", "iterative"], ["--frequency", "1Hz,1kHz", "--model", "loss.toml"], ["--method", "quasistatic"],
                      ["--method", "quasistatic", "--amplitudes", "1e-3,1e-2", "--orientation", "xy,zx"], [*dem, "--orientation", "xy,zx"]):
            found = self.succeed_json("shear", "points.h5", *words, "--force")
            self.assertEqual((found["contacts"], found["rattlers"]), (24, 0))
            for modulus in ("storage_modulus", "loss_modulus"):
                values = re.findall(r"[\d.e-]+", str([value for value in found[modulus].values() if value is not None]))
                self.assertEqual(set(map(float, values)) - {0}, set(), f"{words}: {found[modulus]}")
            reason = found.get("no_modulus") or found["load_structure"]["summary"]
            self.assertTrue(reason.startswith("G' = 0 in xy: the bonded network does not reach around the box along x and y"), reason)
            self.assertRegex(self.succeed("shear", "points.h5", *words, "--force"), r"\nload +G' = 0 in xy: the bonded network does not")

    def test_network_that_does_not_reach_around_the_box(self):
        # A slab: touching layers, periodic along x and y, that leave a gap along z.
        slab = [(0.5 + x, 0.5 + y, 0.5 + z) for x in range(5) for y in range(5) for z in range(3)]
        self.imported(slab, edge=5)
        found = self.succeed_json("shear", "points.h5")
        self.assertEqual(found["load_structure"]["percolates"], [1, 1, 0])
        self.assertGreater(found["storage_modulus"]["xy"], 0)
        self.assertEqual([found["load_structure"][plane]["carried"] for plane in PLANES], [1, 0, 0])
        self.assertEqual(found["load_structure"]["mean"]["backbone_bond_fraction"],
                         found["load_structure"]["xy"]["backbone"]["bond_fraction"])
        sentence = "G' = 0 in xz, yz: the bonded network does not reach around the box along z"
        self.assertEqual(found["load_structure"]["summary"], sentence)
        self.assertIn(sentence, self.succeed("shear", "points.h5"))

    def test_info_leaves_long_arrays_to_the_file(self):
        self.copy_of_packing()
        contacts = self.succeed_json("shear", "packing.h5")["contacts"]
        forces = self.succeed_json("info", "packing.h5")["results"]["/mechanics/linear/load_structure/xy/bonds/normal_force"]
        self.assertEqual((forces["value"], forces["shape"], forces["unit"]), (None, [contacts], "N"))


if __name__ == "__main__":
    unittest.main()
