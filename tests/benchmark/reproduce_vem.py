#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The void-expansion half of table 2 of Schenker et al. (2012): six numbers of voids, several seeds, beside the published values.

    tests/benchmark/reproduce_vem.py [--particles 8000] [--seeds 3] [--program build/bin/coagula]

Every structure is grown to the published coordination number. Prints a Markdown table (mean over the seeds ± half their range) and exits with 1 if a mean a is more than 4 % from the published
one, a coordination number more than 0.1, or an rms overlap above 0.5 % of the diameter. Needs the Python standard library only.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

# N_V / N, and the published a, C, G' and its spread over six orientations [MPa] (N = 8000).
PUBLISHED = [
    (1 / 8, "1/8", 0.594, 4.68, 1.73, 0.383),
    (1 / 4, "1/4", 0.521, 4.71, 1.83, 0.136),
    (1 / 2, "1/2", 0.467, 4.69, 1.62, 0.190),
    (1.0, "1", 0.418, 4.69, 1.32, 0.237),
    (13 / 8, "13/8", 0.399, 4.69, 1.32, 0.267),
    (2.0, "2", 0.392, 4.61, 1.17, 0.231),
]


def run(command):
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)


def one_structure(program, folder, particles, ratio, coordination, seed):
    path = os.path.join(folder, "vem.h5")
    start = time.monotonic()
    generated = run([program, "generate", "vem", "--particles", str(particles), "--voids", str(round(ratio * particles)),
                     "--volume-fraction", "0.4", "--radius", "0.25um", "--target-coordination", str(coordination), "--seed", str(seed),
                     "--json", "--quiet", "--force", "-o", path])
    seconds = time.monotonic() - start
    measured = run([program, "characterize", path, "--json", "--quiet"])
    sheared = run([program, "shear", path, "--json", "--quiet"])
    return {
        "a": measured["doh"]["a"],
        "C": measured["coordination"],
        "overlap": 100 * generated["overlap"]["rms"],
        "G": sheared["storage_modulus"]["mean"] / 1e6,
        "spread": sheared["storage_modulus"]["std"] / 1e6,
        "below_three": measured["below_three_fraction"],
        "seconds": seconds,
    }


def cell(values, digits):
    scatter = (max(values) - min(values)) / 2 if len(values) > 1 else 0
    return f"{statistics.mean(values):.{digits}f} ± {scatter:.{digits}f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--particles", type=int, default=8000)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--program", default="build/bin/coagula")
    arguments = parser.parse_args()

    failures = []
    print("| N_V/N | a (published) | difference of a | C (published) | rms overlap, % | G' MPa, seeds (published) | "
          "G' std over orientations | below 3 contacts | generate, s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for ratio, name, a, c, g, spread in PUBLISHED:
        with tempfile.TemporaryDirectory() as folder:
            rows = [one_structure(arguments.program, folder, arguments.particles, ratio, c, 1 + seed)
                    for seed in range(arguments.seeds)]
        column = {key: [row[key] for row in rows] for key in rows[0]}
        difference = 100 * (statistics.mean(column["a"]) / a - 1)
        print(f"| {name} | {cell(column['a'], 4)} ({a}) | {difference:+.1f} % | {cell(column['C'], 3)} ({c}) | "
              f"{max(column['overlap']):.3f} | {cell(column['G'], 3)} ({g} ± {spread}) | {statistics.mean(column['spread']):.3f} | "
              f"{statistics.mean(column['below_three']):.3f} | {statistics.median(column['seconds']):.1f} |", flush=True)
        if abs(difference) > 4:
            failures.append(f"N_V/N = {name}: a differs by {difference:.1f} %")
        if abs(statistics.mean(column["C"]) - c) > 0.1:
            failures.append(f"N_V/N = {name}: C differs by more than 0.1")
        if max(column["overlap"]) > 0.5:
            failures.append(f"N_V/N = {name}: the rms overlap is {max(column['overlap']):.2f} %")
    print("\n".join(failures) if failures else "All within the bounds.")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
