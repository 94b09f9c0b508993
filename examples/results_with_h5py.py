# SPDX-License-Identifier: GPL-3.0-or-later
"""Every number of a result file by h5py alone, with its unit."""

import h5py

import coagula

made = coagula.generate_vem(particles=300, volume_fraction=0.4, radius="0.25um")
coagula.write("numbers.h5", made, coagula.characterize(made, only=["coordination", "doh"]), overwrite=True)


def show(path, value):
    if isinstance(value, h5py.Dataset) and value.shape == () and value.dtype.kind in "if":
        unit = value.attrs.get("unit", b"1").decode()
        print(f"{path}: {value[()]:g}" + (f" {unit}" if unit != "1" else ""))


with h5py.File("numbers.h5") as file:
    file.visititems(show)
