#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time of one diagnosis of a frequency and an amplitude sweep over two structures of 2000 particles, nothing simulated before.

    tests/benchmark/diagnosis_time.py build/bin/coagula FOLDER

Makes structures, tables (bonds that yield, 2 % errors of G' and 10 % of G'') and experiment file in FOLDER and prints wall and processor time."""

import random
import resource
import subprocess
import sys
import time
from pathlib import Path


def table(path, axis, rows):
    lines = [f"{axis},storage_modulus [Pa],loss_modulus [Pa]"]
    lines += [f"{value:.6g},{1.2e6 * storage * random.gauss(1, 0.02):.6g},{1.2e6 * loss * random.gauss(1, 0.1):.6g}" for value, storage, loss in rows]
    path.write_text("\n".join(lines) + "\n")


def main():
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    random.seed(1)
    for seed in (1, 2):
        subprocess.run([program, "generate", "vem", "--particles", "2000", "--voids", "1000", "--volume-fraction", "0.4", "--radius", "0.25um",
                        "--seed", str(seed), "-o", folder / f"{seed}.h5", "--force", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    table(folder / "frequency.csv", "frequency [Hz]", [(0.1 * 10**(k / 5), 1, 0.01) for k in range(12)])
    loads = [0.5 * k for k in range(1, 15)]
    table(folder / "amplitude.csv", "strain [1]", [(1e-4 * load, max(0.15, 1 - 0.12 * max(0, load - 1.2)), 0.01 + 0.005 * load) for load in loads])
    (folder / "experiment.toml").write_text("""[sample]
particle_radius = "0.25 um"
volume_fraction = 0.4

[structures]
files = ["1.h5", "2.h5"]

[[measurement]]
kind = "frequency-sweep"
file = "frequency.csv"
sample = "A"
values = { strain = 1e-5 }

[[measurement]]
kind = "amplitude-sweep"
file = "amplitude.csv"
sample = "A"
run_order = 1
values = { frequency = "1 Hz" }
""")
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
    (folder / "diagnosis" / "simulations.txt").unlink(missing_ok=True)
    subprocess.run([program, "diagnose", folder / "experiment.toml", "-o", folder / "diagnosis", "--force", "--quiet"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"{time.time() - started:.0f} s, {processor:.0f} s of processor time")


if __name__ == "__main__":
    main()
