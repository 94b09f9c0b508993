#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How pore curves scatter from structure to structure, and what the longest waves of the pore space say of it: the rule by which `coagula diagnose`
states the error of few structures, by code that it does not share. Run: tests/benchmark/pore_scatter.py COAGULA FOLDER [--structures 24]

FOLDER keeps the structures.
"""

import argparse
import itertools
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy
from scipy.spatial import cKDTree

VEM = ["vem", "--volume-fraction", 0.4, "--radius", "0.25 um"]
COAGULATED = ["brownian", "--volume-fraction", 0.4, "--radius", "0.25 um", "--particles", 300, "--stop-coordination", 4.69, "--surface-potential"]
MADE = {
    "vem, 300 particles, 150 voids": [*VEM, "--particles", 300, "--voids", 150],
    "vem, 500 particles, 80 voids": [*VEM, "--particles", 500, "--voids", 80],
    "brownian, 300 particles, 0 mV": [*COAGULATED, "0 mV"],
    "brownian, 300 particles, 14 mV": [*COAGULATED, "14 mV"],
}
RADII = numpy.linspace(0.05, 1.1, 22)  # over that of the particles
GRID = 64                              # points along an edge
WAVES = numpy.array([wave for wave in itertools.product((-1, 0, 1), repeat=3) if 0 < numpy.abs(wave).sum() < 3 and wave > (0, 0, 0)])


def made(program, folder, name, words, number):
    path = folder / f"{'_'.join(name.replace(',', '').split())}_{number}.h5"
    if not path.exists():
        words = ["generate", *words, "--seed", 100 + number, "-o", path, "--threads", 1, "--quiet"]
        subprocess.run([program, *map(str, words)], check=True, capture_output=True)
    return path


def measured(path):
    """Pore curve, and its covariance between such structures by the waves of this one."""
    with h5py.File(path) as file:
        particles = file["particles/trajectory"]
        places, radii, box = particles["position/value"][0], particles["radius"][:], numpy.diag(particles["box/edges/value"][0])
    points = (numpy.stack(numpy.meshgrid(*[numpy.arange(GRID)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5) / GRID
    distance, nearest = cKDTree(places % box, boxsize=box).query(points * box)
    free = distance - radii[nearest]
    phases = numpy.exp(-2j * numpy.pi * points @ WAVES.T)
    share = numpy.mean(free > 0)
    curve = numpy.array([numpy.mean(free > radius * radii.mean()) for radius in RADII]) / share
    voids = phases[free > 0].sum(axis=0) / len(points)
    waves = numpy.array([phases[free > radius * radii.mean()].sum(axis=0) for radius in RADII]) / len(points)
    waves = (waves - curve[:, None] * voids) / share
    waves -= ((waves @ voids.conj()).real / numpy.sum(numpy.abs(voids)**2))[:, None] * voids
    return curve, (waves @ waves.conj().T).real / (len(WAVES) - 0.5)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("coagula", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--structures", type=int, default=24)
    chosen = parser.parse_args()
    chosen.folder.mkdir(parents=True, exist_ok=True)
    print("| structures | standard deviation found at P = 0.4, 0.1, 0.03 | waves over it | variance along the main axis |\n|---|---|---|---|")
    for name, words in MADE.items():
        with ThreadPoolExecutor(2) as pool:
            paths = list(pool.map(lambda number: made(chosen.coagula, chosen.folder, name, words, number), range(chosen.structures)))
        curves, covariances = map(numpy.array, zip(*map(measured, paths)))
        seen = curves.mean(axis=0) > 0.01
        found, stated = numpy.cov(curves[:, seen].T), covariances.mean(axis=0)[numpy.ix_(seen, seen)]
        at = [int(numpy.abs(curves.mean(axis=0)[seen] - p).argmin()) for p in (0.4, 0.1, 0.03)]
        deviations, ratios = numpy.sqrt(numpy.diag(found))[at], numpy.sqrt(numpy.diag(stated) / numpy.diag(found))[at]
        variances, axes = numpy.linalg.eigh(found)
        cells = [" / ".join(f"{x:.4f}" for x in deviations), " / ".join(f"{x:.2f}" for x in ratios), f"{axes[:, -1] @ stated @ axes[:, -1] / variances[-1]:.2f}"]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
