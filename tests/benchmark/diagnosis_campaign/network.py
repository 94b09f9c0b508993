# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear modulus of a bonded network by a sparse solver of scipy, with bonds that are missing at random: nothing of the program is in it."""

import numpy
import scipy.sparse
import scipy.sparse.linalg


def bonds_of(points, radii, box, tolerance=0.01):
    """Pairs nearer than (1 + tolerance) times the sum of their radii, and the vectors between them; the box is periodic."""
    branch = points[None, :, :] - points[:, None, :]
    branch -= box * numpy.round(branch / box)
    near = numpy.linalg.norm(branch, axis=2) < (1 + tolerance) * (radii[:, None] + radii[None, :])
    first, second = numpy.nonzero(numpy.triu(near, 1))
    return first, second, branch[first, second]


def cross(vector):
    x, y, z = vector
    return numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def sheared(a, b):
    """Strain in a plane."""
    strain = numpy.zeros((3, 3))
    strain[a, b] = strain[b, a] = 0.5
    return strain


PLANES = (sheared(0, 1), sheared(0, 2), sheared(1, 2))


def shear_modulus(count, bonds, box, normal, shear, tension=0.0):
    """Mean over the three planes [Pa]. A contact in the middle of two equal spheres has springs `normal` and `shear` [N/m]; particles turn. A bond
    that pulls at rest resists with that tension over its length [N/m] when its ends move sideways."""
    first, second, branch = bonds
    length = numpy.linalg.norm(branch, axis=1).mean()
    blocks, rows, columns = [], [], []
    forces = numpy.zeros((6 * count, 3))
    energy = numpy.zeros(3)
    for i, j, arm in zip(first, second, branch):
        axis = arm / numpy.linalg.norm(arm)
        local = shear * numpy.eye(3) + (normal - shear) * numpy.outer(axis, axis)
        # Displacement at the contact: u_j - u_i - (turn_i + turn_j) x arm / 2; turns are those of the surfaces, in units of the mean length.
        turn = cross(arm) / 2 / length
        moved = numpy.hstack([-numpy.eye(3), turn, numpy.eye(3), turn])
        centres = numpy.hstack([-numpy.eye(3), numpy.zeros((3, 3)), numpy.eye(3), numpy.zeros((3, 3))])
        sideways = tension * (numpy.eye(3) - numpy.outer(axis, axis))
        places = numpy.r_[6 * i:6 * i + 6, 6 * j:6 * j + 6]
        blocks.append(moved.T @ local @ moved + centres.T @ sideways @ centres)
        rows.append(numpy.repeat(places, 12))
        columns.append(numpy.tile(places, 12))
        affine = numpy.array([plane @ arm for plane in PLANES]).T
        forces[places] += moved.T @ local @ affine + centres.T @ sideways @ affine
        energy += numpy.einsum("ik,ij,jk->k", affine, local + sideways, affine)
    stiffness = scipy.sparse.csc_matrix((numpy.ravel(blocks), (numpy.ravel(rows), numpy.ravel(columns))), shape=(6 * count, 6 * count))
    stiffness += 1e-9 * normal * scipy.sparse.identity(6 * count, format="csc")  # what nothing holds
    relaxed = scipy.sparse.linalg.splu(stiffness, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}).solve(forces)
    return float(numpy.mean(energy - numpy.einsum("ik,ik->k", forces, relaxed)) / numpy.prod(box))


def without(bonds, share, generator):
    """The bonds of which each is missing with this probability."""
    there = generator.random(len(bonds[0])) >= share
    return tuple(part[there] for part in bonds)
