#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Preconditioners of PETSc on the stiffness matrix of a bonded packing: which ones serve near isostaticity.

    apt-get install python3-petsc4py python3-scipy python3-h5py
    tests/benchmark/petsc_preconditioners.py STRUCTURE.h5 [-ratio 0.1] [options of PETSc, such as -pc_type gamg]

The structure has equal spheres in a rectangular periodic box. The matrix is put together here, by other code than coagula's; six near-null
vectors (translations and rotations) are given by hand. Printed are iterations and seconds of conjugate gradients for the shears yz, xz, xy, down to
1e-4 of the natural norm of the residual, and the shear modulus over k_n / r. What coagula-petsc does is timed beside it by its own options
(coagula shear STRUCTURE.h5 --engine petsc --shear-stiffness ...)."""

import sys
import time

import h5py
import numpy as np
import petsc4py

petsc4py.init(sys.argv)
from petsc4py import PETSc  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402

BOND_TOLERANCE = 0.01


def structure(path):
    """Positions (N, 3) and edge lengths (3), in radii."""
    with h5py.File(path) as file:
        trajectory = file["particles/trajectory"]
        edges = np.array(trajectory["box/edges/value"][-1])
        radius = float(np.mean(trajectory["radius"]))
        return trajectory["position/value"][-1] / radius, (edges if edges.ndim == 1 else np.diag(edges)) / radius


def bonds(positions, edges):
    """Pairs (M, 2) and the vectors that join their centres (M, 3)."""
    positions = np.mod(positions, edges)
    reach = 2 * (1 + BOND_TOLERANCE)
    pairs = cKDTree(positions, boxsize=edges).query_pairs(reach, output_type="ndarray")
    branch = positions[pairs[:, 1]] - positions[pairs[:, 0]]
    return pairs, branch - edges * np.round(branch / edges)


def load_bearing(count, pairs):
    """Which bonds are left when particles with one bond, and chains of two such links, are gone."""
    left = np.ones(len(pairs), bool)
    while True:
        degree = np.bincount(pairs[left].ravel(), minlength=count)
        slack = left & ((degree[pairs] == 1).any(1) | (degree[pairs] == 2).all(1))
        if not slack.any():
            return left
        left &= ~slack


def cross_matrices(vectors):
    matrices = np.zeros((len(vectors), 3, 3))
    for row, column, axis in ((1, 0, 2), (0, 2, 1), (2, 1, 0)):
        matrices[:, row, column] = vectors[:, axis]
        matrices[:, column, row] = -vectors[:, axis]
    return matrices


def along_curve(positions, edges):
    """The order along a Morton curve, so that PETSc's blocks of rows are compact."""
    boxes = np.floor(np.mod(positions, edges) / edges * 1024).astype(np.int64)
    number = sum(((boxes[:, axis] >> bit) & 1) << (3 * bit + axis) for axis in range(3) for bit in range(10))
    return np.argsort(number, kind="stable")


