#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor seconds and peak memory of each method against the number of particles, one process and one thread each.

    tests/benchmark/costs.py [--program build/bin/coagula] [--particles 1000 8000] [--only shear]

Prints a Markdown table with the command of each row; PN.h5 is the packing of N particles. --only runs the first row, and
those whose command contains the text. Needs the Python standard library only."""
import argparse
import os
import subprocess
import tempfile

MODEL = 'normal_maxwell_stiffness = "50 N/m"\nnormal_maxwell_time = "50 ms"\nsolvent_viscosity = "1 mPa.s"\n'
METHODS = [
    ("generate vem", "generate vem --particles N --volume-fraction 0.4 --radius 0.25um -o PN.h5"),
    ("generate brownian, 0.1 ms after 0.03 ms of equilibration",
     "generate brownian --particles N --volume-fraction 0.4 --radius 0.25um --surface-potential 0mV --equilibration-time 0.03ms "
     "--stop-time 0.1ms -o new.h5"),
    ("characterize", "characterize PN.h5 -o new.h5"),
    ("characterize, every measure", "characterize PN.h5 --only all -o new.h5"),
    ("shear, linear", "shear PN.h5 -o new.h5"),
    ("shear, linear, iterative solver", "shear PN.h5 --solver iterative -o new.h5"),
    ("shear, 20 frequencies", "shear PN.h5 --frequency-sweep 0.1Hz:1kHz:20 --model model.toml -o new.h5"),
    ("shear, quasi-static, secant at a strain of 1e-6, one orientation", "shear PN.h5 --method quasistatic --orientation zx -o new.h5"),
    ("shear, quasi-static, one cycle at 1e-4, one orientation",
     "shear PN.h5 --method quasistatic --amplitudes 1e-4 --orientation zx -o new.h5"),
    ("shear, explicit, one oscillation of 24 000 steps, one orientation",
     "shear PN.h5 --method dem --oscillations 1 --orientation zx -o new.h5"),
    ("report", "report PN.h5 -o new.html"),
]


def timed(program, folder, command):
    """Processor seconds and peak memory [GiB]."""
    process = subprocess.Popen([program, *command.split(), "--threads", "1", "--quiet", "--force"], cwd=folder)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit("failed: coagula " + command)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024**2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/bin/coagula")
    parser.add_argument("--particles", type=int, nargs="+", default=[1000, 8000])
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    heads = [f"N = {particles}: s | GiB" for particles in arguments.particles]
    print(f"| method | {' | '.join(heads)} | command |\n|---{'|---|---' * len(heads)}|---|")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "model.toml"), "w", encoding="utf-8") as file:
            file.write(MODEL)
        for name, command in METHODS:
            if arguments.only not in command and command != METHODS[0][1]:  # which makes the packings
                continue
            cells = []
            for particles in arguments.particles:
                words = command.replace("PN.h5", f"P{particles}.h5").replace("--particles N", f"--particles {particles}")
                cells.append("{:.2f} | {:.2f}".format(*timed(program, folder, words)))
            print(f"| {name} | {' | '.join(cells)} | `coagula {command} --threads 1` |", flush=True)


if __name__ == "__main__":
    main()
