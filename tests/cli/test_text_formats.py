# SPDX-License-Identifier: GPL-3.0-or-later
"""Import and export: a packing that goes out and comes back gives the same results; a sample with a free surface is handled."""

import random
import unittest

from support import ProgramTest

R0 = 0.25e-6


class RoundTrip(ProgramTest):
    def test_every_format(self):
        self.copy_of_packing()
        box = self.succeed_json("info", "packing.h5")["box"]
        before = self.succeed_json("characterize", "packing.h5", "-o", "a.h5")
        cases = {
            "csv": ["--box", ",".join(map(repr, box))],
            "extxyz": [],
            "lammps": ["--length-unit", "1m"],
        }
        for name, options in cases.items():
            with self.subTest(format=name):
                exported = self.succeed_json("export", "packing.h5", "--format", name)["output"]
                self.succeed("import", exported, "-o", f"{name}.h5", *options)
                after = self.succeed_json("characterize", f"{name}.h5")
                self.assertEqual(after["particles"], 500)
                self.assertEqual(after["coordination"], before["coordination"])
                self.assertAlmostEqual(after["doh"]["a"], before["doh"]["a"], delta=1e-6)
                self.assertAlmostEqual(after["volume_fraction"], before["volume_fraction"], delta=1e-9)

    def test_units_of_the_columns(self):
        self.write("um.csv", "x [um],y [um],z [um],radius [nm]\n1,1,1,500\n2,1,1,500\n1,2,1,500\n")
        self.write("none.csv", "x,y,z\n1,1,1\n2,1,1\n1,2,1\n")
        self.succeed("import", "um.csv", "--box", "10um,12um,14um", "-o", "um.h5")
        self.succeed("import", "none.csv", "--length-unit", "1um", "--radius", "500nm", "--box", "10um,12um,14um", "-o", "none.h5")
        one, other = self.succeed_json("info", "um.h5"), self.succeed_json("info", "none.h5")
        for key in ("particles", "box", "radius", "volume_fraction"):
            self.assertEqual(one[key], other[key])
        self.assertEqual([round(length * 1e9) for length in one["box"]], [10000, 12000, 14000])


class Plausible(ProgramTest):
    """What a wrong pixel size or radius makes of a packing is printed with a warning."""

    def imported(self, unit, radius="0.25um", edge=1.0):
        cells = range(4)
        centres = [(a + x, b + y, c + z) for a in cells for b in cells for c in cells for x, y, z in ((0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5))]
        self.write("fcc.csv", "x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, y, z in centres))
        length = 4 * edge * float(unit[:-2])
        return self.succeed_json("import", "fcc.csv", "--length-unit", unit, "--radius", radius, "--box", f"{length}um", "-o", "a.h5", "--force")

    def test_a_packing_is_no_surprise(self):
        touching = 0.5 * 2**0.5  # um, the edge of the cell
        found = self.imported(f"{touching}um")
        self.assertEqual((found["contacts"], found["coordination"], found["warnings"]), (256 * 6, 12, []))
        self.assertAlmostEqual(found["nearest_distance"]["smallest"], 1, delta=1e-9)
        self.assertAlmostEqual(found["nearest_distance"]["median"], 1, delta=1e-9)
        self.assertAlmostEqual(found["volume_fraction"], 0.7404805, delta=1e-6)

    def test_wrong_units(self):
        touching = 0.5 * 2**0.5
        for factor, says in ((8.7, "do not touch"), (1.2, "do not touch"), (0.95, "densest packing"), (0.91, "densest packing")):
            found = self.imported(f"{factor * touching}um")
            self.assertAlmostEqual(found["nearest_distance"]["median"], factor, delta=1e-9)
            self.assertTrue(any(says in warning for warning in found["warnings"]), found["warnings"])
        self.assertIn("warning ", self.succeed("import", "fcc.csv", "--length-unit", "1um", "--radius", "0.1um", "--box", "4um", "-o", "b.h5"))

    def test_twice_the_same_and_flat(self):
        self.write("a.csv", "x [um],y [um],z [um]\n1,1,1\n2,1,1\n3,1,1\n4,1,1\n5,1,1\n6,1,1\n1.1,1,1\n")
        words = ["import", "a.csv", "--radius", "0.5um", "-o", "a.h5", "--force"]
        self.assertIn("0.1 diameters apart", "".join(self.succeed_json(*words, "--open")["warnings"]))
        self.assertIn("two-dimensional", "".join(self.succeed_json(*words, "--box", "8um,8um,1um", "--wrap")["warnings"]))

    def test_a_single_sphere(self):
        self.write("a.csv", "x [um],y [um],z [um]\n1,1,1\n")
        found = self.succeed_json("import", "a.csv", "--radius", "0.5um", "--open", "-o", "a.h5")
        self.assertEqual((found["contacts"], found["nearest_distance"], found["warnings"]), (0, {"smallest": None, "median": None}, []))


class FreeSurface(ProgramTest):
    def test_face_centred_cubic_block(self):
        # 7 x 7 x 7 cubic cells, touching spheres: 12 contacts inside, solid fraction pi / (3 sqrt 2).
        edge = 2 * 2**0.5
        lines = ["x,y,z"]
        noise = random.Random(1)
        for i in range(14):
            for j in range(14):
                for k in range(14):
                    if (i + j + k) % 2 == 0:
                        shifted = (0.5 * edge * n + noise.uniform(-1e-9, 1e-9) for n in (i, j, k))
                        lines.append(",".join(map(repr, shifted)))
        self.write("fcc.csv", "\n".join(lines) + "\n")
        self.succeed("import", "fcc.csv", "--length-unit", "1mm", "--radius", "1mm", "--open", "-o", "fcc.h5")
        found = self.succeed_json("characterize", "fcc.h5", "--contact-tolerance", "1e-3")
        self.assertAlmostEqual(found["coordination"], 12, delta=1e-9)
        self.assertAlmostEqual(found["volume_fraction"], 0.7404805, delta=1e-5)
        sheared = self.succeed_json("shear", "fcc.h5")
        self.assertGreater(sheared["storage_modulus"]["mean"], 0)
        self.assertEqual(sheared["boundary"], "held surface")


if __name__ == "__main__":
    unittest.main()