class Network:
    """Stiffness matrix in blocks of six, loads of the six unit strains, and what all particles would store if they followed them."""

    def __init__(self, path, ratio):
        positions, self.edges = structure(path)
        positions = positions[along_curve(positions, self.edges)]
        pairs, branch = bonds(positions, self.edges)
        left = load_bearing(len(positions), pairs)
        kept, ends = np.unique(pairs[left], return_inverse=True)
        self.positions, self.ends, self.branch = positions[kept], ends.reshape(-1, 2), branch[left]
        distance = np.linalg.norm(self.branch, axis=1)
        normal = self.branch / distance[:, None]
        springs = ratio * np.eye(3) + (1 - ratio) * normal[:, :, None] * normal[:, None, :]
        turning = (distance / 2)[:, None, None] * cross_matrices(normal)
        straight = np.broadcast_to(np.eye(3), turning.shape)
        self.motion = [np.concatenate([-straight, turning], 2), np.concatenate([straight, turning], 2)]
        self.matrix = self.assemble(springs)
        self.loads, self.affine = self.strain(springs)

    def assemble(self, springs):
        rows, columns, blocks = [], [], []
        for one, first in enumerate(self.motion):
            for other, second in enumerate(self.motion):
                rows.append(self.ends[:, one])
                columns.append(self.ends[:, other])
                blocks.append(np.einsum("kai,kab,kbj->kij", first, springs, second))
        rows, columns, blocks = np.concatenate(rows), np.concatenate(columns), np.concatenate(blocks)
        order = np.lexsort((columns, rows))
        rows, columns, blocks = rows[order], columns[order], blocks[order]
        first = np.flatnonzero(np.r_[True, (np.diff(rows) != 0) | (np.diff(columns) != 0)])
        blocks = np.add.reduceat(blocks, first)
        start = np.r_[0, np.cumsum(np.bincount(rows[first], minlength=len(self.positions)))].astype(np.int32)
        size = 6 * len(self.positions)
        matrix = PETSc.Mat().createBAIJ(size=((size, size), (size, size)), bsize=6, csr=(start, columns[first].astype(np.int32), blocks))
        matrix = matrix.convert("aij")
        matrix.setBlockSize(6)
        for option in (PETSc.Mat.Option.SPD, PETSc.Mat.Option.SYMMETRIC):
            matrix.setOption(option, True)
        return matrix

    def strain(self, springs):
        x, y, z = self.branch.T
        unit = np.zeros((len(self.branch), 3, 6))
        unit[:, 0, 0], unit[:, 1, 1], unit[:, 2, 2] = x, y, z
        unit[:, 1, 3], unit[:, 2, 3] = z / 2, y / 2
        unit[:, 0, 4], unit[:, 2, 4] = z / 2, x / 2
        unit[:, 0, 5], unit[:, 1, 5] = y / 2, x / 2
        force = springs @ unit
        loads = np.zeros((len(self.positions), 6, 6))
        for end, motion in enumerate(self.motion):
            np.add.at(loads, self.ends[:, end], -np.einsum("kai,kaj->kij", motion, force))
        return loads.reshape(-1, 6), np.einsum("kai,kaj->ij", unit, force)

    def near_null_space(self):
        motions = np.zeros((6, len(self.positions), 6))
        away = self.positions - self.positions.mean(0)
        for axis, unit in enumerate(np.eye(3)):
            motions[axis, :, axis] = 1
            motions[3 + axis, :, :3], motions[3 + axis, :, 3:] = np.cross(unit, away), unit
        orthonormal, _ = np.linalg.qr(motions.reshape(6, -1).T)
        return PETSc.NullSpace().create(vectors=[PETSc.Vec().createWithArray(vector.copy()) for vector in orthonormal.T])


def main():
    options = PETSc.Options()
    network = Network(sys.argv[1], options.getReal("ratio", 0.1))
    # Local parts and coarse levels of a matrix with floppy modes are singular without a shift.
    shifted = network.matrix.copy()
    shifted.shift(options.getReal("shift", 1e-6))
    shifted.setBlockSize(6)
    shifted.setNearNullSpace(network.near_null_space())
    solver = PETSc.KSP().create()
    solver.setOperators(network.matrix, shifted)
    solver.setType("cg")
    solver.setNormType(PETSc.KSP.NormType.NATURAL)
    solver.setTolerances(rtol=1e-4, max_it=5000)
    solver.setFromOptions()
    begin = time.perf_counter()
    solver.setUp()
    setup = time.perf_counter() - begin
    iterations, moduli, solution = [], [], network.matrix.createVecRight()
    for strain in (3, 4, 5):
        load = network.matrix.createVecLeft()
        load.setArray(network.loads[:, strain].copy())
        solver.solve(load, solution)
        iterations.append(solver.getIterationNumber())
        moduli.append((network.affine[strain, strain] - network.loads[:, strain] @ solution.getArray()) / network.edges.prod())
    print(f"{len(network.positions)} particles, {solver.getPC().getType()}: iterations {iterations}, set-up {setup:.1f} s, "
          f"in all {time.perf_counter() - begin:.1f} s, G' = {np.mean(moduli):.6g} k_n/r")


if __name__ == "__main__":
    main()
