# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates from elsewhere, here a crystal with vacancies: its contacts, its pores and its modulus."""

import numpy as np

import coagula

diameter = 1e-6  # [m]
cells = 5
edge = diameter * np.sqrt(2)  # of the cubic cell of a face-centred lattice whose spheres touch
corners = np.stack(np.meshgrid(*3 * [np.arange(cells)], indexing="ij"), axis=-1).reshape(-1, 1, 3)
sites = edge * (corners + np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])).reshape(-1, 3)
occupied = np.random.default_rng(1).random(len(sites)) > 0.1

packing = coagula.Packing(sites[occupied], diameter / 2, box=cells * edge)
print(packing)
print(f"coordination {coagula.find_contacts(packing).coordination:.2f}, of the full lattice 12, expected {12 * occupied.mean():.2f}")
print(f"heterogeneity a {coagula.characterize(packing, only='doh').doh.a:.3f}")
print(f"G' {coagula.shear(packing).storage_modulus.mean / 1e6:.1f} MPa")
