#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor time of a loop in Python over that of the same loop in C++: generate, characterize and shear structures, rows into a CSV.

    cmake --build build --target bench_python_loop coagula_python_package
    PYTHONPATH=build/python OMP_NUM_THREADS=1 tests/benchmark/python_loop.py build/bin/bench_python_loop --structures 1000 -o rows.csv

The two take turns, so that what else the machine does meets both. The rows must be the same. The time in Python outside the calls of the
extension is counted, too: on a busy machine the difference of the two loops is mostly noise, this is not.
"""

import argparse
import csv
import subprocess
import time

import coagula
from coagula import _coagula

in_extension = 0.0


def count_calls_of_extension():
    def counted(function):
        def call(*words):
            global in_extension
            begun = time.process_time()
            try:
                return function(*words)
            finally:
                in_extension += time.process_time() - begun
        return call

    for name in ("generate_vem", "characterize", "shear"):
        setattr(_coagula, name, counted(getattr(_coagula, name)))


def rows_in_python(particles, seeds, writer):
    for seed in seeds:
        made = coagula.generate_vem(particles=particles, volume_fraction=0.4, radius="0.25um", seed=seed)
        measured = coagula.characterize(made)
        response = coagula.shear(made)
        writer.writerow([seed, measured.coordination, measured.doh.a, response.storage_modulus.mean])


def rows_in_cpp(program, particles, seeds):
    done = subprocess.run([program, str(particles), str(seeds[0]), str(len(seeds))], check=True, capture_output=True, text=True)
    return [[float(cell) for cell in row] for row in csv.reader(done.stdout.splitlines())], float(done.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", help="bench_python_loop")
    parser.add_argument("--structures", type=int, default=1000)
    parser.add_argument("--particles", type=int, default=500)
    parser.add_argument("--turn", type=int, default=2, help="structures of one turn")
    parser.add_argument("-o", "--output", default="rows.csv")
    options = parser.parse_args()

    count_calls_of_extension()
    in_python, in_cpp, expected = 0.0, 0.0, []
    with open(options.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["seed", "coordination", "a", "shear modulus [Pa]"])
        for first in range(1, options.structures + 1, options.turn):
            seeds = range(first, min(first + options.turn, options.structures + 1))
            rows, seconds = rows_in_cpp(options.program, options.particles, seeds)
            expected += rows
            in_cpp += seconds
            begun = time.process_time()
            rows_in_python(options.particles, seeds, writer)
            in_python += time.process_time() - begun
    with open(options.output, newline="", encoding="utf-8") as file:
        written = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
    if written != expected:
        raise SystemExit("the rows of Python and C++ differ")
    print(f"structures            {options.structures} of {options.particles} particles, equal rows from both")
    print(f"C++                   {1e3 * in_cpp / options.structures:.1f} ms of processor time a structure")
    print(f"Python                {1e3 * in_python / options.structures:.1f} ms of processor time a structure")
    print(f"Python over C++       {100 * (in_python / in_cpp - 1):+.2f} %")
    outside = in_python - in_extension
    print(f"outside the extension {1e3 * outside / options.structures:.2f} ms a structure, {100 * outside / in_cpp:.2f} %")


if __name__ == "__main__":
    main()
