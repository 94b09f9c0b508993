# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of contacts, their shear modulus by a solver with nothing of coagula in it, and counts of triangles. Needs coagula,
numpy and scipy."""

import coagula
import numpy
import scipy.sparse
import scipy.sparse.csgraph
import scipy.sparse.linalg

PLANES = ((0, 1), (0, 2), (1, 2))


class Network:
    """Particles, bonds (B, 2), vectors between their centres (B, 3) [m] and volume of the box [m3]."""

    def __init__(self, particles, bonds, branch, volume):
        self.particles, self.bonds, self.branch, self.volume = particles, bonds, branch, volume

    def part(self, kept):
        """The same with some of the bonds."""
        return Network(self.particles, self.bonds[kept], self.branch[kept], self.volume)

    @classmethod
    def of_packing(cls, packing, tolerance=0.01):
        """That of the contacts of a coagula.Packing."""
        found = coagula.find_contacts(packing, tolerance)
        return cls(len(packing.radii), numpy.asarray(found.ends), numpy.asarray(found.branch), abs(numpy.linalg.det(packing.edges)))

    def adjacency(self):
        joined = scipy.sparse.csr_matrix((numpy.ones(len(self.bonds)), self.bonds.T), shape=(self.particles, self.particles))
        return joined + joined.T

    def triangles_of_bonds(self):
        """Number of triangles of which each bond is a side."""
        joined = self.adjacency()
        return numpy.asarray((joined @ joined)[self.bonds[:, 0], self.bonds[:, 1]]).ravel()

    def tetrahedra(self):
        neighbours = [set() for _ in range(self.particles)]
        for one, other in self.bonds:
            neighbours[one].add(other)
            neighbours[other].add(one)
        count = 0
        for one, other in self.bonds:
            common = sorted(neighbours[one] & neighbours[other])
            count += sum(common[j] in neighbours[common[i]] for i in range(len(common)) for j in range(i))
        return count / 6

    def measures(self):
        """By the names of the index."""
        contacts = numpy.bincount(self.bonds.ravel(), minlength=self.particles)
        sides = self.triangles_of_bonds()
        six = self.adjacency()[contacts >= 6][:, contacts >= 6]
        _, part = scipy.sparse.csgraph.connected_components(six)
        return {"C": contacts.mean(), "triangles": sides.sum() / 3 / self.particles, "tetrahedra": self.tetrahedra() / self.particles,
                "outside": numpy.mean(sides == 0), "three": numpy.mean(contacts >= 3), "six": numpy.mean(contacts >= 6),
                "six_largest": numpy.bincount(part).max() / self.particles if len(part) else 0.0}


def shear_modulus(network, normal, shear):
    """Mean over three planes [Pa], for springs of these stiffnesses [N/m]. Springs act where the spheres touch, and particles turn; turns are
    counted in mean contact lengths."""
    branch, bonds = network.branch, network.bonds
    axis = branch / numpy.linalg.norm(branch, axis=1)[:, None]
    length = numpy.linalg.norm(branch, axis=1).mean()
    spring = shear * numpy.eye(3) + (normal - shear) * axis[:, :, None] * axis[:, None, :]
    turn = numpy.zeros((len(bonds), 3, 3))  # v -> branch x v, over two lengths
    for row, column, of, sign in ((0, 1, 2, -1), (0, 2, 1, 1), (1, 0, 2, 1), (1, 2, 0, -1), (2, 0, 1, -1), (2, 1, 0, 1)):
        turn[:, row, column] = sign * branch[:, of] / (2 * length)
    one = numpy.broadcast_to(numpy.eye(3), turn.shape)
    moved = numpy.concatenate([-one, turn, one, turn], axis=2)
    blocks = numpy.einsum("mai,mab,mbj->mij", moved, spring, moved)
    places = numpy.concatenate([6 * bonds[:, [end]] + numpy.arange(6) for end in (0, 1)], axis=1)
    size = 6 * network.particles
    stiffness = scipy.sparse.csc_matrix((blocks.ravel(), (numpy.repeat(places, 12, axis=1).ravel(), numpy.tile(places, 12).ravel())),
                                        shape=(size, size)) + 1e-12 * normal * scipy.sparse.eye(size, format="csc")  # what nothing holds
    factor = scipy.sparse.linalg.splu(stiffness, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True})
    moduli = []
    for plane in PLANES:
        strain = numpy.zeros((3, 3))
        strain[plane] = strain[plane[::-1]] = 0.5
        affine = branch @ strain
        force = numpy.einsum("mab,mb->ma", spring, affine)
        load = numpy.zeros(size)
        numpy.add.at(load, places.ravel(), numpy.einsum("mai,ma->mi", moved, force).ravel())
        moduli.append((numpy.sum(affine * force) - load @ factor.solve(load)) / network.volume)
    return float(numpy.mean(moduli))
