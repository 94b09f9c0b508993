#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times the verbs of the program as whole processes: wall seconds, processor seconds, peak memory.

    tests/benchmark/speed.py [--program build/bin/coagula] [--large 64000 512000] [--runs 3]

N = 8000 is run --runs times (median printed); the sizes of --large once each, generated first. Prints a Markdown table.
Needs the Python standard library only. The peak memory is the largest of the process as the system counts it.
"""
import argparse
import os
import statistics
import subprocess
import tempfile
import time


def timed(command):
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit("failed: " + " ".join(command))
    return time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024**2


def row(name, command, runs):
    figures = [timed(command) for _ in range(runs)]
    wall, processor, memory = (statistics.median(column) for column in zip(*figures))
    print(f"| {name} | {wall:.2f} | {processor:.2f} | {memory:.2f} | `{' '.join(command).replace(command[0], 'coagula')}` |", flush=True)


def stages(program, folder, particles, runs):
    path = os.path.join(folder, f"{particles}.h5")
    row(f"generate vem, N = {particles}, N_V/N = 1/2",
        [program, "generate", "vem", "--particles", str(particles), "--voids", str(particles // 2), "--volume-fraction", "0.4",
         "--radius", "0.25um", "--seed", "1", "--quiet", "--force", "-o", path], runs)
    row(f"characterize, N = {particles}", [program, "characterize", path, "--quiet", "-o", path + ".c.h5", "--force"], runs)
    row(f"shear, N = {particles}", [program, "shear", path, "--quiet", "-o", path + ".s.h5", "--force"], runs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/bin/coagula")
    parser.add_argument("--large", type=int, nargs="*", default=[])
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    print("| work | wall, s | processor, s | peak memory, GiB | command |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        stages(arguments.program, folder, 8000, arguments.runs)
        for particles in arguments.large:
            stages(arguments.program, folder, particles, 1)


if __name__ == "__main__":
    main()
