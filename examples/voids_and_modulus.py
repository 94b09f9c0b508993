# SPDX-License-Identifier: GPL-3.0-or-later
"""Fewer voids make a packing more heterogeneous at the same volume fraction; does it become stiffer? Three seeds for each number of voids."""

import numpy as np

import coagula

print("voids  heterogeneity a     G' [MPa]")
for voids in (500, 200, 100):
    heterogeneity, modulus = [], []
    for seed in (1, 2, 3):
        made = coagula.generate_vem(particles=500, voids=voids, volume_fraction=0.4, radius="0.25um", seed=seed)
        heterogeneity.append(coagula.characterize(made, only="doh").doh.a)
        modulus.append(coagula.shear(made).storage_modulus.mean / 1e6)
    error = np.std(modulus, ddof=1) / np.sqrt(len(modulus))
    print(f"{voids:5}  {np.mean(heterogeneity):15.3f}  {np.mean(modulus):5.2f} +- {error:.2f}")
