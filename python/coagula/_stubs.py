"""Writes the type stubs of the package: python3 -m coagula._stubs FILE. Signatures come from the functions themselves."""

import inspect
import sys

import coagula

HEAD = '''"""Type stubs, made from the module by coagula._stubs."""
from collections.abc import Callable, Iterator, KeysView, Sequence
from os import PathLike
from typing import Any, Literal

from numpy import ndarray
from numpy.typing import ArrayLike

__version__: str
'''
# Types of attributes; those that are not named here are arrays.
ATTRIBUTES = {"Packing": {"periodic": "bool", "volume_fraction": "float", "mean_radius": "float", "monodisperse": "bool"},
              "Bonds": {"particles": "int", "coordination": "float"},
              "Stage": {"bonds": "Bonds | None", "notes": "list[str]"},
              "Generated": {"packing": "Packing", "frames": "list[tuple[float, ndarray]]"},
              "Structure": {"packing": "Packing", "bonds": "Bonds | None", "time": "float", "history": "list[dict[str, Any]]"}}
CONSTRUCTORS = {"Packing": "self, positions: ArrayLike, radii: ArrayLike | str | Sequence[str], box: ArrayLike | str | Sequence[str] | None = None, wrap: bool = False"}
METHODS = {"__getitem__": "(self, path: str) -> Any", "__getattr__": "(self, name: str) -> Any", "__len__": "(self) -> int",
           "__iter__": "(self) -> Iterator[str]", "__contains__": "(self, path: str) -> bool", "keys": "(self) -> KeysView[str]",
           "unit": "(self, path: str) -> str", "description": "(self, path: str) -> str",
           "paths": "(self) -> Iterator[str]", "flat": "(self) -> dict[str, float | int | str]",
           "to_dict": "(self) -> dict[str, Any]"}


def annotated(name, kind):
    """Annotations are texts, which must not stay in quotes."""
    return f"{name}: {kind if isinstance(kind, str) else getattr(kind, '__name__', 'Any')}"


def parameter_text(parameter):
    kind = parameter.annotation
    text = parameter.name if kind is inspect.Parameter.empty else annotated(parameter.name, kind)
    if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
        return "*" + text
    return text if parameter.default is inspect.Parameter.empty else f"{text} = {parameter.default!r}"


def function_stub(name, function):
    signature = inspect.signature(function)
    parts, keyword_only = [], False
    for parameter in signature.parameters.values():
        if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
            keyword_only = True
        if parameter.kind is inspect.Parameter.KEYWORD_ONLY and not keyword_only:
            parts.append("*")
            keyword_only = True
        parts.append(parameter_text(parameter))
    returns = signature.return_annotation
    returns = returns if isinstance(returns, str) else "Any"
    return f"def {name}({', '.join(parts)}) -> {returns}: ...\n"


def class_stub(name, kind, bases):
    lines = [f"class {name}{f'({bases})' if bases else ''}:"]
    if name in CONSTRUCTORS:
        lines.append(f"    def __init__({CONSTRUCTORS[name]}) -> None: ...")
    for member, value in vars(kind).items():
        if isinstance(value, property) and not member.startswith("_"):
            about = (value.__doc__ or "").strip()
            lines += ["    @property", f"    def {member}(self) -> {ATTRIBUTES.get(name, {}).get(member, 'ndarray')}:",
                      f'        """{about}"""', "        ..."]
        elif member in METHODS:
            lines.append(f"    def {member}{METHODS[member]}: ...")
    if len(lines) == 1:
        lines.append("    ...")
    return "\n".join(lines) + "\n"


def stub_text():
    from coagula import _results

    parts = [HEAD]
    classes = [("Packing", coagula.Packing, ""), ("Bonds", coagula.Bonds, ""), ("Result", coagula.Result, ""),
               ("Stage", _results.Stage, "Result"), ("Generated", _results.Generated, "Stage"),
               ("Structure", coagula.Structure, "Result"), ("InputError", coagula.InputError, "ValueError"),
               ("MissingFileError", coagula.MissingFileError, "InputError, FileNotFoundError"),
               ("ExistingFileError", coagula.ExistingFileError, "InputError, FileExistsError")]
    for name, kind, bases in classes:
        parts.append(class_stub(name, kind, bases))
    for name in coagula.__all__:
        value = getattr(coagula, name)
        if inspect.isfunction(value):
            parts.append(function_stub(name, value))
    return "\n".join(parts)


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(stub_text())
