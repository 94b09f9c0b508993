#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The measures of coagula characterize beside other programs, ratios in one run.

    tests/benchmark/measures.py [--program build/bin/coagula] [--datasets build/datasets]

Prints tables: each measure at N = 8000; whole processes at N = 8000 with equal and unequal spheres; the exact pore curve at N = 64 000
beside a million sample points that scipy's k-d tree (cKDTree, periodic) answers; at N = 512 000 Voronoi volumes beside voro++ on one core
and the exact curve. The structure is that of 8000 particles at N_V/N = 1/8, repeated along each axis. Needs bench_characterize (cmake
--build build --target benchmarks), which knows voro++ where it is installed, numpy and scipy.
"""

import argparse
import os
import subprocess
import tempfile
import time
from pathlib import Path

import numpy
from scipy.spatial import cKDTree

EDGE, RADIUS = 1.0939048394478881e-05, 0.25e-6


def timed(words, threads=2):
    """Wall and processor seconds of a whole process, and what it wrote."""
    start = time.monotonic()
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, text=True,
                               env={**os.environ, "OMP_NUM_THREADS": str(threads)})
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit("failed: " + " ".join(map(str, words)))
    return time.monotonic() - start, usage.ru_utime + usage.ru_stime, output


def repeated(points, times):
    """The structure beside itself along each axis, shaken by a hundredth of a radius so that the copies differ."""
    steps = numpy.arange(times) * EDGE
    shifts = numpy.stack(numpy.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 1, 3)
    images = (points + shifts).reshape(-1, 3)
    shaken = images + numpy.random.default_rng(1).normal(scale=0.01 * RADIUS, size=images.shape)
    return shaken % (times * EDGE)


def write(path, points, radii):
    rows = numpy.column_stack([points, radii])
    numpy.savetxt(path, rows, delimiter=",", header="x [m],y [m],z [m],radius [m]", comments="", fmt="%.17g")


class Benchmark:
    def __init__(self, program, folder, structure):
        self.program, self.folder, self.structure = program, folder, structure
        self.points = numpy.loadtxt(structure, delimiter=",", skiprows=1)[:, :3] % EDGE

    def packing(self, name, points, radii, edge):
        write(self.folder / "points.csv", points, radii)
        subprocess.run([self.program, "import", self.folder / "points.csv", "--box", repr(edge), "--quiet", "--force", "-o",
                        self.folder / name], check=True)

    def characterize(self, name, *words, threads=2):
        command = ["characterize", self.folder / name, *words, "--quiet", "--force", "-o", self.folder / "out.h5"]
        wall, processor, _ = timed([self.program, *command], threads)
        shown = " ".join(str(word) for word in ["coagula", "characterize", name, *words])
        return wall, processor, shown

    def row(self, what, wall, processor, command):
        print(f"| {what} | {wall:.2f} | {processor:.2f} | `{command}` |", flush=True)

    def whole_processes(self):
        generator = numpy.random.default_rng(2)
        equal = numpy.full(len(self.points), RADIUS)
        self.packing("equal.h5", self.points, equal, EDGE)
        self.packing("unequal.h5", self.points, RADIUS * generator.uniform(0.5, 1, len(self.points)), EDGE)
        print("| N = 8000, two threads | wall, s | processor, s | command |\n|---|---|---|---|")
        for what, words in (("default", []), ("every measure", ["--only", "all"])):
            self.row(what, *self.characterize("equal.h5", *words))
        self.row("pore curve, 200 radii, unequal spheres", *self.characterize("unequal.h5", "--only", "doh"))
        self.row("default, unequal spheres", *self.characterize("unequal.h5"))

    def sampled_curve(self):
        points = repeated(self.points, 2)
        edge = 2 * EDGE
        self.packing("large.h5", points, numpy.full(len(points), RADIUS), edge)
        samples = numpy.random.default_rng(3).uniform(0, edge, (1000000, 3))
        print("\n| N = 64 000, exact curve beside a million points | wall, s | processor, s |\n|---|---|---|")
        for threads in (1, 2):
            wall, processor, command = self.characterize("large.h5", "--only", "doh", threads=threads)
            print(f"| `{command}`, whole process, threads: {threads} | {wall:.2f} | {processor:.2f} |")
            start, processor_start = time.monotonic(), time.process_time()
            distances, _ = cKDTree(points, boxsize=edge).query(samples, workers=threads)
            wall, processor = time.monotonic() - start, time.process_time() - processor_start
            sizes = distances[distances > RADIUS] / RADIUS - 1
            print(f"| cKDTree, tree and queries, workers: {threads}; mean pore {sizes.mean():.5f} r0 | {wall:.2f} | {processor:.2f} |",
                  flush=True)

    def bench(self, heading, *words):
        print(f"\n{heading}: `bench_characterize {' '.join(map(str, words))}`\n")
        print(timed([self.program.with_name("bench_characterize"), *words])[2], flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/bin/coagula"))
    parser.add_argument("--datasets", type=Path, default=Path("build/datasets"))
    arguments = parser.parse_args()
    structure = arguments.datasets / "reference_structures/vem_1-8.csv"
    with tempfile.TemporaryDirectory() as name:
        benchmark = Benchmark(arguments.program.resolve(), Path(name), structure)
        benchmark.whole_processes()
        benchmark.sampled_curve()
        for tiles in (1, 4):
            benchmark.bench(f"N = {8000 * tiles**3}", structure, EDGE, tiles)


if __name__ == "__main__":
    main()
