# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear moduli of a network of central springs by LAMMPS: shear the cell by a little, minimise the energy, read the stress."""

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
