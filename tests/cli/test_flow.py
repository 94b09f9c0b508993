# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula generate brownian in a shear flow: stress against LAMMPS, results, restart, refusals."""

import os
import subprocess
import unittest

import h5py
import numpy

from support import ProgramTest

RADIUS, THERMAL = 0.5e-6, 1.380649e-23 * 293
GEL = ["generate", "brownian", "--law", "depletion", "--depth", "10kT", "--size-ratio", "0.1"]
SUSPENSION = [*GEL, "--particles", "200", "--volume-fraction", "0.2", "--radius", "0.5um", "--equilibration-time", "5ms"]
LAMMPS = """units lj
boundary p p p
box tilt large
read_data box.data
pair_style morse 3.5
pair_coeff 1 1 10 30 {rest}
thermo_style custom step pxx pyy pzz pxz
run 0
"""


class Flow(ProgramTest):
    def series(self, path):
        with h5py.File(self.folder / path) as file:
            return {name: value[()] for name, value in file["generation/brownian/series"].items()}

    def stress_by_lammps(self, path, rest):
        """Pressures of LAMMPS for the particles of a file, in Pa: xx, yy, zz and xz."""
        with h5py.File(self.folder / path) as file:
            trajectory = file["particles/trajectory"]
            positions = trajectory["position/value"][-1] * 1e-9 / RADIUS
            edges = trajectory["box/edges/value"][-1] * 1e-9 / RADIUS
        self.assertGreater(abs(edges[2][0]), 0.05 * edges[0][0])
        self.write("box.data", f"sheared\n\n{len(positions)} atoms\n1 atom types\n\n0 {edges[0][0]:.17g} xlo xhi\n0 {edges[1][1]:.17g} ylo yhi\n"
                               f"0 {edges[2][2]:.17g} zlo zhi\n0 {edges[2][0]:.17g} 0 xy xz yz\n\nMasses\n\n1 1\n\nAtoms # atomic\n\n"
                   + "".join(f"{k + 1} 1 {x:.17g} {y:.17g} {z:.17g}\n" for k, (x, y, z) in enumerate(positions)))
        self.write("in.lmp", LAMMPS.format(rest=rest))
        subprocess.run(["lmp", "-in", "in.lmp", "-log", "log.lammps", "-screen", "none"], cwd=self.folder, check=True,
                       env={**os.environ, "OMP_NUM_THREADS": "1"})
        lines = (self.folder / "log.lammps").read_text().splitlines()
        row = next(lines[k + 1] for k, line in enumerate(lines) if line.split()[:2] == ["Step", "Pxx"])
        return numpy.array([float(word) for word in row.split()[1:]]) * THERMAL / RADIUS ** 3

    def test_stress_is_that_of_lammps(self):
        self.succeed(*SUSPENSION, "--shear-rate", "10Hz", "--stop-time", "40ms", "-o", "sheared.h5")
        # By Euler's steps nothing is added to the positions before they are measured: the first sample is that of the file.
        rest = self.succeed_json(*GEL, "--start", "sheared.h5", "--integrator", "euler", "--shear-rate", "0", "--stop-time", "1us", "-o", "rest.h5")
        theirs = self.stress_by_lammps("sheared.h5", 2 + 0.004)
        ours = self.series("rest.h5")
        pressure = rest["flow"]["brownian_pressure"]
        scale = numpy.abs(theirs).max()
        for name, value in (("normal_stress_x", theirs[0]), ("normal_stress_y", theirs[1]), ("normal_stress_z", theirs[2])):
            self.assertAlmostEqual((-ours[name][0] - pressure) / scale, value / scale, delta=2e-3)
        self.assertAlmostEqual(-ours["shear_stress"][0] / scale, theirs[3] / scale, delta=2e-3)
        self.assertGreater(abs(theirs[3]), 0.01 * scale)

    def test_results_of_a_constant_rate(self):
        found = self.succeed_json(*SUSPENSION, "--shear-rate", "20Hz", "--stop-time", "30ms", "-o", "a.h5")
        series = self.series("a.h5")
        self.assertAlmostEqual(series["strain"][-1], 20 * found["time"], delta=1e-9)
        late = series["shear_stress"][-96:]  # eight blocks of twelve in the second half of 201 samples
        self.assertAlmostEqual(found["flow"]["shear_stress"] / late.mean(), 1, delta=1e-9)
        self.assertAlmostEqual(found["flow"]["particle_viscosity"] / (late.mean() / 20), 1, delta=1e-9)
        self.assertEqual(found["flow"]["blocks"], 8)
        self.assertGreater(found["flow"]["particle_viscosity_stderr"], 0)
        number = 200 / (200 * 4 / 3 * numpy.pi * RADIUS ** 3 / 0.2)
        self.assertAlmostEqual(found["flow"]["brownian_pressure"] / (number * THERMAL), 1, delta=1e-6)
        self.assertAlmostEqual(found["flow"]["liquid_viscosity"] / 1.5e-3, 1, delta=1e-9)
        self.assertTrue((series["contact_shear_stress"] == 0).all())
        info = self.succeed_json("info", "a.h5")
        lean = info["edges"][2][0] / info["edges"][0][0]
        self.assertAlmostEqual(lean, 20 * found["time"] - round(20 * found["time"]), delta=1e-6)
        self.succeed("characterize", "a.h5", "--only", "coordination")
        self.assertRegex(self.succeed(*SUSPENSION, "--shear-rate", "20Hz", "--stop-time", "1ms", "-o", "b.h5"), "viscosity of particles +.*Pa s")

    def test_oscillation(self):
        found = self.succeed_json(*SUSPENSION, "--shear-amplitude", "0.05", "--shear-frequency", "200Hz", "--stop-time", "20ms", "-o", "a.h5")
        self.assertEqual(found["flow"]["blocks"], 2)
        self.assertGreater(found["flow"]["loss_modulus"], 0)
        self.assertNotIn("particle_viscosity", found["flow"])
        self.assertLessEqual(max(abs(self.series("a.h5")["strain"])), 0.05)

    def test_a_run_without_flow_says_nothing_of_it(self):
        found = self.succeed_json(*SUSPENSION, "--stop-time", "1ms", "-o", "a.h5")
        self.assertNotIn("flow", found)
        self.assertNotIn("strain", found["series"])

    def test_refused(self):
        run = [*SUSPENSION, "--stop-time", "1ms", "-o", "x.h5"]
        for words, says in ((["--shear-amplitude", "0.1"], "--shear-amplitude needs --shear-frequency"),
                            (["--shear-frequency", "1Hz"], "--shear-frequency is read only with --shear-amplitude"),
                            (["--shear-rate", "1Hz", "--shear-amplitude", "0.1", "--shear-frequency", "1Hz"], "--shear-amplitude is not read with --shear-rate"),
                            (["--shear-rate", "1Hz", "--snapshots", "1ms"], "--snapshots is not read with --shear-rate"),
                            (["--shear-rate", "1Hz", "--gravity", "10", "--density-difference", "1"], "is not read with --shear-rate"),
                            (["--shear-rate", "1e9Hz", "--time-step", "1us"], "the flow strains the box")):
            self.fail_with(2, *run, *words, says=says)


if __name__ == "__main__":
    unittest.main()
