# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of Hertz contacts that plates press together, and its shear modulus then: what the normal force of a rheometer does to a gel.

    python3 tests/benchmark/diagnosis_campaign/pressed.py PROGRAM FOLDER

prints the modulus over that without load beside the law of the diagnosis, for structures that the program makes in the folder. Pressures are in units of
that at which the contacts bear on average what their adhesion bears at rest."""

import sys
from pathlib import Path

import numpy
from scipy.interpolate import CubicSpline

import hertz
import network

PRESSURES = (-0.2, -0.1, -0.05, 0.0, 0.05, 0.1, 0.2, 0.3, 0.4)


def linear_modulus(contacts, normal, shear):
    """Stress times the volume of a unit of their strain, for contacts of these stiffnesses."""
    ends = contacts.affine
    along = numpy.einsum("mi,mi->m", ends, contacts.axis)[:, None] * contacts.axis
    affine = normal[:, None] * along + shear[:, None] * (ends - along)
    moved = -contacts.tangent(normal, shear).solve(contacts.assembled(affine))
    return float(numpy.sum((ends + numpy.einsum("mik,mk->mi", contacts.moved, moved[contacts.places])) * affine))


def pressed_along(axis, places, bonds, strains):
    """Pressures and moduli of the two planes that plates across this axis shear, at strains of the gap in units of the overlap at rest."""
    strain = numpy.zeros((3, 3))
    strain[axis, axis] = -1.0
    squeezed = hertz.Network(len(places), bonds, strain)
    planes = [hertz.Network(len(places), bonds, network.sheared(axis, other)) for other in range(3) if other != axis]
    unit = 2 / 3 * len(bonds[0]) / 3  # of the pressure times the volume: adhesion 2/3, branch vectors 1
    pressures, moduli = [], []
    for stress, stretched in squeezed.stresses(strains):
        stiffness = numpy.sqrt(numpy.maximum(1 - stretched, 1e-6))
        pressures.append(stress / unit)
        moduli.append(numpy.mean([linear_modulus(plane, stiffness, hertz.SHEAR * stiffness) for plane in planes]))
    return numpy.array(pressures), numpy.array(moduli)


def growth(places, bonds):
    """Modulus at PRESSURES over that without load, mean of three directions of the load."""
    found = []
    for axis in range(3):
        (pulled, of_pulled), (pressed, of_pressed) = (
            pressed_along(axis, places, bonds, sign * 0.02 * 1.25**numpy.arange(-1, steps)) for sign, steps in ((-1, 22), (1, 26)))
        curve = CubicSpline([*pulled[::-1], *pressed], [*of_pulled[::-1], *of_pressed])
        if not pulled[-1] <= PRESSURES[0] < PRESSURES[-1] <= pressed[-1]:
            raise RuntimeError(f"a structure was pressed by {pulled[-1]:.2f} to {pressed[-1]:.2f} only")
        found.append(curve(PRESSURES) / curve(0.0))
    return numpy.mean(found, axis=0)


# Particles, volume fraction, voids, coordination and seed.
SHOWN = (*((400, 0.4, 200, 4.69, 1000 + number) for number in range(4)), (400, 0.5, 200, 4.69, 5), (400, 0.4, 60, 4.69, 5), (400, 0.4, 200, 5.4, 5),
         (400, 0.4, 200, 4.3, 5), (1000, 0.4, 500, 4.69, 5))


def main(program, folder):
    from material import Material

    material = Material(Path(program).resolve(), folder)
    row = lambda name, values: print(f"{name:40}", *(f"{each:7.3f}" for each in values), flush=True)
    row("pressure", PRESSURES)
    row("law", [1 + each / 3 / (1 + 1.5 * each) for each in PRESSURES])
    for particles, fraction, voids, coordination, seed in SHOWN:
        path = Path(folder) / "pressed.h5"
        material.run("generate", "vem", "--particles", particles, "--volume-fraction", fraction, "--voids", voids, "--target-coordination", coordination,
                     "--seed", seed, "--radius", "0.25um", "-o", path, "--force")
        places, radii, box = material.particles(path)
        row(f"N {particles}, phi {fraction}, {voids} voids, C {coordination}", growth(places, network.bonds_of(places, radii, box)))


if __name__ == "__main__":
    main(*sys.argv[1:])
