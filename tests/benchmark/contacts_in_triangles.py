#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a contact in a triangle is worth to the modulus, and what one outside.

    tests/benchmark/contacts_in_triangles.py FOLDER [COORDINATION]

takes the structures that what_rules_the_modulus.py has left in FOLDER, of this coordination number (4.7 when not given), and removes 2 % of their
contacts: from among those that are a side of a triangle of touching particles, or from among the others. Printed is how much of G' is left, means
of three draws. The solver is one of its own (scipy), with nothing of the program in it; that G' of the whole network agrees with the program's is
checked. Needs numpy, scipy and h5py.
"""

import json
import pathlib
import sys

import h5py
import numpy
import scipy.sparse
import scipy.sparse.linalg

NORMAL, SHEAR = 50.0, 5.0  # of a contact [N/m]
REMOVED = 0.02
DRAWS = 3
PLANES = ((0, 1), (0, 2), (1, 2))


def network(path):
    """Number of particles, bonds (B, 2), vectors between their centres (B, 3) [m] and volume of the box [m3]."""
    with h5py.File(path) as file:
        box = file["particles/trajectory/box/edges/value"][0] * 1e-9
        return (len(file["particles/trajectory/id"]), file["connectivity/bonds"][()], file["connectivity/branch_vectors"][()],
                abs(numpy.linalg.det(box)))


def shear_modulus(particles, bonds, branch, volume):
    """Mean over three planes [Pa]. Springs act where the spheres touch, and particles turn; turns are counted in mean contact lengths."""
    axis = branch / numpy.linalg.norm(branch, axis=1)[:, None]
    length = numpy.linalg.norm(branch, axis=1).mean()
    spring = SHEAR * numpy.eye(3) + (NORMAL - SHEAR) * axis[:, :, None] * axis[:, None, :]
    turn = numpy.zeros((len(bonds), 3, 3))  # v -> branch x v, over two lengths
    for row, column, of, sign in ((0, 1, 2, -1), (0, 2, 1, 1), (1, 0, 2, 1), (1, 2, 0, -1), (2, 0, 1, -1), (2, 1, 0, 1)):
        turn[:, row, column] = sign * branch[:, of] / (2 * length)
    one = numpy.broadcast_to(numpy.eye(3), turn.shape)
    moved = numpy.concatenate([-one, turn, one, turn], axis=2)
    blocks = numpy.einsum("mai,mab,mbj->mij", moved, spring, moved)
    places = numpy.concatenate([6 * bonds[:, [end]] + numpy.arange(6) for end in (0, 1)], axis=1)
    size = 6 * particles
    stiffness = scipy.sparse.csc_matrix((blocks.ravel(), (numpy.repeat(places, 12, axis=1).ravel(), numpy.tile(places, 12).ravel())),
                                        shape=(size, size)) + 1e-12 * NORMAL * scipy.sparse.eye(size, format="csc")  # what nothing holds
    factor = scipy.sparse.linalg.splu(stiffness, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True})
    moduli = []
    for plane in PLANES:
        strain = numpy.zeros((3, 3))
        strain[plane] = strain[plane[::-1]] = 0.5
        affine = branch @ strain
        force = numpy.einsum("mab,mb->ma", spring, affine)
        load = numpy.zeros(size)
        numpy.add.at(load, places.ravel(), numpy.einsum("mai,ma->mi", moved, force).ravel())
        moduli.append((numpy.sum(affine * force) - load @ factor.solve(load)) / volume)
    return float(numpy.mean(moduli))


def triangles_of(particles, bonds):
    """Number of triangles of which each bond is a side."""
    joined = scipy.sparse.csr_matrix((numpy.ones(len(bonds)), bonds.T), shape=(particles, particles))
    joined = joined + joined.T
    return numpy.asarray((joined @ joined)[bonds[:, 0], bonds[:, 1]]).ravel()


def left(whole, modulus, pool, generator):
    """Share of G' that is left without some of the bonds of the pool."""
    particles, bonds, branch, volume = whole
    there = numpy.ones(len(bonds), bool)
    there[generator.choice(pool, round(REMOVED * len(bonds)), replace=False)] = False
    return shear_modulus(particles, bonds[there], branch[there], volume) / modulus


def main():
    folder, coordination = pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "4.7"
    generator = numpy.random.default_rng(1)
    lost = []
    print("structure                 contacts in triangles   G' left without 2 % of them   without 2 % of the others")
    for path in sorted(folder.glob(f"*_{coordination}_?.sheared")):
        whole = network(path)
        modulus = shear_modulus(*whole)
        stated = json.loads(path.with_suffix(".json").read_text())["G"]
        assert abs(modulus / 1e6 / stated - 1) < 1e-4, f"{path.stem}: {modulus / 1e6} instead of {stated} MPa"
        triangles = triangles_of(*whole[:2])
        kept = [numpy.mean([left(whole, modulus, numpy.flatnonzero(kind), generator) for _ in range(DRAWS)])
                for kind in (triangles > 0, triangles == 0)]
        lost.append(-numpy.log(kept))
        print(f"{path.stem:25s} {100 * numpy.mean(triangles > 0):10.0f} % {100 * kept[0]:24.1f} % {100 * kept[1]:27.1f} %", flush=True)
    ratio = numpy.array([outside / inside for inside, outside in lost])
    print(f"a contact outside triangles is worth {ratio.mean():.2f} +- {ratio.std(ddof=1) / len(ratio)**0.5:.2f} in triangles, "
          f"by the logarithm of G'; {len(ratio)} structures")


if __name__ == "__main__":
    main()
