#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a contact is worth to the modulus: in a triangle, outside, and among those through which most shortest ways run.

    datasets/critical_heterogeneity/contacts.py FOLDER

takes structures of 1000 particles of sizes.h5 in FOLDER and removes 2 % of their contacts: from the sides of triangles, from the others, at random
from all, or those of highest betweenness (whole and by kind). Printed is how much of G' is left. The solver is one of its own, in networks.py; that
G' of the whole network agrees with coagula's is checked. Needs the Python package of coagula, numpy and scipy.
"""

import pathlib
import sys

import coagula
import numpy

from networks import Network, shear_modulus

NORMAL, SHEAR = 50.0, 5.0  # of a contact [N/m]
REMOVED = 0.02
DRAWS = 2


def betweenness(packing, network):
    """Of each bond of the network."""
    found = coagula.characterize(packing, only="betweenness")["betweenness"]
    known = {(min(pair), max(pair)): value for pair, value in zip(found["contacts"].tolist(), found["of_contact"])}
    return numpy.array([known[min(one, other), max(one, other)] for one, other in network.bonds])


def left(whole, modulus, removed):
    there = numpy.ones(len(whole.bonds), bool)
    there[removed] = False
    return shear_modulus(whole.part(there), NORMAL, SHEAR) / modulus


def recipe(table, number):
    voids = table["voids"][number]
    return f"void expansion, {int(voids)} voids" if str(table["generator"][number]) == "vem" else "Brownian, 0 mV"


def losses(data, table, number, generator):
    """Shares of G' that are left, and of the sides of triangles: in all contacts, and among those of highest betweenness."""
    packing = data.structure(table["id"][number]).packing
    whole = Network.of_packing(packing)
    modulus = shear_modulus(whole, NORMAL, SHEAR)
    assert abs(modulus / table["storage_modulus.mean"][number] - 1) < 1e-4
    sides = whole.triangles_of_bonds()
    count = round(REMOVED * len(whole.bonds))
    pools = (numpy.flatnonzero(sides > 0), numpy.flatnonzero(sides == 0), numpy.arange(len(sides)))
    kept = [numpy.mean([left(whole, modulus, generator.choice(pool, count, replace=False)) for _ in range(DRAWS)]) for pool in pools]
    highest = numpy.argsort(-betweenness(packing, whole))[:count]
    return [*kept, left(whole, modulus, highest), numpy.mean(sides > 0), numpy.mean(sides[highest] > 0)]


def main():
    data = coagula.open_dataset(str(pathlib.Path(sys.argv[1]) / "sizes.h5"))
    table = data.table()
    generator = numpy.random.default_rng(1)
    found = {}
    for number in range(len(data)):
        is_done = str(table["status"][number]) == "done" and table["shear-stiffness"][number] == 10
        if is_done and len(data.structure(table["id"][number]).packing.radii) == 1000:
            found.setdefault(recipe(table, number), []).append(losses(data, table, number, generator))
    print("G' left without 2 % of the contacts: of those in triangles, of the others, of all, of highest betweenness; in triangles: of all, of the highest")
    for name, rows in found.items():
        print(f"  {name:32s}" + "".join(f"{100 * value:8.1f} %" for value in numpy.mean(rows, axis=0)) + f"   {len(rows)} structures")
    lost = -numpy.log(numpy.array([row[:4] for rows in found.values() for row in rows]))
    for name, one, other in (("outside triangles", 1, 0), ("of highest betweenness", 3, 2)):
        ratio = lost[:, one] / lost[:, other]
        print(f"a contact {name} is worth {ratio.mean():.2f} +- {ratio.std(ddof=1) / len(ratio)**0.5:.2f} of one "
              f"{'in triangles' if one == 1 else 'at random'}, by the logarithm of G'; {len(ratio)} structures")


if __name__ == "__main__":
    main()
