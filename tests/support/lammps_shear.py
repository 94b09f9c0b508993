# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear moduli of bonded networks by LAMMPS: shear the cell by a little, bring the network to rest, read the stress."""

import math
import os
import subprocess

PLANES = ("xy", "xz", "yz")

# The forces are brought to rest down to this much of a spring stretched by the shear over one radius.
FORCE_TOLERANCE = 1e-5

START = """
units lj
atom_style bond
pair_style zero {reach}
bond_style harmonic
special_bonds lj 1 1 1
read_data network.data
pair_coeff * *
compute stress all pressure NULL virial
thermo_style custom step pe fnorm c_stress[4] c_stress[5] c_stress[6]
thermo_modify norm no
min_style cg
min_modify line quadratic
"""

SHEAR = """
clear
{start}
change_box all {plane} delta {displacement!r} remap units box
variable stress equal c_stress[{component}]
run 0
print "STRESS {plane} {strain!r} affine $(v_stress:%.17g)"
minimize 0 {force_tolerance!r} 100000 1000000
print "STRESS {plane} {strain!r} relaxed $(v_stress:%.17g)"
"""


def network_text(network):
    """LAMMPS data: one bond type per bond, so that each is at rest at its present length; E = K (r - r0)^2, so K = 1/2."""
    lines = ["central springs at rest", "", f"{len(network.positions)} atoms", "1 atom types", f"{len(network.bonds)} bonds",
             f"{len(network.bonds)} bond types", ""]
    lines += [f"0 {network.edge!r} {axis}lo {axis}hi" for axis in "xyz"] + ["0 0 0 xy xz yz", "", "Masses", "", "1 1"]
    lines += ["", "Bond Coeffs", ""]
    lines += [f"{number} 0.5 {distance!r}" for number, (_, _, distance) in enumerate(network.bonds, 1)]
    lines += ["", "Atoms # bond", ""]
    lines += [f"{number} 1 1 {x!r} {y!r} {z!r}" for number, (x, y, z) in enumerate(network.positions, 1)]
    lines += ["", "Bonds", ""]
    lines += [f"{number} {number} {i + 1} {j + 1}" for number, (i, j, _) in enumerate(network.bonds, 1)]
    return "\n".join(lines) + "\n"


def run(folder, text):
    """LAMMPS on one thread in that folder; what it wrote to standard output."""
    (folder / "in.lammps").write_text(text)
    done = subprocess.run(["lmp", "-in", "in.lammps", "-nocite", "-log", "none"], cwd=folder, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, env={**os.environ, "OMP_NUM_THREADS": "1"}, timeout=300)
    if done.returncode != 0:
        raise RuntimeError(f"LAMMPS failed: {done.stdout[-1000:]} {done.stderr[-1000:]}")
    return done.stdout


def shear_moduli(folder, network, strain):
    """{"affine": {"xy": G, ...}, "relaxed": {...}}: from the strains of both signs, each applied to the network at rest."""
    (folder / "network.data").write_text(network_text(network))
    start = START.format(reach=max(distance for _, _, distance in network.bonds) + 0.1)
    text = "".join(
        SHEAR.format(start=start, plane=plane, component=4 + PLANES.index(plane), strain=signed, displacement=signed * network.edge,
                     force_tolerance=FORCE_TOLERANCE * strain)
        for plane in PLANES for signed in (strain, -strain))
    stress = {}
    for line in run(folder, text).splitlines():
        if line.startswith("STRESS "):
            _, plane, signed, state, value = line.split()
            stress[state, plane, float(signed)] = float(value)
    # `pressure` is positive in compression: the shear stress is its negative.
    return {state: {plane: (stress[state, plane, -strain] - stress[state, plane, strain]) / (2 * strain) for plane in PLANES}
            for state in ("affine", "relaxed")}


# Bonds that resist sliding. Debian's LAMMPS has no such bond, but its energy, k_n/2 along the bond and k_s/2 across it, is that of a
# central spring k_n - k_s between the centres and of an isotropic spring k_s at the contact point, which holds together a point of each
# particle. Particles are rigid bodies of a centre and such points, and come to rest by a viscous drag.
CENTRE, POINT, RATTLER = 1, 2, 3  # types of atoms

