# SPDX-License-Identifier: GPL-3.0-or-later
"""Data sets of many structures: what `coagula dataset run` writes."""

import errno
import os
import tempfile

from . import _coagula
from ._files import MissingFileError, read, with_kind


class DataSet:
    """A data set: its index as columns, its card, and its structures. coagula.open_dataset opens one."""

    def __init__(self, path, card, sweep, provenance, columns):
        self._path, self._card, self._sweep, self._provenance = path, card, sweep, provenance
        self._columns = {name: (values, unit, description) for name, values, unit, description in columns}

    @property
    def card(self):
        """Title, authors, licence and what else describes the set, a dictionary of texts."""
        return dict(self._card)

    @property
    def sweep(self):
        """The text of the sweep file."""
        return self._sweep

    @property
    def provenance(self):
        """Version of the program, name and SHA-256 of the sweep file, a dictionary of texts."""
        return dict(self._provenance)

    def table(self):
        """The index: a dictionary of arrays by the names of the columns, equally long; pandas.DataFrame takes it as it stands."""
        return {name: values for name, (values, _, _) in self._columns.items()}

    def unit(self, path):
        """The unit of a column by its name, "1" for plain numbers and texts."""
        return self._columns[path][1]

    def description(self, path):
        """The meaning of a column by its name."""
        return self._columns[path][2]

    def structures(self):
        """The ids of the structures that the set holds; none where it was made with --no-structures."""
        return _coagula.structures_in_set(self._path)

    def structure(self, id):
        """One structure with its results, as coagula.read returns it. Raises coagula.InputError where the set does not hold it."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "structure.h5")
            _coagula.extract_structure(self._path, str(id), path, False)
            return read(path)

    def __len__(self):
        return len(self._columns["id"][0])

    def __repr__(self):
        title = self._card.get("title", "")
        return f"<DataSet{' ' + repr(title) if title else ''} of {len(self)} structures, {len(self._columns)} columns>"


def open_dataset(path: "str | PathLike[str]") -> "DataSet":
    """The data set in a file that `coagula dataset run` has written.

    Parameters
    ----------
    path : str | PathLike
        The file, such as set.h5.

    Raises coagula.MissingFileError (also a FileNotFoundError) when there is no such file, and coagula.InputError (also a ValueError) for
    one that is no data set.
    """
    name = os.fspath(path)
    try:
        return DataSet(name, *_coagula.read_set(name))
    except _coagula.InputError as error:
        if not os.path.lexists(name):
            raise with_kind(error, name, MissingFileError, errno.ENOENT) from None
        raise
