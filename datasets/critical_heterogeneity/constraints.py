#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many constraints small clusters of touching spheres have, and how many of them are independent.

    datasets/critical_heterogeneity/constraints.py

A contact keeps its normal distance (one constraint) and does not slide (two). The rank of their matrix, over the motions and turns of the spheres, is
the number of independent ones. Needs numpy.
"""

import itertools

import numpy


def rows_of(points, one, other):
    """The normal and the two tangential constraints of a contact of spheres of unit radius, on motions and turns of all."""
    normal = (points[other] - points[one]) / 2
    across = numpy.linalg.svd(normal[None])[2][1:]
    for direction in (normal, *across):
        row = numpy.zeros(6 * len(points))
        row[6 * other:6 * other + 3], row[6 * one:6 * one + 3] = direction, -direction
        row[6 * other + 3:6 * other + 6] = row[6 * one + 3:6 * one + 6] = -numpy.cross(normal, direction)
        yield row


def touching(points):
    return [pair for pair in itertools.combinations(range(len(points)), 2) if abs(numpy.linalg.norm(points[pair[0]] - points[pair[1]]) - 2) < 1e-9]


def ring(number):
    turn = 2 * numpy.pi * numpy.arange(number) / number
    return numpy.column_stack([numpy.cos(turn), numpy.sin(turn), 0 * turn]) / numpy.sin(numpy.pi / number)


def main():
    triangle = ring(3)
    tetrahedron = numpy.vstack([triangle, [0, 0, (8 / 3)**0.5]])
    bipyramid = numpy.vstack([tetrahedron, [0, 0, -(8 / 3)**0.5]])
    clusters = {"triangle": triangle, "ring of four": ring(4), "ring of five": ring(5), "tetrahedron": tetrahedron,
                "two tetrahedra on a face": bipyramid}
    print("cluster                     contacts   normal constraints, independent   all constraints, independent   relative motions")
    for name, points in clusters.items():
        rows = numpy.array([row for pair in touching(points) for row in rows_of(points, *pair)])
        ranks = [numpy.linalg.matrix_rank(part, tol=1e-9) for part in (rows[::3], rows)]
        print(f"{name:28s} {len(rows) // 3:7d} {len(rows) // 3:20d}, {ranks[0]:2d} {len(rows):24d}, {ranks[1]:2d} {6 * len(points) - 6:24d}")


if __name__ == "__main__":
    main()
