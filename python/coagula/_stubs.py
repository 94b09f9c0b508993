# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the type stubs of the package: python3 -m coagula._stubs FILE.

Signatures come from the functions themselves, the attributes of results from small calls of the stages.
"""

import inspect
import sys

import coagula

HEAD = '''"""Type stubs, made from the module by coagula._stubs."""
from collections.abc import Callable, Iterator, KeysView, Sequence
from os import PathLike
from typing import Any, Literal, overload

from numpy.typing import ArrayLike, NDArray

Array = NDArray[Any]

__version__: str
'''
# Types of attributes; those that are not named here are arrays.
ATTRIBUTES = {"Packing": {"periodic": "bool", "periodic_edges": "tuple[bool, bool, bool]", "volume_fraction": "float", "mean_radius": "float", "monodisperse": "bool"},
              "Bonds": {"particles": "int", "coordination": "float"},
              "Stage": {"bonds": "Bonds | None", "notes": "list[str]"},
              "Generated": {"packing": "Packing", "frames": "list[tuple[float, Array]]"},
              "Structure": {"packing": "Packing", "bonds": "Bonds | None", "time": "float", "frames": "list[tuple[float, Array]]",
                            "history": "list[dict[str, Any]]"},
              "DataSet": {"card": "dict[str, str]", "sweep": "str", "provenance": "dict[str, str]"},
              "Figure": {"svg": "str | None"}}
CONSTRUCTORS = {"Packing": "self, positions: ArrayLike, radii: ArrayLike | str | Sequence[str], box: ArrayLike | str | Sequence[str] | None = None, wrap: bool = False"}
METHODS = {"__getitem__": "(self, path: str) -> Any", "__getattr__": "(self, name: str) -> Any", "__len__": "(self) -> int",
           "__iter__": "(self) -> Iterator[str]", "__contains__": "(self, path: str) -> bool", "keys": "(self) -> KeysView[str]",
           "unit": "(self, path: str) -> str", "description": "(self, path: str) -> str",
           "paths": "(self) -> Iterator[str]", "flat": "(self) -> dict[str, float | int | str]",
           "to_dict": "(self) -> dict[str, Any]", "columns": "(self) -> dict[str, Array]",
           "table": "(self) -> dict[str, Array]", "structures": "(self) -> list[str]", "structure": "(self, id: str) -> Structure"}


def annotated(name, kind):
    """Annotations are texts, which must not stay in quotes."""
    return f"{name}: {kind if isinstance(kind, str) else getattr(kind, '__name__', 'Any')}"


def parameter_text(parameter):
    kind = parameter.annotation
    text = parameter.name if kind is inspect.Parameter.empty else annotated(parameter.name, kind)
    if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
        return "*" + text
    return text if parameter.default is inspect.Parameter.empty else f"{text} = {parameter.default!r}"


def function_stub(name, function, narrowed=None, returns=None):
    """@param narrowed: parameters with another annotation or default."""
    signature = inspect.signature(function)
    parts, keyword_only = [], False
    for parameter in signature.parameters.values():
        parameter = (narrowed or {}).get(parameter.name, parameter)
        if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
            keyword_only = True
        if parameter.kind is inspect.Parameter.KEYWORD_ONLY and not keyword_only:
            parts.append("*")
            keyword_only = True
        parts.append(parameter_text(parameter))
    returns = returns or signature.return_annotation
    returns = returns if isinstance(returns, str) else "Any"
    return f"def {name}({', '.join(parts)}) -> {returns}: ...\n"


def class_stub(name, kind, bases):
    lines = [f"class {name}{f'({bases})' if bases else ''}:"]
    if name in CONSTRUCTORS:
        lines.append(f"    def __init__({CONSTRUCTORS[name]}) -> None: ...")
    for member, value in vars(kind).items():
        if isinstance(value, property) and not member.startswith("_"):
            about = (value.__doc__ or "").strip()
            lines += ["    @property", f"    def {member}(self) -> {ATTRIBUTES.get(name, {}).get(member, 'Array')}:",
                      f'        """{about}"""', "        ..."]
        elif member in METHODS:
            lines.append(f"    def {member}{METHODS[member]}: ...")
    if len(lines) == 1:
        lines.append("    ...")
    return "\n".join(lines) + "\n"


def value_type(value):
    return "Array" if hasattr(value, "dtype") else type(value).__name__


def result_stub(name, base, result):
    """Classes of a result and of its groups, which have names of their own: LinearResponseStorageModulus."""
    groups, lines = [], [f"class {name}({base}):"]
    for key, value in result._values.items():
        if not key.isidentifier() or hasattr(type(result).__mro__[1], key):
            continue
        if isinstance(value, coagula.Result):
            kind = name + type(value).__name__
            groups.append(result_stub(kind, "Result", value))
            lines += ["    @property", f"    def {key}(self) -> {kind}: ..."]
        else:
            unit = result.unit(key)
            about = result.description(key) + ("" if unit in ("1", "") else f" [{unit}]")
            lines += ["    @property", f"    def {key}(self) -> {value_type(value)}:", f"        {about!r}", "        ..."]
    return "".join(groups) + "\n".join(lines) + "\n"


def samples():
    """A small result of each stage."""
    made = coagula.generate_vem(particles=60, volume_fraction=0.3, radius=1e-6, threads=1)
    run = coagula.generate_brownian(particles=30, volume_fraction=0.2, radius=1e-7, surface_potential=0.01, stop_time=1e-6,
                                    equilibration_time=1e-6, threads=1)
    return {"generate_vem": ("Generated", made), "generate_brownian": ("Generated", run),
            "characterize": ("Stage", coagula.characterize(made, threads=1)), "shear": ("Stage", coagula.shear(made, threads=1))}


def shear_stubs(result):
    """The linear response, which is what shear returns without other wishes, is known in detail."""
    def only(name, kind):
        return {name: inspect.signature(coagula.shear).parameters[name].replace(annotation=kind)}

    linear = {**only("method", "Literal['linear']"), **only("frequency", "None"), **only("frequency_sweep", "None")}
    return ("@overload\n" + function_stub("shear", coagula.shear, linear, type(result).__name__) +
            "@overload\n" + function_stub("shear", coagula.shear))


def stub_text():
    from coagula import _results

    parts = [HEAD]
    classes = [("Packing", coagula.Packing, ""), ("Bonds", coagula.Bonds, ""), ("Result", coagula.Result, ""),
               ("Stage", _results.Stage, "Result"), ("Generated", _results.Generated, "Stage"),
               ("Structure", coagula.Structure, "Result"), ("Figure", coagula.Figure, "Result"), ("Table", coagula.Table, "Result"),
               ("DataSet", coagula.DataSet, ""),
               ("InputError", coagula.InputError, "ValueError"),
               ("MissingFileError", coagula.MissingFileError, "InputError, FileNotFoundError"),
               ("ExistingFileError", coagula.ExistingFileError, "InputError, FileExistsError")]
    for name, kind, bases in classes:
        parts.append(class_stub(name, kind, bases))
    known = samples()
    for base, result in known.values():
        parts.append(result_stub(type(result).__name__, base, result))
    for name in coagula.__all__:
        value = getattr(coagula, name)
        if name == "shear":
            parts.append(shear_stubs(known["shear"][1]))
        elif inspect.isfunction(value):
            parts.append(function_stub(name, value, returns=type(known[name][1]).__name__ if name in known else None))
    return "\n".join(parts)


if __name__ == "__main__":
    text = stub_text()
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(text)
