#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far structures differ in what a solvent's drag loses: the figures behind diagnose/src/responses/drag_scatter.cpp.

Structures by void expansion are sheared at reduced drags (drag on a particle times angular frequency over its stiffness) from 1e-7 to 100. Printed are,
of the logarithm of G'' over the mean G' and over the reduced drag, the standard deviation between structures and how it is correlated along the drag."""

import numpy

from scatter_structures import RADIUS, program_and_folder, run, structure

STIFFNESS = 100.0  # of a particle [N/m]
DRAGS = 10.0**numpy.linspace(-7, 2, 19)
CASES = ((400, 4.69, 80), (400, 5.2, 30), (1600, 4.69, 24))  # particles, coordination, structures


def losses(program, folder, particles, coordination, seed):
    """Linear modulus, and loss modulus at all reduced drags, of one structure."""
    path = structure(program, folder, particles, coordination, seed)
    model = folder / "drag.toml"
    model.write_text("solvent_viscosity = 1.0\n")
    frequencies = DRAGS * STIFFNESS / (2 * numpy.pi * 6 * numpy.pi * RADIUS)
    sheared = ("-o", folder / "sheared.h5", "--force")
    linear = run(program, "shear", path, *sheared)["storage_modulus"]["mean"]
    swept = run(program, "shear", path, "--model", model, "--frequency", ",".join(f"{each:.9g}Hz" for each in frequencies), *sheared)
    return linear, swept["loss_modulus"]["mean"]


def main():
    program, folder = program_and_folder(__doc__)
    for particles, coordination, structures in CASES:
        found = [losses(program, folder, particles, coordination, seed) for seed in range(structures)]
        linear = numpy.mean([each[0] for each in found])
        logarithms = numpy.log(numpy.array([each[1] for each in found]) / linear / DRAGS)
        deviation = logarithms.std(axis=0, ddof=1)
        correlation = numpy.corrcoef(logarithms.T)
        print(f"{structures} structures of {particles} particles, coordination {coordination}")
        for drag, each in zip(DRAGS, deviation):
            print(f"  {drag:8.1e}  {each:.3f}")
        for steps in (1, 2, 4):
            print(f"  correlation over {steps / 2} decades, 1e-6 to 1e-2: {numpy.diag(correlation, steps)[2:11 - steps].mean():.2f}")


if __name__ == "__main__":
    main()
