#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far structures differ in how Hertz contacts stiffen with strain: the figures behind diagnose/src/responses/hertz_scatter.cpp.

Networks of Hertz contacts in structures by void expansion are sheared in small steps by Newton's method (diagnosis_campaign/hertz.py), in three planes and
both directions. Printed are, of the logarithm of the secant modulus over that of small strains, the mean, the standard deviation between structures and the
principal errors, all at strains of so many times the overlap at rest."""

import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy

from scatter_structures import program_and_folder, run, structure

sys.path.append(str(Path(__file__).parent / "diagnosis_campaign"))
import hertz
import network
from material import particles_of

LOADS = 0.1 * 10.0**(numpy.arange(15) / 4)  # strains over the overlap at rest, over the radius
CASES = ((400, 4.69, 40), (400, 5.2, 20), (1600, 4.69, 12))  # particles, coordination, structures
STEPS = 2  # from one of those to the next


def curve(program, folder, case, seed):
    """Logarithms of the secant modulus of one structure over that of small strains."""
    path = structure(program, folder, *case, seed)
    centres, radii, box = particles_of(partial(run, program), path, path.with_suffix(".csv"))
    bonds = network.bonds_of(centres, radii, box)
    loads = LOADS[0] * 10.0**(numpy.arange(14 * STEPS + 1) / (4 * STEPS))
    planes = [hertz.secants(centres, bonds, box, loads, plane)[::STEPS] for plane in range(3)]
    return numpy.log(numpy.mean(planes, axis=0))


def main():
    program, folder = program_and_folder(__doc__)
    numpy.set_printoptions(linewidth=150, precision=4, suppress=True)
    for particles, coordination, structures in CASES:
        with ProcessPoolExecutor() as pool:
            found = numpy.array(list(pool.map(partial(curve, program, folder, (particles, coordination)), range(structures))))
        print(f"{structures} structures of {particles} particles, coordination {coordination}")
        print("  strain over overlap ", LOADS)
        print("  mean                ", numpy.exp(found.mean(axis=0)))
        print("  deviation           ", found.std(axis=0, ddof=1))
        variances, axes = numpy.linalg.eigh(numpy.cov(found.T))
        for number in (1, 2, 3):
            print(f"  principal error {number}   ", axes[:, -number] * numpy.sqrt(variances[-number]) * numpy.sign(axes[4, -number]))


if __name__ == "__main__":
    main()
