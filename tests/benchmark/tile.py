#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a large packing of a small one: copies of a periodic cube side by side, with some particles removed at random.

    tests/benchmark/tile.py points.csv EDGE COPIES REMOVED > tiled.csv

points.csv: one header line, then x,y,z in metres; EDGE of its cube in metres; COPIES along each axis; REMOVED: the fraction left out,
so that the copies differ. The edge of the new cube is COPIES x EDGE. Needs the Python standard library only.
"""
import itertools
import random
import sys


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    edge, copies, removed = float(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4])
    with open(sys.argv[1]) as file:
        points = [[float(cell) for cell in line.split(",")] for line in file.readlines()[1:] if line.strip()]
    random.seed(1)
    print("x [m],y [m],z [m]")
    for shift in itertools.product(range(copies), repeat=3):
        for point in points:
            if random.random() >= removed:
                print(",".join(f"{x + n * edge:.12e}" for x, n in zip(point, shift)))


if __name__ == "__main__":
    main()
