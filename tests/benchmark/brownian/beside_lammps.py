#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Brownian dynamics with the same DLVO potential by LAMMPS and by coagula: processor time for the same physical time, on one core.

    tests/benchmark/brownian/beside_lammps.py [--program build/bin/coagula] [--particles 8000]

Debian's LAMMPS has no overdamped integrator: it runs a table (pair_style table) with Langevin noise and a mass so small that motion is
overdamped beside contacts and barrier. Accuracy first: isolated pairs at rest in their contact, whose gap must have its Boltzmann
variance. Each program takes its own step (coagula its automatic one, LAMMPS --step), and both variances are printed. Then both run the same
coagulated structure. Lengths in radii, energies in kB T, times in R^2/D. Needs lmp and python3-h5py.
"""

import argparse
import json
import math
import os
import random
import re
import resource
import subprocess
import tempfile
from pathlib import Path

import h5py

RADIUS, TEMPERATURE, DEBYE_LENGTH, HAMAKER, PERMITTIVITY = 0.25e-6, 293.0, 10e-9, 4.76e-20, 81
THERMAL = 1.380649e-23 * TEMPERATURE
DIFFUSION_TIME = RADIUS**2 * 6 * math.pi * 1e-3 * RADIUS / THERMAL
MASS = 1e-6  # times the mobility: the memory of velocity; the contact relaxes in 1/(2 * 4e5), the barrier in 6e-5
PAIRS = 12**3
SPACING = 7

LAMMPS = """
units lj
atom_style atomic
boundary p p p
newton on
read_data start.data
mass 1 {mass}
pair_style table linear 40000
pair_coeff 1 1 table.txt DLVO
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
timestep {step}
fix move all nve
fix noise all langevin 1 1 {mass} 4711
thermo 100000
run {warm}
{dump}
run {steps}
"""


class Potential:
    """Hamaker and linear superposition, elastic below the cut-off gap; with the switch that coagula puts on its far forces."""

    def __init__(self, program, millivolts):
        curve = json.loads(run([program, "generate", "brownian", "--potential-curve", "--surface-potential", f"{millivolts}mV", "--radius",
                                RADIUS, "--json"]))
        self.cut = curve["cut_gap"] / RADIUS
        self.stiffness = curve["contact_stiffness"] * RADIUS**2 / THERMAL
        volts = THERMAL / 1.602176634e-19
        self.layers = (32 * math.pi * 8.8541878128e-12 * PERMITTIVITY * RADIUS * volts**2 / THERMAL *
                       math.tanh(1e-3 * millivolts / (4 * volts)) ** 2)
        for gap, force in zip(curve["curve"]["gap"], curve["curve"]["force"]):
            ours = self.force(gap / RADIUS) * THERMAL / RADIUS
            if abs(ours - force) > 1e-6 * abs(force) + 1e-18:
                raise SystemExit(f"the potentials differ at a gap of {gap} m: {ours} and {force} N")

    def force(self, gap):
        if gap < self.cut:
            return self.force(self.cut) + self.stiffness * (self.cut - gap)
        r = 2 + gap
        outer, inner = r * r - 4, r * r
        attraction = -HAMAKER / (6 * THERMAL) * (4 * r / outer**2 + 4 * r / inner**2 - 2 * r / outer + 2 * r / inner)
        kappa = RADIUS / DEBYE_LENGTH
        return attraction + self.layers * kappa * math.exp(-kappa * gap)

    def switched(self, gap):
        way = min(max((gap - 0.8) / 0.2, 0), 1)
        return self.force(gap) * (1 - way * way * (3 - 2 * way))

    def table(self, rows=60000, first=1.97, last=3.0):
        gaps = [first + (last - first) * row / (rows - 1) - 2 for row in range(rows)]
        forces = [self.switched(gap) for gap in gaps]
        energy, lines = 0.0, []
        for row in range(rows - 1, -1, -1):
            if row + 1 < rows:
                energy += 0.5 * (forces[row] + forces[row + 1]) * (last - first) / (rows - 1)
            lines.append(f"{row + 1} {2 + gaps[row]:.12g} {energy:.12g} {forces[row]:.12g}")
        return f"DLVO\nN {rows} R {first} {last}\n\n" + "\n".join(reversed(lines)) + "\n"

    def gap_moments(self):
        """Mean and variance of the gap in the contact."""
        gaps = [-0.01 + 2e-6 * row for row in range(14000)]
        energies, energy = [], 0.0
        for gap in gaps:
            energies.append(energy)
            energy -= self.force(gap) * 2e-6
        lowest = min(energies)
        weights = [(2 + gap) ** 2 * math.exp(lowest - energy) for gap, energy in zip(gaps, energies)]
        mean = sum(w * gap for w, gap in zip(weights, gaps)) / sum(weights)
        return mean, sum(w * (gap - mean) ** 2 for w, gap in zip(weights, gaps)) / sum(weights)


def run(words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False, **options)
    if done.returncode != 0:
        raise SystemExit(f"{words[0]} failed: {done.stderr or done.stdout[-2000:]}")
    return done.stdout


def processor_seconds(words, **options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    output = run(words, **options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, output


def pairs():
    """Isolated pairs at rest in their contact."""
    generator, side, places = random.Random(1), round(PAIRS ** (1 / 3)), []
    for number in range(PAIRS):
        centre = [SPACING * (number // side**axis % side + 0.5) for axis in range(3)]
        axis = [generator.gauss(0, 1) for _ in range(3)]
        half = 1.002 / math.hypot(*axis)
        places += [[c + half * a for c, a in zip(centre, axis)], [c - half * a for c, a in zip(centre, axis)]]
    return SPACING * side, places


def variance_of_gaps(frames, edge):
    gaps = []
    for places in frames:
        for one, other in zip(places[::2], places[1::2]):
            gaps.append(math.sqrt(sum(math.remainder(a - b, edge) ** 2 for a, b in zip(one, other))) - 2)
    mean = sum(gaps) / len(gaps)
    return sum((gap - mean) ** 2 for gap in gaps) / (len(gaps) - 1)


def read_frames(path):
    with h5py.File(path) as file:
        return [[[x * 1e-9 / RADIUS for x in place] for place in frame] for frame in
                file["particles/trajectory/position/value"][()].tolist()]


def lammps(folder, potential, edge, places, step, warm, steps, every=0):
    """Processor seconds of the last run, and the frames of a dump."""
    rows = [f"{number} 1 {x % edge!r} {y % edge!r} {z % edge!r}" for number, (x, y, z) in enumerate(places, 1)]
    (folder / "start.data").write_text(f"start\n\n{len(places)} atoms\n1 atom types\n" +
                                       "".join(f"0 {edge!r} {axis}lo {axis}hi\n" for axis in "xyz") +
                                       "\nAtoms # atomic\n\n" + "\n".join(rows) + "\n")
    (folder / "table.txt").write_text(potential.table())
    dump = f"dump all all custom {every} dump.txt id x y z\ndump_modify all sort id format float %.12g" if every else ""
    (folder / "in.lmp").write_text(LAMMPS.format(mass=MASS, skin=0.3, step=step, warm=warm, steps=steps, dump=dump))
    output = run(["lmp", "-in", "in.lmp", "-log", "none"], cwd=folder)
    wall = [float(found) for found in re.findall(r"Loop time of (\S+) ", output)][-1]
    usage = [float(found) for found in re.findall(r"([\d.]+)% CPU use", output)][-1] / 100
    frames = []
    if every:
        lines = (folder / "dump.txt").read_text().splitlines()
        block = len(places) + 9
        for start in range(0, len(lines), block):
            frames.append([[float(x) for x in line.split()[1:]] for line in lines[start + 9:start + block]])
    return wall * usage, frames


def coagula_pairs(program, folder, millivolts, edge, places):
    (folder / "pairs.csv").write_text("x,y,z\n" + "\n".join(",".join(repr(c % edge) for c in place) for place in places) + "\n")
    run([program, "import", "pairs.csv", "--radius", RADIUS, "--length-unit", RADIUS, "--box", edge * RADIUS, "-o", "pairs.h5",
         "--force", "--quiet"], cwd=folder)
    times = ",".join(f"{(30 + number) * 2e-4 * DIFFUSION_TIME}s" for number in range(30))
    run([program, "generate", "brownian", "--start", "pairs.h5", "--surface-potential", f"{millivolts}mV", "--stop-time",
         60 * 2e-4 * DIFFUSION_TIME, "--snapshots", times, "--quiet", "--force", "-o", "run.h5"], cwd=folder)
    return read_frames(folder / "run.h5")


def coagula_rate(program, folder, millivolts, start, steps):
    """Processor seconds per R^2/D: of a long run less a short one, which reads and writes as much."""
    made, seconds = [], []
    for share in (1, 5):
        words = [program, "generate", "brownian", "--start", start, "--surface-potential", f"{millivolts}mV", "--threads", 1, "--quiet",
                 "--force", "--json", "-o", "run.h5", "--stop-time", share * steps * 1e-6 * DIFFUSION_TIME, "--sample-interval",
                 share * steps * 1e-6 * DIFFUSION_TIME]
        used, output = processor_seconds(words, cwd=folder)
        made.append(json.loads(output))
        seconds.append(used)
    time = (made[1]["time"] - made[0]["time"]) / DIFFUSION_TIME
    return (seconds[1] - seconds[0]) / time, made[0]["time_step"]


def compare(program, folder, millivolts, particles, lammps_step, steps):
    potential = Potential(program, millivolts)
    exact = potential.gap_moments()[1]
    edge, places = pairs()
    every = round(2e-4 / lammps_step)
    ours = variance_of_gaps(coagula_pairs(program, folder, millivolts, edge, places), edge) / exact
    theirs = variance_of_gaps(lammps(folder, potential, edge, places, lammps_step, 5 * every, 29 * every, every)[1], edge) / exact
    start = read_frames(folder / "network.h5")[-1]
    box = (particles * 4 / 3 * math.pi / 0.4) ** (1 / 3)
    seconds, taken = coagula_rate(program, folder, millivolts, "network.h5", steps)
    lammps_seconds = lammps(folder, potential, box, start, lammps_step, 200, steps)[0]
    step = taken["value"] / DIFFUSION_TIME
    lammps_rate = lammps_seconds / (steps * lammps_step)
    print(f"| coagula, {taken['stages']} stages | {millivolts} | {step:.2g} | {ours:.3f} | {1e-6 * particles / step / seconds:.2f} | "
          f"{seconds:.0f} | 1 |")
    print(f"| LAMMPS, table + Langevin | {millivolts} | {lammps_step:.2g} | {theirs:.3f} | {1e-6 * particles / lammps_step / lammps_rate:.2f} | "
          f"{lammps_rate:.0f} | {lammps_rate / seconds:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/bin/coagula"))
    parser.add_argument("--particles", type=int, default=8000)
    parser.add_argument("--step", type=float, default=3e-7, help="of LAMMPS, in R^2/D")
    parser.add_argument("--steps", type=int, default=1000, help="that LAMMPS takes of the structure")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run([program, "generate", "brownian", "--particles", arguments.particles, "--volume-fraction", 0.4, "--radius", RADIUS,
             "--surface-potential", "0mV", "--stop-time", 0.044 * DIFFUSION_TIME, "--equilibration-time", 0.05 * DIFFUSION_TIME,
             "--quiet", "-o", "network.h5"], cwd=folder)
        print("| program | mV | time step, R^2/D | variance of the gap over exact | million particle-steps per processor second | "
              "processor seconds per R^2/D | ratio |")
        print("|---|---|---|---|---|---|---|")
        for millivolts in (0, 15):
            compare(program, folder, millivolts, arguments.particles, arguments.step, arguments.steps)


if __name__ == "__main__":
    main()
