# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays are views of the numbers that C++ holds, shaped as Python expects, and keep their owner alive."""

import gc
import pickle
import unittest

import numpy as np

import coagula
from support import ModuleTest


def address(array):
    return array.__array_interface__["data"][0]


class Views(ModuleTest):
    def assert_view(self, array, again, owner):
        self.assertEqual(address(array), address(again))
        self.assertFalse(array.flags.owndata)
        self.assertFalse(array.flags.writeable)
        self.assertTrue(array.flags.c_contiguous)
        if owner is not None:
            self.assertIs(array.base, owner)

    def test_packing(self):
        packing = self.made().packing
        self.assertEqual(packing.positions.shape, (200, 3))
        self.assert_view(packing.positions, packing.positions, packing)
        self.assert_view(packing.radii, packing.radii, packing)
        with self.assertRaises(ValueError):
            packing.positions[0, 0] = 1
        with self.assertRaises(ValueError):
            packing.positions.flags.writeable = True

    def test_bonds(self):
        made = self.made()
        bonds, packing = made.bonds, made.packing
        self.assertEqual(bonds.ends.shape, (len(bonds), 2))
        self.assert_view(bonds.ends, bonds.ends, bonds)
        self.assert_view(bonds.branch, bonds.branch, bonds)
        # The branch vectors are the differences of the positions, by the shortest way around the box.
        difference = packing.positions[bonds.ends[:, 1]] - packing.positions[bonds.ends[:, 0]]
        difference -= packing.box * np.round(difference / packing.box)
        np.testing.assert_allclose(bonds.branch, difference, rtol=0, atol=1e-20)
        self.assertEqual(bonds.counts.sum(), 2 * len(bonds))

    def test_results(self):
        made = self.made()
        response = coagula.shear(made)
        for path in ("elastic_tensor", "per_particle/nonaffine_displacement_xy", "load_structure/xy/bonds/normal_force"):
            again = {entry[0]: entry[1] for entry in response._stage.entries}[path]
            self.assert_view(response[path], again, response._stage)
        self.assertEqual(response.per_particle.nonaffine_displacement_xy.shape, (200, 3))
        np.testing.assert_allclose(response.elastic_tensor, response.elastic_tensor.T, rtol=1e-9, atol=1)

    def test_views_outlive_their_owners(self):
        made = self.made()
        response = coagula.shear(made)
        positions, tensor = made.packing.positions, response.elastic_tensor
        before = positions.copy(), tensor.copy()
        del made, response
        gc.collect()
        self.made(seed=2)  # takes memory that would be free
        np.testing.assert_array_equal(positions, before[0])
        np.testing.assert_array_equal(tensor, before[1])

    def test_file(self):
        coagula.write("a.h5", self.made(), *[coagula.characterize(self.made())])
        curve = coagula.read("a.h5").characterization.pore_curve.radius
        self.assertFalse(curve.flags.owndata)
        self.assertEqual(len(curve), 200)


