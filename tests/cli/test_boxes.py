# SPDX-License-Identifier: GPL-3.0-or-later
"""Tilted boxes: files of other programs, and a shear by LAMMPS."""

import math
import os
import subprocess
import unittest
from pathlib import Path

import h5py
import numpy

from support import ProgramTest

SUSPENSION = ["generate", "brownian", "--particles", "60", "--volume-fraction", "0.2", "--radius", "0.25um", "--equilibration-time", "1us",
              "--surface-potential", "0", "--stop-time", "20us"]


class Files(ProgramTest):
    def test_tilted_boxes_that_other_programs_wrote(self):
        data = Path(os.environ["COAGULA_DATASETS"]) / "foreign_structures"
        tilted = {}
        for name, particles, volume in (("o_tri.data", 200, 1440), ("o_tri.dump", 200, 1440), ("g_tri.gsd", 120, 720), ("x_tri.xyz", 120, 720)):
            found = self.succeed_json("import", data / name, "--length-unit", "1um", "--wrap", "-o", name + ".h5")
            self.assertEqual((found["particles"], found["periodic"]), (particles, True), name)
            self.assertAlmostEqual(found["radius_mean"] / 0.5e-6, 1, delta=1e-12)
            self.assertAlmostEqual(numpy.linalg.det(numpy.array(found["edges"]) * 1e6), volume, delta=1e-3)
            self.assertAlmostEqual(found["volume_fraction"], particles * math.pi / 6 / volume, delta=1e-6)
            tilted[name] = self.succeed_json("characterize", name + ".h5", *([] if name == "o_tri.data" else ["--only", "pores"]))
            sheared = self.succeed_json("shear", name + ".h5", "--bond-tolerance", "0.3")
            self.assertEqual(sheared["storage_modulus"]["mean"], 0)  # its few bonds reach around no edge of the box
        self.assertAlmostEqual(tilted["o_tri.dump"]["pore_size"]["mean"] / tilted["o_tri.data"]["pore_size"]["mean"], 1, delta=1e-9)

    def test_the_box_that_a_csv_file_lacks(self):
        self.write("tilted.xyz", '2\nLattice="6 0 0 1 5 0 0.5 -1 4" pbc="T T F" Properties=species:S:1:pos:R:3:radius:R:1\nA 1 1 1 0.5\nA 3 2 2 0.5\n')
        self.succeed("import", "tilted.xyz", "--length-unit", "1um", "-o", "a.h5")
        (note,) = self.succeed_json("export", "a.h5", "-o", "a.csv")["notes"]
        words = note[note.index("--box"):].split()
        self.succeed("import", "a.csv", *words, "-o", "b.h5")
        with h5py.File(self.folder / "a.h5") as one, h5py.File(self.folder / "b.h5") as other:
            edges = "particles/trajectory/box/edges/value"
            numpy.testing.assert_allclose(one[edges][:], other[edges][:], rtol=1e-12)
            self.assertEqual(list(one["particles/trajectory/box"].attrs["boundary"]), list(other["particles/trajectory/box"].attrs["boundary"]))


class LeesEdwards(ProgramTest):
    """A suspension that LAMMPS shears: its snapshots are those of the sheared box, flipped back or not."""

    SCRIPT = """units si
atom_style hybrid sphere bond
boundary p p p
box tilt large
read_data s.lmp
change_box all triclinic
pair_style zero 1e-6
pair_coeff * *
neighbor 1e-7 bin
timestep 1
fix 1 all deform 1 xz erate 0.01 remap x flip {flip}
thermo 70
run 70
write_dump all custom {flip}.dump id type x y z radius modify format float %20.16g
"""

    def test_snapshots_of_a_shear(self):
        self.succeed(*SUSPENSION, "-o", "run.h5")
        self.succeed("export", "run.h5", "--format", "lammps", "-o", "s.lmp")
        found = {}
        moduli = []
        for flip, strain in (("yes", -0.3), ("no", 0.7)):
            self.write("in.lmp", self.SCRIPT.format(flip=flip))
            subprocess.run(["lmp", "-in", "in.lmp", "-log", "none", "-screen", "none"], cwd=self.folder, check=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
            imported = self.succeed_json("import", flip + ".dump", "--length-unit", "1m", "--wrap", "-o", flip + ".h5")
            edges = numpy.array(imported["edges"])
            self.assertAlmostEqual(edges[2, 0] / edges[2, 2], strain, delta=1e-9)
            self.assertAlmostEqual(imported["volume_fraction"], 0.2, delta=1e-9)
            found[flip] = self.succeed_json("characterize", flip + ".h5", "--only", "pores")
            moduli.append(self.succeed_json("shear", flip + ".h5", "--bond-tolerance", "1")["storage_modulus"]["mean"])
        straight = self.succeed_json("characterize", "run.h5", "--only", "pores")
        self.assertNotAlmostEqual(found["yes"]["pore_size"]["mean"] / straight["pore_size"]["mean"], 1, delta=1e-4)
        self.assertAlmostEqual(found["yes"]["pore_size"]["mean"] / found["no"]["pore_size"]["mean"], 1, delta=1e-9)
        self.assertGreater(moduli[0], 0)
        self.assertAlmostEqual(moduli[1] / moduli[0], 1, delta=1e-6)


class Planes(ProgramTest):
    def layer(self, name, normal, box="15um", heights=(0.0,)):
        """Square layers of 225 spheres of 1 um across, turned so that `normal` is across them."""
        across = numpy.array(normal) / numpy.linalg.norm(normal)
        first = numpy.cross(across, [1, 0, 0] if abs(across[0]) < 0.9 else [0, 1, 0])
        first /= numpy.linalg.norm(first)
        second = numpy.cross(across, first)
        places = [i * first + j * second + height * across for height in heights for i in range(15) for j in range(15)]
        self.write(name, "x [um],y [um],z [um]\n" + "".join(f"{x:.9f},{y:.9f},{z:.9f}\n" for x, y, z in places))
        return ["import", name, "--radius", "0.5um", *(["--box", box, "--wrap"] if box else ["--open"]), "-o", f"{name}.h5", "--force"]

    def test_two_dimensions_are_refused(self):
        for normal in ((0, 0, 1), (1, 0, 0)):
            for box in ("15um", ""):
                self.fail_with(2, *self.layer("flat.csv", normal, box), says=["flat.csv", "225 centres lie in a plane", "two dimensions"])
        self.fail_with(2, *self.layer("flat.csv", (1, 2, 3), ""), says="lie in a plane")

    def test_crystals_one_layer_thick_are_none(self):
        self.succeed(*self.layer("thick.csv", (0, 0, 1), heights=(0.0, 1.0)))
        found = self.succeed_json(*self.layer("crystal.csv", (0, 0, 1), "15um,15um,1um"))
        self.assertEqual(found["coordination"], 6)


if __name__ == "__main__":
    unittest.main()
