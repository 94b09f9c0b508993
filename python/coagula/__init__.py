# SPDX-License-Identifier: GPL-3.0-or-later
"""Random sphere packings and coagulated particle gels: generate, characterize, shear, diagnose.

All quantities are numbers in SI units, or texts with a unit: 2.5e-7 or "0.25um". Options have the names that they have in the program,
with underscores; results have the names that they have in its files and JSON objects.

Examples
--------
>>> import coagula
>>> made = coagula.generate_vem(particles=500, volume_fraction=0.4, radius="0.25um")
>>> pores = coagula.characterize(made)
>>> response = coagula.shear(made, normal_stiffness="100N/m")
>>> print(pores.doh.a, response.storage_modulus.mean)
>>> coagula.write("packing.h5", made, pores, response)
"""

import os as _os
import threading as _threading

# As the program does: threads that wait for each other spin only for some microseconds before they sleep. libgomp reads this once.
if "OMP_WAIT_POLICY" not in _os.environ:
    _os.environ.setdefault("GOMP_SPINCOUNT", "3000")

from ._coagula import Bonds, InputError, Packing, take_newest_blas_kernels as _take_newest_blas_kernels

if _threading.active_count() == 1:  # another thread may be multiplying with the kernels that numpy shares
    _take_newest_blas_kernels()

from ._calls import (calibrate, characterize, compare_heterogeneity, diagnose, find_contacts, fit_degree_of_heterogeneity,
                     fit_power_law, generate_brownian, generate_vem, shear)
from ._datasets import DataSet, open_dataset
from ._files import ExistingFileError, MissingFileError, Structure, parse_quantity, read, write
from ._over_files import Figure, Table, plot, report, table
from ._results import Result
from ._version import version as __version__

__all__ = ["Bonds", "DataSet", "ExistingFileError", "Figure", "InputError", "MissingFileError", "Packing", "Result", "Structure", "Table",
           "calibrate", "characterize", "compare_heterogeneity", "diagnose", "find_contacts", "fit_degree_of_heterogeneity",
           "fit_power_law", "generate_brownian", "generate_vem", "open_dataset", "parse_quantity", "plot", "read", "report", "shear",
           "table", "write"]

InputError.__doc__ = "Input that cannot be used, in one sentence: the object, the value and the rule."
for _public in (Bonds, DataSet, Figure, InputError, Packing, Result, Structure, Table, MissingFileError, ExistingFileError):
    _public.__module__ = "coagula"
del _public
