# SPDX-License-Identifier: GPL-3.0-or-later
"""A bonded packing for other programs to shear, in units in which they are at ease.

Lengths in particle radii, stiffnesses in the normal stiffness of a contact; so moduli in that stiffness over a radius.
"""

import csv
import itertools
import math
from dataclasses import dataclass


@dataclass
class BondedNetwork:
    edge: float  # of the periodic cube
    positions: list
    bonds: list  # (i, j, distance), i < j

    @property
    def coordination(self):
        return 2 * len(self.bonds) / len(self.positions)


def read_packing(csv_path, particles, volume_fraction):
    """Equal spheres as `coagula export --format csv` writes them; the edge of their cell is not in that file."""
    with open(csv_path, newline="") as file:
        rows = [[float(cell) for cell in row] for row in itertools.islice(csv.reader(file), 1, None)]
    radius = rows[0][3]
    if len(rows) != particles or any(row[3] != radius for row in rows):
        raise ValueError(f"{csv_path} does not hold {particles} equal spheres")
    edge = (particles * 4 / 3 * math.pi / volume_fraction) ** (1 / 3)
    return edge, [[coordinate / radius for coordinate in row[:3]] for row in rows]


def bond(edge, positions, tolerance):
    """Bonds all pairs nearer than 2 (1 + tolerance) over the nearest periodic image: of each pair no other image is in reach."""
    reach = 2 * (1 + tolerance)
    cells = int(edge / reach)
    if cells < 3:
        raise ValueError(f"a cell of edge {edge} is too small for bonds of length {reach}")
    grid = {}
    for index, place in enumerate(positions):
        grid.setdefault(cell_of(place, edge, cells), []).append(index)
    bonds = []
    for cell, members in grid.items():
        for step in itertools.product((-1, 0, 1), repeat=3):
            neighbours = grid.get(tuple((a + b) % cells for a, b in zip(cell, step)), ())
            for i, j in itertools.product(members, neighbours):
                if i < j and (distance := nearest_distance(positions[i], positions[j], edge)) < reach:
                    bonds.append((i, j, distance))
    return BondedNetwork(edge, positions, sorted(bonds))


def cell_of(place, edge, cells):
    return tuple(int(coordinate / edge * cells) % cells for coordinate in place)


def nearest_distance(a, b, edge):
    return math.sqrt(sum(math.remainder(y - x, edge) ** 2 for x, y in zip(a, b)))
