#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's shear test by other programs, beside coagula: six orientations x ten oscillations x 3000 explicit steps.

    tests/benchmark/other_programs.py [--program build/bin/coagula] [--particles 8000] [--steps 3000]

A structure is generated, then each program takes --steps steps on one core (`coagula shear --method dem` ten times as many, one
orientation as a whole process); these are scaled to the protocol's 180 000. Beside them the linear solver, which answers the same question without steps, as a whole process on all cores. LAMMPS (lmp) and Yade are left
out where they are not installed, bench_stepper where it was not built beside the program.
What the steps contain: bonds with normal and shear springs, rotations, a cell under shear, damping. LAMMPS has no such bond in
Debian: it runs granular contacts with shear history plus harmonic bonds, the same amount of work but not the same model.
"""

import argparse
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SUPPORT = Path(__file__).resolve().parent.parent / "support"
sys.path.insert(0, str(SUPPORT))

import lammps_shear  # noqa: E402
from bonded_network import read_packing  # noqa: E402

VOLUME_FRACTION = 0.4
PROTOCOL_STEPS = 6 * 10 * 3000

# Spheres of density 3690 kg/m^3, contacts of 50 and 5 N/m; the diameter is that of the bond tolerance, so that all bonds touch.
LAMMPS_STEPS = """
units si
atom_style hybrid sphere bond
boundary p p p
newton off
comm_modify vel yes
special_bonds lj 1 1 1
bond_style harmonic
read_data network.data
pair_style gran/hooke/history 50 5 0 0 1000 0
change_box all triclinic
set type 1 diameter 5.05e-7 density 3690
pair_coeff * *
bond_coeff 1 25 5e-7
neighbor 5e-8 bin
neigh_modify delay 0 every 1 check yes
timestep 2e-10
fix integrate all nve/sphere
fix damping all viscous 2e-8
fix shear all deform 1 xy erate {rate} remap v
thermo 1000
run {steps}
"""


def measured(command, threads=1, **options):
    """Wall and processor seconds of a whole process, and what it wrote."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True,
                          env={**os.environ, "OMP_NUM_THREADS": str(threads)}, stdin=subprocess.DEVNULL, **options)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def print_row(work, wall, processor, speed="-"):
    print(f"| {work} | {speed} | {wall:.1f} | {processor:.1f} |", flush=True)


def print_scaled(work, wall, processor, steps, particles):
    scale = PROTOCOL_STEPS / steps
    print_row(work, wall * scale, processor * scale, f"{1e-6 * particles * steps / processor:.2f}")


def lammps(folder, steps, particles):
    output = lammps_shear.run(folder, LAMMPS_STEPS.format(rate=1e-3 / (steps * 2e-10), steps=steps))
    wall = float(re.search(r"Loop time of (\S+) ", output)[1])
    usage = float(re.search(r"([\d.]+)% CPU use", output)[1]) / 100
    print_scaled("LAMMPS, granular contacts + harmonic bonds, 1 core", wall, wall * usage, steps, particles)


def yade(folder, steps, particles):
    edge, positions = read_packing(folder / "packing.csv", particles, VOLUME_FRACTION)
    request = {"edge": edge, "positions": positions, "tolerance": 0.01, "shear_stiffness": 0.1, "steps": steps}
    (folder / "request.json").write_text(json.dumps(request))
    measured(["yade", "-j1", "-nx", SUPPORT / "yade_shear.py"], cwd=folder)
    answer = json.loads((folder / "answer.json").read_text())
    print_scaled("Yade, cohesive-frictional, 1 core", answer["seconds"], answer["processor_seconds"], steps, particles)


def stepper(program, steps, particles):
    output = measured([program, particles, steps])[2]
    speed, processor_speed = (float(figure) for figure in re.search(r"1 thread *: *([\d.]+) \(per processor second ([\d.]+)\)", output).groups())
    work = 1e-6 * particles * steps
    print_scaled("coagula, explicit steps (bench_stepper), 1 core", work / speed, work / processor_speed, steps, particles)


def explicit_shear(program, folder, steps, particles):
    """One orientation of ten oscillations, relaxation before and rest after it included."""
    wall, processor, _ = measured([program, "shear", "packing.h5", "--quiet", "-o", "d.h5", "--force", "--method", "dem", "--boundary",
                                   "periodic", "--orientation", "zx", "--steps-per-oscillation", steps], cwd=folder)
    print_scaled("`coagula shear --method dem`, periodic cell, 1 core", wall, processor, 10 * steps, particles)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/bin/coagula"))
    parser.add_argument("--particles", type=int, default=8000)
    parser.add_argument("--steps", type=int, default=3000)
    arguments = parser.parse_args()
    program, particles, steps = arguments.program.resolve(), arguments.particles, arguments.steps
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        measured([program, "generate", "vem", "--particles", particles, "--voids", particles // 2, "--volume-fraction",
                  VOLUME_FRACTION, "--radius", "0.25um", "--quiet", "-o", "packing.h5"], threads=os.cpu_count(), cwd=folder)
        measured([program, "export", "packing.h5", "--format", "csv", "-o", "packing.csv"], cwd=folder)
        measured([program, "export", "packing.h5", "--format", "lammps", "-o", "network.data"], cwd=folder)
        print("| work | million particle-steps per processor second | six orientations: wall, s | processor, s |")
        print("|---|---|---|---|")
        shear = measured([program, "shear", "packing.h5", "--quiet", "-o", "s.h5"], threads=os.cpu_count(), cwd=folder)
        print_row("`coagula shear`, linear, all cores", *shear[:2])
        explicit_shear(program, folder, steps, particles)
        if (benchmark := program.with_name("bench_stepper")).exists():
            stepper(benchmark, steps, particles)
        if shutil.which("lmp"):
            lammps(folder, steps, particles)
        if shutil.which("yade"):
            yade(folder, steps, particles)


if __name__ == "__main__":
    main()
