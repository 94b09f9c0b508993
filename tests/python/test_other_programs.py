# SPDX-License-Identifier: GPL-3.0-or-later
"""Packings go to other programs of Python and come back."""

import unittest
import warnings

import numpy as np

import coagula
from support import ModuleTest

# As OVITO writes it: lattice vectors, the origin of the cell, properties in an order of its own.
OVITO = '''4
Lattice="4.0 0.0 0.0 0.0 5.0 0.0 0.0 0.0 6.0" Origin="0 0 0" Properties=id:I:1:species:S:1:pos:R:3:radius:R:1:Coordination:I:1 pbc="T T T"
1 A 1.0 1.0 1.0 0.5 1
2 A 2.0 1.0 1.0 0.5 2
3 B 2.75 1.0 1.0 0.25 1
4 A 2.0 3.0 5.75 0.5 0
'''


class MDAnalysis(ModuleTest):
    def test_there_and_back(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import MDAnalysis
            from MDAnalysis.lib.distances import capped_distance

        made = self.made()
        packing = made.packing
        # There: an MDAnalysis universe in units of the diameter, with its periodic box.
        diameter = 2 * packing.mean_radius
        universe = MDAnalysis.Universe.empty(len(packing), trajectory=True)
        universe.atoms.positions = packing.positions / diameter
        universe.dimensions = [*(packing.box / diameter), 90, 90, 90]
        pairs = capped_distance(universe.atoms.positions, universe.atoms.positions, 1.01, box=universe.dimensions, return_distances=False)
        self.assertEqual(np.count_nonzero(pairs[:, 0] < pairs[:, 1]), len(coagula.find_contacts(made, 0.01)))
        # And back: single precision is all that MDAnalysis keeps.
        back = coagula.Packing(diameter * universe.atoms.positions.astype(float), packing.radii, box=packing.box, wrap=True)
        np.testing.assert_allclose(back.positions, packing.positions, rtol=0, atol=1e-6 * diameter)
        one, other = coagula.characterize(made, only="doh"), coagula.characterize(back, only="doh")
        self.assertAlmostEqual(one.doh.a, other.doh.a, delta=1e-5)

    def test_opens_the_file(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import MDAnalysis

            made = self.made(particles=100, voids=50)
            coagula.write("a.h5", made)
            universe = MDAnalysis.Universe.empty(100)
            universe.load_new("a.h5", format="H5MD")
            np.testing.assert_allclose(universe.atoms.positions * 1e-10, made.packing.positions, rtol=1e-5)
            universe.trajectory.close()


class ExtendedXyz(ModuleTest):
    def test_of_ovito(self):
        (self.folder / "ovito.xyz").write_text(OVITO)
        packing = coagula.read("ovito.xyz", length_unit="1um").packing
        np.testing.assert_allclose(packing.box, [4e-6, 5e-6, 6e-6])
        np.testing.assert_allclose(packing.radii, [5e-7, 5e-7, 2.5e-7, 5e-7])
        np.testing.assert_allclose(packing.positions[3], [2e-6, 3e-6, 5.75e-6])
        np.testing.assert_array_equal(coagula.find_contacts(packing).counts, [1, 2, 1, 0])
        coagula.write("again.extxyz", packing)
        np.testing.assert_allclose(coagula.read("again.extxyz").packing.positions, packing.positions, rtol=1e-15)

    def test_columns_and_frames_of_a_table(self):
        (self.folder / "track.csv").write_text("t,px,py,pz,d\n" + "".join(
            f"{frame},{10 + frame},{20 * k + 10},10,8\n" for frame in (0, 1) for k in range(3)))
        track = coagula.read("track.csv", columns={"x": "px", "y": "py", "z": "pz", "diameter": "d", "frame": "t"}, frame=1, open=True,
                             length_unit=["0.1um", "0.1um", "0.2um", "0.1um"])
        np.testing.assert_allclose(track.packing.positions, [[1.1e-6, (2 * k + 1) * 1e-6, 2e-6] for k in range(3)])
        np.testing.assert_allclose(track.packing.radii, 4e-7)

    def test_other_formats(self):
        made = self.made(particles=100, voids=50)
        for name in ("a.dump", "a.gsd", "a.data"):
            coagula.write(name, made)
            again = coagula.read(name, length_unit=None if name == "a.gsd" else "1m")
            np.testing.assert_allclose(again.packing.positions, made.packing.positions, rtol=0, atol=1e-6 * made.packing.mean_radius, err_msg=name)
        coagula.write("a.vtp", made)


if __name__ == "__main__":
    unittest.main()
