# SPDX-License-Identifier: GPL-3.0-or-later
"""A network of Hertz contacts that is sheared in small steps, in equilibrium after each by Newton's method: nothing of the program is in it."""

import numpy
import scipy.sparse
import scipy.sparse.linalg

import network

POISSON = 0.2
SHEAR = 2 * (1 - POISSON) / (2 - POISSON)  # of a contact over its normal stiffness (Mindlin 1949)
EXACT = 1e-3                               # of the forces that are left over


class Network:
    """Contacts of unit stiffness at rest and unit overlap there; lengths are those of the branch vectors over their mean."""

    def __init__(self, count, bonds, strain):
        """@param strain of the box, a unit of it."""
        first, second, branch = bonds
        branch = branch / numpy.linalg.norm(branch, axis=1).mean()
        self.axis = branch / numpy.linalg.norm(branch, axis=1)[:, None]
        number = len(first)
        turn = numpy.zeros((number, 3, 3))
        for a, b, c in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            turn[:, a, b], turn[:, b, a] = -branch[:, c] / 2, branch[:, c] / 2
        one = numpy.broadcast_to(numpy.eye(3), (number, 3, 3))
        self.moved = numpy.concatenate([-one, turn, one, turn], axis=2)
        self.places = numpy.concatenate([6 * first[:, None] + numpy.arange(6), 6 * second[:, None] + numpy.arange(6)], axis=1)
        self.affine = branch @ strain
        self.size = 6 * count
        self.rows, self.columns = numpy.repeat(self.places, 12, axis=1).ravel(), numpy.tile(self.places, 12).ravel()
        self.across = one - numpy.einsum("mi,mj->mij", self.axis, self.axis)

    def assembled(self, forces):
        return numpy.bincount(self.places.ravel(), numpy.einsum("mik,mi->mk", self.moved, forces).ravel(), self.size)

    def tangent(self, normal, shear):
        local = normal[:, None, None] * (numpy.eye(3) - self.across) + shear[:, None, None] * self.across
        blocks = self.moved.transpose(0, 2, 1) @ local @ self.moved
        matrix = scipy.sparse.csc_matrix((blocks.ravel(), (self.rows, self.columns)), shape=(self.size, self.size))
        matrix += 1e-9 * scipy.sparse.identity(self.size, format="csc")  # what nothing holds
        return scipy.sparse.linalg.splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})

    def stresses(self, strains):
        """Stress times the volume at strains that grow, in units of the overlap at rest, and by how much each contact has opened. The shear stiffness of
        a step is that in its middle, as the step before has it, so that each step minimises a convex energy."""
        along_contacts, stretched, last = numpy.zeros_like(self.axis), numpy.zeros(len(self.axis)), 0.0
        per_strain = numpy.zeros(self.size)
        for strain in strains:
            step, change = (strain - last) * self.affine, (strain - last) * per_strain
            middle = 1 - stretched * (1 + (strain / last - 1) / 2 if last else 1)
            shear = SHEAR * numpy.sqrt(abs(middle))
            factor, accepted, before, part = None, change, numpy.inf, 1.0
            for _ in range(200):
                ends = step + numpy.einsum("mik,mk->mi", self.moved, change[self.places])
                along = numpy.einsum("mi,mi->m", ends, self.axis)
                overlap = 1 - stretched - along
                force = along_contacts + shear[:, None] * (ends - along[:, None] * self.axis)
                pull = 2 / 3 * (1 - numpy.sign(overlap) * abs(overlap)**1.5)  # beyond that at rest, which something else bears
                total = force + pull[:, None] * self.axis
                left = self.assembled(total)
                size = numpy.linalg.norm(left)
                if size < EXACT * numpy.linalg.norm(total):
                    break
                if size > before and part > 0.01:  # too far
                    part *= 0.5
                    change = accepted + part * move
                    continue
                if factor is None or size > 0.3 * before:
                    factor = self.tangent(numpy.maximum(numpy.sqrt(abs(overlap)), 0.03), numpy.maximum(shear, 0.03))
                before, accepted, part = size, change, 1.0
                move = -factor.solve(left)
                change = accepted + move
            else:
                raise RuntimeError("a network of Hertz contacts found no equilibrium")
            along_contacts, stretched, per_strain, last = force, stretched + along, change / (strain - last), strain
            yield float(numpy.sum(total * self.affine)), stretched


def secants(places, bonds, box, loads, plane):
    """Stress over strain at strains of so many times the overlap at rest, over that of small strains; mean of both directions. The overlap is in radii."""
    sheared = Network(len(places), bonds, network.PLANES[plane])
    loads = numpy.concatenate([[1e-3], loads])
    # Overlaps count in radii, branch vectors in diameters.
    up, down = ([stress for stress, _ in sheared.stresses(sign * 2 * loads)] for sign in (1, -1))
    stresses = (numpy.array(up) - numpy.array(down)) / 2
    secant = stresses / loads
    return (secant[1:] / secant[0]).tolist()