class Values(ModuleTest):
    def test_packing_from_arrays(self):
        positions = np.array([[1.0, 1, 1], [2, 1, 1], [1, 2, 1]])
        packing = coagula.Packing(positions, 0.5, box=[4, 5, 6])
        np.testing.assert_array_equal(packing.positions, positions)
        np.testing.assert_array_equal(packing.radii, [0.5, 0.5, 0.5])
        np.testing.assert_array_equal(packing.box, [4, 5, 6])
        self.assertTrue(packing.periodic)
        self.assertEqual(len(coagula.find_contacts(packing)), 2)
        positions[0] = 3  # the packing has its own copy
        self.assertEqual(packing.positions[0, 0], 1)
        wrapped = coagula.Packing([[5.0, 1, 1], [2, 1, 1]], [0.5, 0.4], box=4, wrap=True)
        self.assertEqual(wrapped.positions[0, 0], 1)
        named = coagula.Packing(1e-6 * packing.positions, "0.5um", box=["4um", "5um", 6e-6])
        np.testing.assert_allclose(named.box, 1e-6 * packing.box)
        np.testing.assert_array_equal(named.radii, [5e-7] * 3)
        fortran = coagula.Packing(np.asfortranarray(packing.positions), packing.radii, box=packing.box)
        np.testing.assert_array_equal(fortran.positions, packing.positions)

    def test_boxes_of_any_shape(self):
        edges = np.array([[4.0, 0, 0], [1, 5, 0], [-1, 2, 6]])
        packing = coagula.Packing([[1.0, 1, 1], [4.5, 1, 1]], 0.5, box=edges, periodic=(True, True, False), wrap=True)
        np.testing.assert_array_equal(packing.edges, edges)
        np.testing.assert_allclose(packing.box, np.linalg.norm(edges, axis=1), rtol=1e-15)
        self.assertEqual((packing.periodic, tuple(packing.periodic_edges)), (False, (True, True, False)))
        self.assertAlmostEqual(packing.volume_fraction, 2 * np.pi / 6 / 120, delta=1e-15)
        np.testing.assert_allclose(packing.positions[1], [0.5, 1, 1], atol=1e-15)  # 4.5 is one edge further
        other = pickle.loads(pickle.dumps(packing))
        np.testing.assert_array_equal(other.edges, edges)
        self.assertEqual(other.periodic_edges, packing.periodic_edges)
        with self.assertRaisesRegex(coagula.InputError, "give the box"):
            coagula.Packing([[1.0, 1, 1]], 0.5, periodic=(True, True, False))
        with self.assertRaisesRegex(coagula.InputError, "one plane"):
            coagula.Packing([[1.0, 1, 1]], 0.5, box=[[1, 0, 0], [0, 1, 0], [1, 1, 0]])

    def test_pickle(self):
        packing = self.made().packing
        for one in (packing, coagula.Packing(packing.positions, packing.radii)):
            other = pickle.loads(pickle.dumps(one))
            np.testing.assert_array_equal(one.positions, other.positions)
            np.testing.assert_array_equal(one.radii, other.radii)
            np.testing.assert_array_equal(one.box, other.box)
            np.testing.assert_array_equal(one.origin, other.origin)
            self.assertEqual(one.periodic, other.periodic)

    def test_results_go_to_other_processes(self):
        made = self.made()
        for result in (made, coagula.characterize(made), coagula.shear(made)):
            other = pickle.loads(pickle.dumps(result))
            self.assertEqual(other.flat(), result.flat())
            self.assertEqual(type(other).__name__, type(result).__name__)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(made)).packing.positions, made.packing.positions)
        with self.assertRaises(TypeError):
            coagula.write("a.h5", made, other)

    def test_given_radii(self):
        radii = np.linspace(0.2e-6, 0.3e-6, 100)
        made = coagula.generate_vem(radii=radii, volume_fraction=0.35, seed=4)
        np.testing.assert_array_equal(made.packing.radii, radii)

    def test_results_are_documented(self):
        response = coagula.shear(self.made())
        self.assertEqual(response.unit("storage_modulus/mean"), "Pa")
        self.assertIn("mean of the six orientations", response.description("storage_modulus/mean"))
        self.assertIn("[Pa]", type(response.storage_modulus).mean.__doc__)
        self.assertIn("affine_modulus: ", type(response).__doc__)
        self.assertIn("storage_modulus", dir(response))
        self.assertIn("storage_modulus/mean", repr(response))
        self.assertIn("<td>", response._repr_html_())
        self.assertEqual(response.flat()["storage_modulus/mean"], response.storage_modulus.mean)
        with self.assertRaisesRegex(AttributeError, "there is no 'modulus' here: method, contacts"):
            response.modulus
        with self.assertRaises(KeyError):
            response["storage_modulus/none"]

    def test_quantities(self):
        self.assertEqual(coagula.parse_quantity("0.25um", "m"), 2.5e-7)
        one = self.made(radius=2.5e-7).packing
        np.testing.assert_array_equal(one.positions, self.made(radius="250 nm").packing.positions)
        np.testing.assert_array_equal(one.positions, self.made(radius=np.float64(2.5e-7), seed=np.int64(1)).packing.positions)


if __name__ == "__main__":
    unittest.main()
