# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of result files: figures, pages and tables."""

import contextlib
import errno
import json
import os
import re
import tempfile

import numpy as np

from . import _coagula
from ._calls import REQUIRED
from ._files import ExistingFileError, MissingFileError, with_kind
from ._options import documented, values
from ._results import Result, from_entries, from_json

_FILES = ("files", "str | PathLike[str] | Sequence[str | PathLike[str]]", REQUIRED, "One file, or several.")
_OVERWRITE = ("overwrite", "bool", False, "Replace existing files; otherwise coagula.ExistingFileError is raised.")


class Figure(Result):
    """A figure that was drawn: .figure, .caption, .series; a notebook shows it when it was not written to a file."""

    _svg = None

    @property
    def svg(self):
        """The picture as SVG text, or None where it went to a file."""
        return self._svg

    def _repr_svg_(self):
        return self._svg


class Table(Result):
    """Columns over files, arrays with one value for each file: .file, .volume_fraction, .characterization.doh.a ..."""

    def columns(self):
        """The columns by the headings of `coagula info --csv`, with their units: for pandas.DataFrame, or for csv."""
        return {path if self.unit(path) == "1" else f"{path} [{self.unit(path)}]": self[path] for path in self.paths()}


def _names(files):
    names = [os.fspath(files)] if isinstance(files, (str, os.PathLike)) else [os.fspath(name) for name in files]
    if not names:
        raise _coagula.InputError("files is empty: give at least one")
    return names


@contextlib.contextmanager
def _file_errors(names):
    """Errors about files that are missing, or that are there already, are those of Python as well."""
    try:
        yield
    except _coagula.InputError as error:
        missing = next((name for name in names if not os.path.lexists(name)), None)
        if missing is not None:
            raise with_kind(error, missing, MissingFileError, errno.ENOENT) from None
        there = re.match(r"(.*) (?:exists|is there) already;", str(error))
        if there:
            raise with_kind(error, there[1], ExistingFileError, errno.EEXIST) from None
        raise


def _written(verb, names, output, overwrite, options):
    given = {"input": names, "output": os.fspath(output), "force": bool(overwrite), **values(verb, options)}
    with _file_errors(names):
        return json.loads(getattr(_coagula, verb)(given))


@documented("plot", first=[_FILES], replaced=["output", "force"], returns="Figure", common=False, extra=[
    ("output", "str | PathLike[str] | None", None,
     "The picture, its format by the ending .svg, .png or .pdf, or a folder with paper; kept in memory as SVG when None."),
    _OVERWRITE])
def plot(files, *, output=None, overwrite=False, **options):
    """Returns a coagula.Figure with .caption and .series. Without output it holds the picture, which a notebook shows: .svg.

    Raises coagula.InputError when a file lacks the results that the figure shows, with the command that computes them.
    """
    names = _names(files)
    if output is not None:
        return from_json(_written("plot", names, output, overwrite, options), "Figure", Figure)
    if options.get("paper"):
        raise _coagula.InputError("paper needs output, the folder for the figures of the paper (see help(coagula.plot))")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "figure.svg")
        found = _written("plot", names, path, overwrite, options)
        with open(path, encoding="utf-8") as file:
            picture = file.read()
    del found["output"]
    figure = from_json(found, "Figure", Figure)
    figure._svg = picture
    return figure


@documented("report", first=[_FILES, ("output", "str | PathLike[str]", REQUIRED, "The page to write, such as report.html.")],
            replaced=["output", "force"], returns="Result", common=False, extra=[_OVERWRITE])
def report(files, output, *, overwrite=False, **options):
    """Returns the number of structures and the size of the page: .structures, .bytes."""
    return from_json(_written("report", _names(files), output, overwrite, options), "Report")


def _column(name, cells):
    """Whole numbers, numbers with NaN for an empty cell, True and False, or texts."""
    if name != "file":
        if all(cell in ("true", "false") for cell in cells):
            return np.array([cell == "true" for cell in cells])
        for kind, convert in ((np.int64, int), (float, lambda cell: float(cell or "nan"))):
            with contextlib.suppress(ValueError, OverflowError):
                return np.array([convert(cell) for cell in cells], dtype=kind)
    return np.array(cells)


def table(files: "str | PathLike[str] | Sequence[str | PathLike[str]]") -> "Table":
    """All single values of result files as columns over the files, as `coagula info --csv` prints them.

    Parameters
    ----------
    files : str | PathLike | sequence of these
        HDF5 files of coagula.

    Returns a coagula.Table: table.volume_fraction and table["characterization/doh/a"] are arrays with one value for each file, in the
    order of the files. A number that a file does not have is NaN, a text is empty. table.unit(path) is the unit, and
    pandas.DataFrame(table.columns()) has the units in its headings.

    Raises coagula.MissingFileError (also a FileNotFoundError) when there is no such file, and coagula.InputError (also a ValueError) for
    one that cannot be read.
    """
    names = _names(files)
    with _file_errors(names):
        headings, *rows = _coagula.table(names)
    entries = []
    for heading, cells in zip(headings, zip(*rows)):
        name, unit = re.fullmatch(r"(.*?)(?: \[(.*)\])?", heading).groups()
        entries.append((name, _column(name, cells), unit or "1", ""))
    return from_entries(entries, "Table", Table)
