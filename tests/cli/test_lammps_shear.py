# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear by LAMMPS: what it refuses, how failures are told, and that its moduli are those of the linear method."""

import itertools
import math
import os
import random
import unittest

import h5py

from support import ProgramTest, checksum
from test_lammps_engine import needs_lammps

DEM = ["shear", "packing.h5", "--method", "dem"]
BY_LAMMPS = [*DEM, "--engine", "lammps"]
PLANES = ("xy", "xz", "yz")
RADIUS = 0.25e-6


class Refusals(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()
        self.program("exit 0")

    def program(self, commands):
        self.write("lmp", f"#!/bin/sh\n{commands}\n").chmod(0o755)

    def environment(self):
        return {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}

    def refuse(self, *words, says):
        self.fail_with(2, *BY_LAMMPS, *words, says=says, env=self.environment())

    def test_options_of_the_oscillation(self):
        for words in (["--amplitude", "1e-4"], ["--constant-amplitude"], ["--oscillations", "2"], ["--steps-per-oscillation", "1000"],
                      ["--damping", "0.5"], ["--density", "2000"], ["--checkpoint", "a.state"], ["--frequency", "1Hz"]):
            self.refuse(*words, says=f"{words[0]} is not read with --engine lammps")
        self.refuse("--boundary", "plates", says=["--boundary plates is not read with --engine lammps", "the periodic cell"])
        self.refuse("--rest-length", "radii", says="--rest-length radii is not read with --engine lammps")

    def test_contacts_that_it_has_nothing_for(self):
        for parameters in ("normal_viscosity = 1", "shear_viscosity = 1", "normal_maxwell_stiffness = 1\nnormal_maxwell_time = 1",
                           "solvent_viscosity = 1", "young_modulus = 1e9\npoisson_ratio = 0.2", "normal_strength = 1", "friction = 0.3",
                           "prestress = 1e-9", "ageing_rate = 0.1\nageing_time = 1"):
            self.write("model.toml", parameters + "\n")
            self.refuse("--model", "model.toml", says=[f"model.toml has {parameters.split()[0]}", "--engine lammps", "linear springs alone"])

    def test_other_methods(self):
        for method in ("linear", "quasistatic"):
            self.fail_with(2, "shear", "packing.h5", "--method", method, "--engine", "lammps",
                           says="--engine lammps computes by --method dem only", env=self.environment())
        self.fail_with(2, *DEM, "--engine-command", "lmp", says="--engine-command is read only with --engine petsc or lammps")

    def test_cells_that_it_cannot_hold(self):
        self.write("points.csv", "x,y,z\n0,0,0\n1.99,0,0\n")
        self.succeed("import", "points.csv", "--radius", "1um", "--length-unit", "1um", "--open", "--force", "-o", "packing.h5")
        self.refuse(says="periodic cell only")
        self.succeed("import", "points.csv", "--radius", "1um", "--length-unit", "1um", "--box", "3.98um", "--force", "-o", "packing.h5")
        self.refuse(says="so small that particles meet images of each other")

    def test_a_program_that_is_missing_or_fails(self):
        self.fail_with(2, *BY_LAMMPS, "--engine-command", "no-such-lmp", says=["there is no program no-such-lmp", "apt-get install lammps"])
        before = checksum(self.folder / "packing.h5")
        self.fail_with(1, *BY_LAMMPS, "--engine-command", "./lmp", says="LAMMPS failed: it ended and said nothing")
        self.program('read line; echo "ERROR: Lost atoms" > "$2"; exit 1')
        self.fail_with(1, *BY_LAMMPS, "--engine-command", "./lmp", says="LAMMPS failed: ERROR: Lost atoms")
        self.assertEqual(checksum(self.folder / "packing.h5"), before)


class Comparison(ProgramTest):
    def compare(self, *words, within):
        """Of packing.h5, with the linear method. @return what LAMMPS found."""
        linear = self.succeed_json("shear", "packing.h5", *words, "-o", "linear.h5", "--force")
        found = self.succeed_json(*BY_LAMMPS, *words, "-o", "lammps.h5", "--force")
        for plane in PLANES:
            expected, got = linear["storage_modulus"][plane], found["storage_modulus"][plane]
            self.assertGreater(expected, 0)
            self.assertAlmostEqual(got / expected, 1, delta=within, msg=f"{plane} {words}")
            self.assertEqual(found["storage_modulus"][plane[::-1]], got)
        for key in ("contacts", "rattlers", "floppy_modes", "contact_stiffness"):
            self.assertEqual(found[key], linear[key])
        self.assertAlmostEqual(found["affine_modulus"] / linear["affine_modulus"], 1, delta=1e-9)
        mean = sum(found["storage_modulus"][plane] for plane in PLANES) / 3
        self.assertAlmostEqual(found["storage_modulus"]["mean"] / mean, 1, delta=1e-12)
        return found

    def crystal(self, cells=4, vacancies=0.1, spread=0.0, lattice=None):
        """packing.h5: a face-centred crystal with vacancies, its radii within a part of the mean, in a cell of these edges."""
        chance = random.Random(1)
        lattice = lattice or [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
        edge = cells * 2 * math.sqrt(2) * RADIUS
        rows = []
        for cell in itertools.product(range(cells), repeat=3):
            for corner in ((0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0)):
                if chance.random() < vacancies:
                    continue
                part = [(c + o + 0.1) / cells for c, o in zip(cell, corner)]
                place = [edge * sum(part[k] * lattice[k][axis] for k in range(3)) for axis in range(3)]
                rows.append(" ".join(repr(value) for value in (*place, RADIUS * (1 + spread * (2 * chance.random() - 1)))))
        vectors = " ".join(repr(edge * value) for vector in lattice for value in vector)
        self.write("crystal.xyz", f'{len(rows)}\nLattice="{vectors}" Properties=pos:R:3:radius:R:1 pbc="T T T" length_unit=m\n'
                   + "\n".join(rows) + "\n")
        self.succeed("import", "crystal.xyz", "-o", "packing.h5", "--quiet")


@needs_lammps
class Moduli(Comparison):
    def test_of_a_crystal_and_what_the_file_holds(self):
        self.crystal()
        found = self.compare(within=1e-5)
        self.assertEqual((found["method"], found["boundary"]), ("dem", "periodic"))
        self.assertNotIn("loss_modulus", found)
        self.assertRegex(found["engine"]["name"], r"^LAMMPS \d+ \w+ \d{4}")
        self.assertLess(max(found["settling"]["change"]), 5e-4)
        for number, orientation in enumerate(found["orientations"].split(",")):
            self.assertAlmostEqual(found["settling"]["stress_modulus"][number] / found["storage_modulus"][orientation], 1, delta=1e-3)
        self.assertIn(found["engine"]["name"], self.succeed("info", "lammps.h5"))
        with h5py.File(self.folder / "lammps.h5") as file:
            group = file["mechanics/dem"]
            self.assertEqual(group["storage_modulus/mean"][()], found["storage_modulus"]["mean"])
            self.assertEqual(group["conditions/engine"][()].decode().rstrip("\0"), "lammps")

    def test_in_a_cell_that_leans_and_is_turned(self):
        self.crystal(lattice=[[0.05, 1.0, 0.02], [0.0, 0.04, 1.0], [1.0, 0.0, 1.0]])
        self.compare("--bond-tolerance", "0.1", within=1e-5)

    def test_of_unequal_spheres(self):
        self.crystal(spread=0.2)
        self.compare("--bond-tolerance", "0.25", within=1e-5)

    def test_of_bonds_that_resist_moments(self):
        self.crystal(vacancies=0.6)
        self.write("model.toml", "bending_stiffness = 3e-13\ntwisting_stiffness = 1e-12\n")
        self.compare("--model", "model.toml", within=1e-5)
        self.write("model.toml", "bending_stiffness = 1e-12\n")
        self.compare("--model", "model.toml", within=1e-5)

    def test_of_springs_without_and_with_much_resistance_to_sliding(self):
        self.crystal()
        for stiffness in ("0", "100N/m", "150N/m"):
            self.compare("--shear-stiffness", stiffness, within=1e-5)

    def test_of_what_carries_no_load(self):
        self.write("points.csv", "x,y,z\n1,1,1\n2.99,1,1\n5,5,5\n")
        self.succeed("import", "points.csv", "--radius", "1um", "--length-unit", "1um", "--box", "10um", "--force", "-o", "packing.h5")
        found = self.succeed_json(*BY_LAMMPS, "--orientation", "xy,zx")
        self.assertEqual(found["storage_modulus"], {"mean": 0, "std": 0, "xy": 0, "zx": 0})
        self.assertIn("no_modulus", found)
        self.fail_with(3, *DEM, "--orientation", "xy", says=["other conditions", "engine: lammps there", "--force"])


@needs_lammps
class Gels(Comparison):
    def test_are_as_stiff_as_by_the_linear_method(self):
        self.succeed("generate", "vem", "--particles", 300, "--voids", 150, "--volume-fraction", 0.4, "--radius", RADIUS, "-o",
                     "packing.h5", "--quiet")
        for stiffness in ("10N/m", "1N/m"):
            self.compare("--shear-stiffness", stiffness, within=0.01)


if __name__ == "__main__":
    unittest.main()
