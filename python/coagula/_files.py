"""Files: HDF5 files of coagula, and the text formats."""

import errno
import os

from . import _coagula
from ._calls import packing_of
from ._options import call_text, words
from ._results import Generated, Result, Stage, from_entries


class _FileError(_coagula.InputError):
    def __str__(self):
        return str(self.args[0])  # the sentence, without the number and the name that OSError would add


class MissingFileError(_FileError, FileNotFoundError):
    """There is no such file."""


class ExistingFileError(_FileError, FileExistsError):
    """A file is there already, and overwrite=True was not given."""


def _with_kind(error, path, kind, number):
    better = kind(str(error))
    better.errno, better.filename = number, path
    return better


class Structure(Result):
    """A structure from a file with the results that the file holds: .packing, .bonds, .characterization, .mechanics.linear ..."""

    _bonds = None
    _time = 0.0
    _history = ()

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
    def history(self):
        """One dictionary for each stage, oldest first: stage, command_line, options, seed, version, time, seconds, positions_sha256."""
        return list(self._history)


def _structure(packing, bonds=None, time=0.0, entries=(), history=()):
    structure = from_entries(entries, "Structure", Structure)
    structure._packing, structure._bonds, structure._time, structure._history = packing, bonds, time, history
    return structure


def read(path: "str | PathLike[str]", *, format: "Literal['csv', 'extxyz', 'lammps'] | None" = None, radius: "float | str | None" = None,
         box: "float | str | Sequence[float | str] | None" = None, open: "bool" = False, length_unit: "float | str | None" = None,
         wrap: "bool" = False) -> "Structure":
    """Read a structure: an HDF5 file of coagula, or coordinates as CSV, extended XYZ or LAMMPS data.

    Parameters
    ----------
    path : str | PathLike
        .h5, or a text file.
    format : "csv", "extxyz" or "lammps", default None
        Of a text file; by its ending when None.
    radius : float | str, default None
        Radius of every particle [m]; a column of the text file when None.
    box : float | str | three of them, default None
        Edge lengths of the periodic box [m], where the text file names none.
    open : bool, default False
        The set has a free surface: no periodic box.
    length_unit : float | str, default None
        Length of one unit of columns that name none [m]: "1um".
    wrap : bool, default False
        Bring particles outside the periodic box back in; otherwise they are an error.

    Returns a coagula.Structure. Raises coagula.MissingFileError (also a FileNotFoundError) when there is no such file, and
    coagula.InputError (also a ValueError) for one that cannot be read.
    """
    name = os.fspath(path)
    options = {"format": format, "radius": radius, "box": box, "open": open, "length_unit": length_unit, "wrap": wrap}
    is_text = format is not None or not name.lower().endswith((".h5", ".hdf5", ".h5md"))
    try:
        if is_text:
            return _structure(_coagula.import_text([name, *words("import", {**options, "output": "none"})]))
        if any(value not in (None, False) for value in options.values()):
            raise TypeError("format, radius, box, open, length_unit and wrap are for text files; an HDF5 file says all that itself")
        return _structure(*_coagula.read_file(name))
    except _coagula.InputError as error:
        if not os.path.lexists(name):
            raise _with_kind(error, name, MissingFileError, errno.ENOENT) from None
        raise


def write(path: "str | PathLike[str]", packing: "Packing | Generated | Structure", *results: "Stage", bonds: "Bonds | None" = None,
          overwrite: "bool" = False) -> "None":
    """Write a structure, and what stages found of it, as the program does.

    Parameters
    ----------
    path : str | PathLike
        .h5 for a file that holds everything; .csv, .xyz, .extxyz, .data, .lmp or .lammps for the coordinates (and bonds, in LAMMPS
        data) alone.
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
            _coagula.write_text(name, packing, bonds, overwrite)
        else:
            _coagula.write_file(name, packing, bonds, stages, call_text("write", [repr(name), "packing"], {}), overwrite)
    except _coagula.InputError as error:
        if os.path.lexists(name) and not overwrite:
            raise _with_kind(error, name, ExistingFileError, errno.EEXIST) from None
        raise


def parse_quantity(text: "str | float", unit: "str") -> "float":
    """The number of `unit` in a text such as "0.25um": parse_quantity("0.25um", "m") is 2.5e-7. A bare number is in `unit`."""
    return _coagula.parse_quantity(str(text), unit)
