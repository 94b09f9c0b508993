# SPDX-License-Identifier: GPL-3.0-or-later
"""Consolidation of a layer between plates that it sticks to: Biot's equations by finite elements in radius and height.

    python3 tests/benchmark/diagnosis_campaign/poroelastic.py

prints what the torque shows of it beside 1 - exp(-t / time), time = gap^2 / (12 G mobility), for several plates; also of the inner half of the radius."""

import numpy
import scipy.sparse
import scipy.sparse.linalg

POISSON = 0.25  # of the network without its solvent

SQUARES = lambda x: numpy.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2])
SLOPES = lambda x: numpy.array([x - 0.5, -2 * x, x + 0.5])
LINES = lambda x: numpy.array([(1 - x) / 2, (1 + x) / 2])
LINE_SLOPES = numpy.array([-0.5, 0.5])
POINTS, WEIGHTS = numpy.polynomial.legendre.leggauss(3)


class Layer:
    """Half of the layer, from its middle to the upper plate; lengths over the gap, moduli over G, mobility 1. Displacements are squares in each
    element, pressures lines; those of the network are radial first, then axial."""

    def __init__(self, radius, sticks=True, within=1.0, rings=32, layers=5):
        """@param within part of the radius that the torque is taken of."""
        self.radius = radius
        ends = numpy.linspace(0, 1, rings + 1)
        self.r, self.z = radius * (0.6 * (1 - (1 - ends)**2) + 0.4 * ends), numpy.linspace(0, 0.5, layers + 1)
        self.within = self.r[numpy.argmin(abs(self.r - within * radius))]
        self.high, self.low = 2 * layers + 1, layers + 1
        self.nodes, self.pores = (2 * rings + 1) * self.high, (rings + 1) * self.low
        parts = {name: ([], [], []) for name in ("stiffness", "coupling", "flow")}
        self.seen = numpy.zeros(2 * self.nodes)
        for ring in range(rings):
            for layer in range(layers):
                self.add(parts, ring, layer)
        shapes = {"stiffness": (2 * self.nodes,) * 2, "coupling": (2 * self.nodes, self.pores), "flow": (self.pores,) * 2}
        matrix = {name: scipy.sparse.csr_matrix((values, (rows, columns)), shape=shapes[name]) for name, (rows, columns, values) in parts.items()}
        node = numpy.arange(self.nodes).reshape(-1, self.high)
        fixed = numpy.zeros(2 * self.nodes, bool)
        fixed[node[0]] = fixed[self.nodes + node[:, 0]] = fixed[self.nodes + node[:, -1]] = True  # axis, middle, plate
        fixed[node[:, -1]] |= sticks
        pressed = numpy.zeros(2 * self.nodes)
        pressed[self.nodes + node[:, -1]] = -0.5
        inside = numpy.arange(self.pores) < self.pores - self.low  # no pressure at the rim
        self.free, self.pressed = ~fixed, pressed
        self.stiffness = matrix["stiffness"][self.free][:, self.free]
        self.load = -(matrix["stiffness"] @ pressed)[self.free]
        self.coupling = matrix["coupling"][self.free][:, inside]
        self.squeezed = matrix["coupling"][:, inside].T @ pressed
        self.flow = matrix["flow"][inside][:, inside]

    def add(self, parts, ring, layer):
        """What an element adds: shear modulus 1, solvent that flows by the gradient of its pressure."""
        r, z = self.r[ring:ring + 2], self.z[layer:layer + 2]
        half_r, half_z = (r[1] - r[0]) / 2, (z[1] - z[0]) / 2
        nodes = ((2 * ring + numpy.arange(3))[:, None] * self.high + 2 * layer + numpy.arange(3)).ravel()
        places = numpy.concatenate([nodes, nodes + self.nodes])
        pores = ((ring + numpy.arange(2))[:, None] * self.low + layer + numpy.arange(2)).ravel()
        elastic = numpy.diag([2.0, 2.0, 2.0, 1.0])
        elastic[:3, :3] += 2 * POISSON / (1 - 2 * POISSON)
        stiffness, coupling, flow = numpy.zeros((18, 18)), numpy.zeros((18, 4)), numpy.zeros((4, 4))
        none = numpy.zeros(9)
        for x, first in zip(POINTS, WEIGHTS):
            for y, second in zip(POINTS, WEIGHTS):
                at = r[0] + half_r * (1 + x)
                weight = half_r * half_z * first * second * at
                value = numpy.outer(SQUARES(x), SQUARES(y)).ravel()
                along_r, along_z = numpy.outer(SLOPES(x), SQUARES(y)).ravel() / half_r, numpy.outer(SQUARES(x), SLOPES(y)).ravel() / half_z
                strain = numpy.array([numpy.r_[along_r, none], numpy.r_[value / at, none], numpy.r_[none, along_z], numpy.r_[along_z, along_r]])
                swelling = strain[:3].sum(axis=0)
                pressure = numpy.outer(LINES(x), LINES(y)).ravel()
                gradient = numpy.array([numpy.outer(LINE_SLOPES, LINES(y)).ravel() / half_r, numpy.outer(LINES(x), LINE_SLOPES).ravel() / half_z])
                stiffness += strain.T @ elastic @ strain * weight
                coupling += numpy.outer(swelling, pressure) * weight
                flow += gradient.T @ gradient * weight
                if at < self.within:
                    self.seen[places] -= swelling * weight * at**2 * 8 / self.within**4  # both halves
        for name, block, rows, columns in (("stiffness", stiffness, places, places), ("coupling", coupling, places, pores), ("flow", flow, pores, pores)):
            parts[name][0].extend(numpy.repeat(rows, len(columns)))
            parts[name][1].extend(numpy.tile(columns, len(rows)))
            parts[name][2].extend(block.ravel())

    def course(self, doublings=11, steps=12):
        """Times, and the part by which the volume under the plate has shrunk as the torque weighs it, over the strain of the gap at the start.

        Implicit steps, so many at each length, which doubles from 1/2000 of gap^2 / (12 G mobility)."""
        state, clock, times, shrunk = numpy.zeros(self.free.sum()), 0.0, [0.0], []
        moved = numpy.zeros(len(self.squeezed))
        for doubling in range(-1, doublings):
            step = 1e-9 if doubling < 0 else 2.0**doubling / 2000 / 12
            solver = scipy.sparse.linalg.splu(scipy.sparse.bmat([[self.stiffness, -self.coupling], [-self.coupling.T, -step * self.flow]]).tocsc())
            for _ in range(1 if doubling < 0 else steps):
                solved = solver.solve(numpy.concatenate([self.load, self.squeezed - moved]))
                state, clock = solved[:len(state)], clock + step
                moved = self.coupling.T @ state + self.squeezed
                whole = self.pressed.copy()
                whole[self.free] = state
                times.append(clock)
                shrunk.append(float(self.seen @ whole))
        return numpy.array(times), numpy.array([0.0, *shrunk])


if __name__ == "__main__":
    at = numpy.array([0.1, 0.25, 0.5, 1, 2, 3, 5])
    print("t over the time              ", at)
    print("law                          ", numpy.round(1 - numpy.exp(-at), 4))
    for radius in (4, 8, 16):
        for within in (1.0, 0.5):
            print(f"radius {radius:2} gaps, within {within:3} R  ", numpy.round(numpy.interp(at / 12, *Layer(radius, within=within).course()), 4))
    for radius in (8, 16):  # gap^2 / (12 G mobility) says nothing where plates slide: in times of R^2 / (M mobility)
        times, shrunk = Layer(radius, sticks=False).course(doublings=18)
        print(f"radius {radius:2} gaps, plates slide ", numpy.round(numpy.interp(at * radius**2 / 3 / 2.405**2, times, shrunk), 4))
