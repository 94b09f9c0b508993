# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: HDF5 files of coagula, and the text formats."""

import errno
import os

from . import _coagula
from ._calls import REQUIRED, packing_of
from ._options import call_text, documented, values
from ._results import Generated, Result, Stage, from_entries


class _FileError(_coagula.InputError):
    def __str__(self):
        return str(self.args[0])  # the sentence, without the number and the name that OSError would add


class MissingFileError(_FileError, FileNotFoundError):
    """There is no such file."""


class ExistingFileError(_FileError, FileExistsError):
    """A file is there already, and overwrite=True was not given."""


def with_kind(error, path, kind, number):
    """The same sentence as an error of another kind, with the number and the name that an OSError has."""
    better = kind(str(error))
    better.errno, better.filename = number, path
    return better


class Structure(Result):
    """A structure from a file with the results that the file holds: .packing, .bonds, .characterization, .mechanics.linear ..."""

    _bonds = None
    _time = 0.0
    _history = ()
    _frames = ()

    @property
    def packing(self):
        """The packing (coagula.Packing)."""
        return self._packing

    @property
    def bonds(self):
        """The bonds (coagula.Bonds), or None."""
        return self._bonds

    @property
    def time(self):
        """Time of the positions [s]."""
        return self._time

    @property
    def frames(self):
        """Earlier frames of a trajectory from another program: pairs of a time [s] and an array (N, 3) [m]."""
        return list(self._frames)

    @property
    def history(self):
        """One dictionary for each stage, oldest first: stage, command_line, options, seed, version, time, seconds, positions_sha256."""
        return list(self._history)


def _structure(packing, bonds=None, time=0.0, entries=(), history=(), frames=()):
    structure = from_entries(entries, "Structure", Structure)
    structure._packing, structure._bonds, structure._time, structure._history, structure._frames = packing, bonds, time, history, frames
    return structure


@documented("import", replaced=["output", "force"], returns="Structure", common=False, first=[
    ("path", "str | PathLike[str]", REQUIRED, "An HDF5 file of coagula (.h5), or a file of another program.")])
def read(path, **options):
    """Reads an HDF5 file of coagula, too: with its results, and without options. With options an HDF5 file is H5MD of another program.
    Returns a coagula.Structure.

    Raises coagula.MissingFileError (also a FileNotFoundError) when there is no such file, and coagula.InputError (also a ValueError) for
    one that cannot be read.
    """
    name = os.fspath(path)
    given = values("import", options)
    try:
        if given or not name.lower().endswith((".h5", ".hdf5", ".h5md")):
            packing, bonds, time, frames = _coagula.import_structure({"input": name, "output": "none", **given})
            return _structure(packing, bonds, time, frames=frames)
        return _structure(*_coagula.read_file(name))
    except _coagula.InputError as error:
        if not os.path.lexists(name):
            raise with_kind(error, name, MissingFileError, errno.ENOENT) from None
        raise


def write(path: "str | PathLike[str]", packing: "Packing | Generated | Structure", *results: "Stage", bonds: "Bonds | None" = None,
          overwrite: "bool" = False) -> "None":
    """Write a structure, and what stages found of it, as the program does.

    Parameters
    ----------
    path : str | PathLike
        .h5 for a file that holds everything; .csv, .extxyz, .data, .dump, .gsd or .vtp for the coordinates (and bonds, in LAMMPS data
        and VTK) alone.
    packing : Packing | Generated | Structure
        The packing, or something that has one.
    *results : what characterize and shear returned for this packing.
    bonds : Bonds, default None
        Of the packing; those of a generator or a file when None.
    overwrite : bool, default False
        Replace an existing file; otherwise coagula.ExistingFileError (also a FileExistsError) is raised.
    """
    name = os.fspath(path)
    owner = packing
    packing = packing_of(packing)
    bonds = bonds if bonds is not None else getattr(owner, "bonds", None)
    stages = [result._stage for result in results if isinstance(result, Stage)]
    if len(stages) != len(results) or None in stages:
        raise TypeError("results are what characterize and shear return, in the process in which they were computed")
    if isinstance(owner, Generated) and owner._stage is not None:
        stages.insert(0, owner._stage)
    try:
        if not name.lower().endswith((".h5", ".hdf5", ".h5md")):
            if results:
                raise TypeError("a text file holds coordinates only: give results with a name that ends in .h5")
            _coagula.export_structure(name, packing, bonds, overwrite)
        else:
            _coagula.write_file(name, packing, bonds, stages, call_text("write", [repr(name), "packing"], {}), overwrite)
    except _coagula.InputError as error:
        if os.path.lexists(name) and not overwrite:
            raise with_kind(error, name, ExistingFileError, errno.EEXIST) from None
        raise


def parse_quantity(text: "str | float", unit: "str") -> "float":
    """The number of `unit` in a text such as "0.25um": parse_quantity("0.25um", "m") is 2.5e-7. A bare number is in `unit`."""
    return _coagula.parse_quantity(str(text), unit)