SETTLE = """
units lj
atom_style bond
comm_modify cutoff 4
bond_style harmonic
read_data bodies.data
group bodies type 1 2
fix turn bodies rigid/small molecule
fix drag bodies viscous 0.02
neighbor 0.3 bin
compute stress all pressure NULL virial
variable stress equal c_stress[{component}]
thermo_style custom step c_stress[{component}]
thermo {steps}
timestep 0.3
run {steps}
print "STRESS $(v_stress:%.17g)"
"""


class ShearedCell:
    """A cube sheared by a small strain: places move along the first axis of the plane in proportion to the second."""

    def __init__(self, edge, plane, strain):
        self.edge, self.plane, self.strain = edge, plane, strain
        self.along, self.across = ("xyz".index(axis) for axis in plane)

    def moved(self, place):
        place = list(place)
        place[self.along] += self.strain * place[self.across]
        return place

    def row(self, place):
        """The place inside the cell and how often it was carried over each edge, by which LAMMPS puts bodies together."""
        place, turns = list(place), [0, 0, 0]
        for axis in (self.across, *(axis for axis in range(3) if axis != self.across)):
            lean = self.strain * place[self.across] if axis == self.along else 0
            turns[axis] = math.floor((place[axis] - lean) / self.edge)
            place[axis] -= turns[axis] * self.edge
            if axis == self.across:
                place[self.along] -= turns[axis] * self.edge * self.strain
        return " ".join(repr(value) for value in place + turns)

    def head(self):
        tilts = " ".join(repr(self.strain * self.edge if plane == self.plane else 0.0) for plane in PLANES)
        return [f"0 {self.edge!r} {axis}lo {axis}hi" for axis in "xyz"] + [f"{tilts} xy xz yz"]


def bodies_text(network, shear_stiffness, cell):
    """LAMMPS data; stiffnesses in the normal stiffness of a contact. Molecules are bodies."""
    bonded = {end for i, j, _ in network.bonds for end in (i, j)}
    centres = [cell.moved(place) for place in network.positions]
    atoms = [(number + 1, CENTRE, place) if number in bonded else (0, RATTLER, place) for number, place in enumerate(centres)]
    types = [(shear_stiffness / 2, 0.0)]
    bonds = []
    for i, j, distance in network.bonds:
        half = [math.remainder(b - a, network.edge) / 2 for a, b in zip(network.positions[i], network.positions[j])]
        types.append(((1 - shear_stiffness) / 2, distance))
        bonds.append((len(types), i + 1, j + 1))
        atoms.append((i + 1, POINT, [place + step for place, step in zip(centres[i], half)]))
        atoms.append((j + 1, POINT, [place - step for place, step in zip(centres[j], half)]))
        bonds.append((1, len(atoms) - 1, len(atoms)))
    lines = ["particles as rigid bodies", "", f"{len(atoms)} atoms", "3 atom types", f"{len(bonds)} bonds", f"{len(types)} bond types", "",
             *cell.head(), "", "Masses", "", "1 1", "2 0.2", "3 1", "", "Bond Coeffs", ""]
    lines += [f"{number} {stiffness!r} {length!r}" for number, (stiffness, length) in enumerate(types, 1)]
    lines += ["", "Atoms # bond", ""]
    lines += [f"{number} {body} {kind} {cell.row(place)}" for number, (body, kind, place) in enumerate(atoms, 1)]
    lines += ["", "Bonds", "", *(f"{number} {kind} {i} {j}" for number, (kind, i, j) in enumerate(bonds, 1))]
    return "\n".join(lines) + "\n"


def modulus_with_sliding(folder, network, shear_stiffness, plane, strain=1e-6, steps=10000):
    """The shear modulus in one plane; no stress without a strain, and linear in it."""
    (folder / "bodies.data").write_text(bodies_text(network, shear_stiffness, ShearedCell(network.edge, plane, strain)))
    output = run(folder, SETTLE.format(component=4 + PLANES.index(plane), steps=steps))
    (stress,) = (float(line.split()[1]) for line in output.splitlines() if line.startswith("STRESS "))
    return -stress / strain
