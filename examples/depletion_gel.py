# SPDX-License-Identifier: GPL-3.0-or-later
"""Gels by depletion: a deeper attraction makes stiffer bonds and a stiffer gel, and a shallow one makes none."""

import coagula

print("depth [kT]  bond [uN/m]  coordination  axes  G' [mPa]")
for depth in (2, 6, 10):
    gel = coagula.generate_brownian(law="depletion", depth=depth, size_ratio=0.1, radius="0.5um", particles=300, volume_fraction=0.2,
                                    stop_time="1s")
    bond = gel.potential.bond_stiffness
    # Two particles in series make a bond; it resists sliding a tenth as much as pulling.
    response = coagula.shear(gel, stiffness_from="potential", shear_stiffness=0.1 * 2 * bond)
    print(f"{depth:10}  {1e6 * bond:11.1f}  {gel.coordination:12.2f}  {gel.series.percolating_axes[-1]:4}  {1e3 * response.storage_modulus.mean:8.3g}")
