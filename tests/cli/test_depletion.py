# SPDX-License-Identifier: GPL-3.0-or-later
"""Gels of depletion attraction: the options of the attraction, its potential by LAMMPS, and what later stages take from the gel."""

import os
import subprocess
import unittest

import h5py

from support import PACKING, ProgramTest

RADIUS, THERMAL = 0.5e-6, 1.380649e-23 * 293
LAW = ["generate", "brownian", "--law", "depletion", "--radius", "0.5um"]
ATTRACTION = [*LAW, "--depth", "10kT", "--size-ratio", "0.1"]
RUN = [*ATTRACTION, "--particles", "300", "--volume-fraction", "0.2", "--equilibration-time", "5ms", "--stop-time", "20ms"]
LAMMPS = """units lj
region box block 0 20 0 20 0 20
create_box 1 box
create_atoms 1 single 1 1 1
create_atoms 1 single 3 1 1
mass 1 1
pair_style morse 3.5
pair_coeff 1 1 {depth} {decay} {rest}
pair_write 1 1 {points} r {first} {last} table.txt MORSE
"""


class Potential(ProgramTest):
    def curve(self, *words):
        return self.succeed_json(*LAW, *words, "--potential-curve")

    def test_energy_and_force_are_those_of_lammps(self):
        """pair_style morse of LAMMPS, in radii and kB T, down to where the elastic contact takes over."""
        found = self.curve("--depth", "10kT", "--size-ratio", "0.1")
        gaps = [gap / RADIUS for gap in found["curve"]["gap"]]
        self.write("in.lmp", LAMMPS.format(depth=10, decay=6 / 0.2, rest=2 + found["contact"]["gap"] / RADIUS, points=len(gaps),
                                           first=2 + gaps[0], last=2 + gaps[-1]))
        subprocess.run(["lmp", "-in", "in.lmp", "-log", "none", "-screen", "none"], cwd=self.folder, check=True,
                       env={**os.environ, "OMP_NUM_THREADS": "1"})
        rows = [line.split() for line in (self.folder / "table.txt").read_text().splitlines()]
        rows = [[float(word) for word in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()]
        self.assertEqual(len(rows), len(gaps))
        compared = 0
        for gap, energy, force, (distance, theirs, their_force) in zip(gaps, found["curve"]["energy_kT"], found["curve"]["force"], rows):
            self.assertAlmostEqual(2 + gap, distance, places=6)
            if gap * RADIUS > found["cut_gap"]:
                compared += 1
                self.assertAlmostEqual(energy, theirs, delta=2e-4)  # LAMMPS writes distances to seven digits
                self.assertAlmostEqual(force * RADIUS / THERMAL, their_force, delta=2e-2)
        self.assertGreater(compared, 180)

    def test_the_depth_of_a_polymer_and_the_bonds_it_makes(self):
        by_polymer = self.curve("--polymer-concentration", "0.81", "--attraction-range", "100nm")
        self.assertAlmostEqual(by_polymer["contact"]["energy_kT"], -0.81 * (1 + 1.5 / 0.1), places=9)
        by_depth = self.curve("--depth", "10", "--size-ratio", "0.1")
        curvature = 2 * 10 * THERMAL / (0.2 * RADIUS / 6) ** 2
        self.assertAlmostEqual(by_depth["bond_stiffness"] / curvature, 1, places=5)
        self.assertAlmostEqual(by_depth["rupture_force"] / (0.5 * 10 * THERMAL / (0.2 * RADIUS / 6)), 1, places=4)
        self.assertLess(by_depth["thermal_bond_stiffness"], by_depth["bond_stiffness"])
        self.assertAlmostEqual(by_depth["bond_tolerance"], 0.102)
        self.assertLess(min(by_depth["curve"]["gap"]), by_depth["cut_gap"])
        charged = self.curve("--depth", "10", "--size-ratio", "0.1", "--yukawa-energy", "2e-20J", "--yukawa-length", "20nm")
        self.assertGreater(charged["contact"]["gap"], by_depth["contact"]["gap"])
        self.assertGreater(charged["contact"]["energy_kT"], by_depth["contact"]["energy_kT"])

    def test_picture(self):
        self.succeed(*ATTRACTION, "--potential-curve", "--picture", "well.svg")
        self.assertIn("<svg", (self.folder / "well.svg").read_text())


class Gel(ProgramTest):
    def test_later_stages_take_the_bonds_of_the_gel(self):
        made = self.succeed_json(*RUN, "-o", "gel.h5")
        with h5py.File(self.folder / "gel.h5") as file:
            potential = file["generation/brownian/potential"]
            self.assertEqual({name: potential[name].attrs["unit"] for name in ("bond_stiffness", "thermal_bond_stiffness")},
                             {"bond_stiffness": b"N/m", "thermal_bond_stiffness": b"N/m"})
            stiffness, thermal, tolerance = (potential[name][()] for name in
                                             ("bond_stiffness", "thermal_bond_stiffness", "bond_tolerance"))
        self.assertEqual(made["contact_tolerance"], tolerance)
        found = self.succeed_json("characterize", "gel.h5", "--only", "coordination")
        self.assertEqual(found["contact_tolerance"], tolerance)
        self.assertEqual(found["coordination"], made["coordination"])
        self.assertEqual(self.succeed_json("characterize", "gel.h5", "--only", "coordination", "--contact-tolerance", "0.01")
                         ["contact_tolerance"], 0.01)
        sheared = self.succeed_json("shear", "gel.h5", "--stiffness-from", "potential")
        self.assertEqual(sheared["contacts"], found["contacts"])
        self.assertAlmostEqual(sheared["contact_stiffness"]["normal"] / stiffness, 1)
        self.assertEqual(sheared["contact_stiffness"]["shear"], 0)
        self.assertAlmostEqual(sheared["conditions"]["normal_stiffness"] / (2 * stiffness), 1)
        self.assertEqual(sheared["conditions"]["bond_tolerance"], tolerance)
        self.fail_with(3, "shear", "gel.h5", "--stiffness-from", "thermal", says="--force")
        softer = self.succeed_json("shear", "gel.h5", "--stiffness-from", "thermal", "--force")
        self.assertAlmostEqual(softer["affine_modulus"] / sheared["affine_modulus"], thermal / stiffness)
        sliding = self.succeed_json("shear", "gel.h5", "--stiffness-from", "potential", "--shear-stiffness", "58uN/m", "--force")
        self.assertAlmostEqual(sliding["contact_stiffness"]["shear"], 29e-6)
        usual = self.succeed_json("shear", "gel.h5", "--bond-tolerance", "0.05", "--force")
        self.assertEqual(usual["contact_stiffness"]["normal"], 50)

    def test_a_set_of_gels(self):
        self.write("set.toml", '[[generate]]\nverb = "brownian"\nlaw = "depletion"\nparticles = 150\nvolume-fraction = 0.2\nradius = "0.5um"\n'
                               'depth = ["5kT", "10kT"]\nsize-ratio = 0.1\nequilibration-time = "1ms"\nstop-time = "2ms"\n'
                               '[characterize]\nonly = "coordination"\n[shear]\nstiffness-from = "potential"\n')
        self.succeed("dataset", "run", "set.toml", "-o", "set.h5")
        with h5py.File(self.folder / "set.h5") as file:
            self.assertEqual(list(file["index/status"].asstr()), ["done", "done"])
            self.assertTrue(all(abs(value - 0.102) < 1e-9 for value in file["index/contact_tolerance"]))
            weak, strong = sorted(file["index/contact_stiffness.normal"])
            self.assertAlmostEqual(strong / weak, 2, places=5)

    def test_the_suspension_before_is_one_of_hard_spheres(self):
        made = self.succeed_json(*RUN[:-1], "1us", "--seed", "2", "-o", "start.h5")
        with h5py.File(self.folder / "start.h5") as file:
            closest = file["generation/brownian/series/mean_gap"][0]
        self.assertLess(made["coordination"], 1.5)
        self.assertGreater(closest, 0.02 * RADIUS)


class Refusals(ProgramTest):
    def test_sentences(self):
        for words, says in (([*LAW, "--size-ratio", "0.1"], "needs --depth or --polymer-concentration"),
                            ([*LAW, "--depth", "10kT"], "needs --attraction-range or --size-ratio"),
                            ([*ATTRACTION, "--polymer-concentration", "1"], "but not both"),
                            ([*LAW, "--depth", "1e-20J", "--size-ratio", "0.1"], "has another dimension than the expected unit kT"),
                            ([*ATTRACTION, "--surface-potential", "0"], "--surface-potential is not read with --law depletion"),
                            ([*ATTRACTION, "--contact-shear-stiffness", "1N/m"], "--contact-shear-stiffness is not read with --law depletion"),
                            ([*ATTRACTION, "--equilibration-potential", "9mV"], "--equilibration-potential is not read"),
                            ([*ATTRACTION, "--contact-stiffness", "1uN/m"], "softer than the attraction's well"),
                            ([*LAW, "--depth", "5", "--attraction-range", "0.4um"], "0.8 radii of the particles"),
                            (["generate", "brownian", "--radius", "1um", "--surface-potential", "0", "--depth", "5kT"],
                             "--depth is read only with --law depletion")):
            self.fail_with(2, *words, "--particles", "100", "--volume-fraction", "0.2", "--stop-time", "1us", "-o", "x.h5", says=says)

    def test_a_file_without_such_bonds(self):
        self.copy_of_packing()
        self.fail_with(2, "shear", "packing.h5", "--stiffness-from", "potential", says=["packing.h5", "--stiffness-from potential"])
        self.fail_with(2, "shear", PACKING, "--stiffness-from", "potential", "--normal-stiffness", "1N/m", "-o", "x.h5",
                       says="--normal-stiffness is not read")


if __name__ == "__main__":
    unittest.main()
