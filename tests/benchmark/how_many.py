#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How structures of one recipe scatter from seed to seed: heterogeneity, coordination and modulus against the number of particles.

    tests/benchmark/how_many.py [--program build/bin/coagula] [--particles 250 1000 4000] [--seeds 8] [--voids 0.5]

Prints a Markdown table: mean, and relative standard deviation over the seeds, of a structure by void expansion. Needs the Python
standard library only."""
import argparse
import json
import os
import statistics
import subprocess
import tempfile

QUANTITIES = ["a", "mean pore radius", "G'"]


def run(program, folder, *words):
    done = subprocess.run([program, *map(str, words), "--json", "--quiet"], cwd=folder, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def structure(program, folder, particles, voids, seed):
    run(program, folder, "generate", "vem", "--particles", particles, "--voids", voids, "--volume-fraction", 0.4, "--radius", "0.25um",
        "--seed", seed, "--force", "-o", "a.h5")
    measured = run(program, folder, "characterize", "a.h5", "--only", "pores,doh")
    sheared = run(program, folder, "shear", "a.h5")
    return measured["doh"]["a"], measured["pore_size"]["mean"], sheared["storage_modulus"]["mean"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/bin/coagula")
    parser.add_argument("--particles", type=int, nargs="+", default=[250, 1000, 4000])
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--voids", type=float, nargs="+", default=[0.125, 0.5], help="voids per particle")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    print("| N | N_V/N | " + " | ".join(f"{name}: mean | scatter" for name in QUANTITIES) + " |\n|---|---" + "|---|---" * 3 + "|")
    with tempfile.TemporaryDirectory() as folder:
        for ratio in arguments.voids:
            for particles in arguments.particles:
                found = zip(*(structure(program, folder, particles, round(ratio * particles), seed)
                              for seed in range(1, arguments.seeds + 1)))
                cells = (f"{statistics.mean(values):.4g} | {100 * statistics.stdev(values) / statistics.mean(values):.1f} %" for values in found)
                print(f"| {particles} | {ratio:g} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
