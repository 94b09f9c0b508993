# SPDX-License-Identifier: GPL-3.0-or-later
"""What a stage finds: values as attributes, each with its unit and its meaning."""

import functools
import keyword

import numpy as np

from ._spelling import in_python


def _short(value):
    if isinstance(value, np.ndarray):
        return f"array {value.shape}" if value.size > 6 else np.array2string(value, precision=5, separator=", ")
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list):
        return f"list of {len(value)}"
    return str(value)


class Result:
    """Values as attributes, in groups: result.storage_modulus.mean. Numbers are in SI units.

    The same names lead there as paths, as in the file: result["storage_modulus/mean"]. unit(path) and description(path) say what a
    value is, and help(result) lists all of them. Arrays are read-only views of what the stage computed, without a copy; take
    numpy.array(...) of one to change it. `flat()` has all single numbers and texts by path, such as for a row of a table; `to_dict()`
    is made of nested dictionaries.
    """

    _packing = None
    _stage = None

    def __init__(self, values, units=None, descriptions=None):
        self._values = values  # a Result for a group
        self._units = units or {}
        self._descriptions = descriptions or {}

    def _parent_of(self, path):
        group, found, name = str(path).rpartition("/")
        return (self[group], name) if found else (self, name)

    def __getitem__(self, path):
        value = self
        for name in str(path).split("/"):
            if not isinstance(value, Result) or name not in value._values:
                raise KeyError(path)
            value = value._values[name]
        return value

    def __getattr__(self, name):
        values = self.__dict__.get("_values", {})
        if name in values:
            return values[name]
        known = ", ".join(values)
        raise AttributeError(f"there is no '{name}' here: {known}" if known else f"there is no '{name}' here")

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __contains__(self, path):
        try:
            self[path]
        except KeyError:
            return False
        return True

    def keys(self):
        """Names of the values and groups here."""
        return self._values.keys()

    def unit(self, path):
        """Unit of a value, "1" for a pure number and for a text; UDUNITS text."""
        group, name = self._parent_of(path)
        group[name]
        return group._units.get(name, "1")

    def description(self, path):
        """What a value is."""
        group, name = self._parent_of(path)
        group[name]
        return group._descriptions.get(name, "")

    def paths(self):
        """Paths of all values, groups apart."""
        for name, value in self._values.items():
            if isinstance(value, Result):
                yield from (f"{name}/{rest}" for rest in value.paths())
            else:
                yield name

    def flat(self):
        """Single numbers and texts by path: {"storage_modulus/mean": ...}."""
        return {path: self[path] for path in self.paths() if isinstance(self[path], (bool, int, float, str))}

    def to_dict(self):
        """Nested dictionaries, arrays as lists: what `json.dump` takes."""
        return {name: value.to_dict() if isinstance(value, Result) else value.tolist() if isinstance(value, np.ndarray) else value
                for name, value in self._values.items()}

    def _tree(self):
        return {name: value._tree() if isinstance(value, Result) else (value, self._units.get(name, "1"), self._descriptions.get(name, ""))
                for name, value in self._values.items()}

    def __reduce__(self):
        """A copy for another process has the values and the packing, but cannot be written to a file any more."""
        base = next(kind for kind in type(self).__mro__ if kind in (Generated, Stage, Result))
        return _restored, (self._tree(), type(self).__name__, base, self._packing)

    def _lines(self):
        for path in self.paths():
            unit = self.unit(path)
            yield path, _short(self[path]) + ("" if unit in ("1", "") else " " + unit), self.description(path)

    def __repr__(self):
        lines = list(self._lines())
        width = max((len(path) for path, _, _ in lines), default=0)
        title = type(self).__name__ if self._packing is None else f"{type(self).__name__}, {self._packing!r}"
        return "\n".join([title, *(f"  {path:<{width}}  {value}" for path, value, _ in lines)])

    def _repr_html_(self):
        from html import escape

        rows = "".join(f"<tr><td>{escape(path)}</td><td>{escape(value)}</td><td style='text-align:left'>{escape(about)}</td></tr>"
                       for path, value, about in self._lines())
        return f"<table><tr><th>{type(self).__name__}</th><th>value</th><th>meaning</th></tr>{rows}</table>"


class Stage(Result):
    """What one call of a stage found."""

    @property
    def bonds(self):
        """The bonds of the stage (coagula.Bonds), or None."""
        return None if self._stage is None else self._stage.bonds

    @property
    def notes(self):
        """Sentences that one should know about the result."""
        return [] if self._stage is None else [in_python(note) for note in self._stage.notes]


class Generated(Stage):
    """A structure that a generator made, and what is known of it."""

    @property
    def packing(self):
        """The packing (coagula.Packing)."""
        return self._packing

    @property
    def frames(self):
        """Positions at earlier times: pairs of a time [s] and an array (N, 3) [m]."""
        return [] if self._stage is None else self._stage.frames


def _documented(unit, description):
    return f"{description or 'value'}" + ("" if unit in ("1", "") else f" [{unit}]")


@functools.lru_cache(maxsize=256)
def _class_of(name, base, values):
    """A class whose attributes are documented: help(result) lists them with their units."""
    def attribute(key, about):
        def get(self):
            return self._values[key]
        return property(get, doc=about)

    members = {key: attribute(key, about) for key, about in values
               if key.isidentifier() and not keyword.iskeyword(key) and not hasattr(base, key)}
    about = "\n".join([base.__doc__.split("\n")[0], "", *(f"{key}: {about}" for key, about in values)])
    return type(name, (base,), {**members, "__doc__": about, "__module__": "coagula"})


def _name(text):
    return "".join(part[:1].upper() + part[1:] for part in text.replace("/", "_").split("_"))


def _build(tree, name, base=Result):
    values, units, descriptions, documented = {}, {}, {}, []
    for key, entry in tree.items():
        if isinstance(entry, dict):
            values[key] = _build(entry, _name(key))
            documented.append((key, "group of " + ", ".join(entry)))
        else:
            values[key], units[key], descriptions[key] = entry
            documented.append((key, _documented(units[key], descriptions[key])))
    return _class_of(name, base, tuple(documented))(values, units, descriptions)


def _restored(tree, name, base, packing):
    result = _build(tree, name, base)
    result._packing = packing
    return result


def from_entries(entries, name, base=Result):
    """A result of a list of (path, value, unit, description)."""
    tree = {}
    for path, value, unit, description in entries:
        *groups, last = path.split("/")
        place = tree
        for group in groups:
            place = place.setdefault(group, {})
        place[last] = (value, unit, description)
    return _build(tree, name, base)


def from_json(values, name, base=Result):
    """A result of a JSON object: objects are groups, lists of numbers are arrays, null is None."""
    def convert(value, key):
        if isinstance(value, dict):
            return from_json(value, _name(key))
        if isinstance(value, list):
            if value and all(isinstance(item, (int, float)) and not isinstance(item, bool) for item in value):
                return np.array(value)
            return [convert(item, key) for item in value]
        return value

    made = {key: convert(value, key) for key, value in values.items()}
    documented = tuple((key, "group" if isinstance(value, Result) else "value") for key, value in made.items())
    return _class_of(name, base, documented)(made)


def from_stage(stage, name):
    base = Stage if stage.packing is None else Generated
    result = from_entries(stage.entries, name, base)
    result._stage = stage
    result._packing = stage.packing
    return result
