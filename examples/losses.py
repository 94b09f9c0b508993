# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts with a Maxwell element beside their spring: storage and loss modulus over the frequency."""

import coagula

made = coagula.generate_vem(particles=500, volume_fraction=0.4, radius="0.25um")
model = {"normal_maxwell_stiffness": "50N/m", "normal_maxwell_time": "50ms"}
swept = coagula.shear(made, frequency_sweep="0.1Hz:100Hz:7", model=model)
print("frequency [Hz]  G' [MPa]  G'' [MPa]")
for frequency, storage, loss in zip(swept.frequency, swept.storage_modulus.mean, swept.loss_modulus.mean):
    print(f"{frequency:14.3g}  {storage / 1e6:8.3f}  {loss / 1e6:9.4f}")
