# SPDX-License-Identifier: GPL-3.0-or-later
"""Keyword arguments of Python as values of options; signatures and documentation from the table of options."""

import difflib
import inspect
import numbers
import os
import warnings

import numpy as np

from ._spelling import VERBS, argument, in_python

# What each call has besides the options of the verb.
PROGRESS = "Called as progress(stage, fraction, remark) now and then, at most 20 times a second; what it raises stops the call."
THREADS = "Number of threads, at most one for each processor, which is also the default."


def _plain(value):
    """The value as a bool, an int, a float, a str, or a list of these."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, numbers.Real):
        return float(value)
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, dict):
        return ",".join(f"{name}={_plain(item)}" for name, item in value.items())
    try:
        return [_plain(item) for item in value]
    except TypeError:
        raise TypeError(f"{value!r} is neither a number nor a text, nor a list of them") from None


def _present_name(verb, name, given):
    """The name that an argument has now; old ones are warned of."""
    for option in VERBS[verb]["options"]:
        if option["former_name"] and argument(option["former_name"]) == name:
            now = argument(option["name"])
            if now in given:
                raise TypeError(f"{name} is the old name of {now}: give one of them")
            warnings.warn(f"{name} is called {now} now; the old name works until version 2", FutureWarning, stacklevel=4)
            return now
    return name


def values(verb, given, threads=None):
    """The options given, by the names of the program; None and False leave an option out."""
    known = {argument(option["name"]): option for option in VERBS[verb]["options"]}
    result = {}
    for written, value in given.items():
        name = _present_name(verb, written, given)
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1)
            raise TypeError(f"{verb}() has no argument '{name}'" + (f"; did you mean '{near[0]}'?" if near else ""))
        option = known[name]
        if value is None or value is False:
            continue
        if option["kind"] == "flag" and value is not True:
            raise TypeError(f"{name} is True or False, not {value!r}")
        result[option["name"]] = _plain(value)
    return result if threads is None else {**result, "threads": _plain(threads)}


def call_text(verb, first, given):
    """The call as it stands in Python, for the history of a file."""
    def text(value):
        shown = repr(value)
        return shown if len(shown) < 200 else f"<{type(value).__name__}>"

    parts = [*first, *(f"{name}={text(value)}" for name, value in given.items() if value is not None)]
    return f"coagula.{verb}({', '.join(parts)})"


def _default(option):
    kind, text = option["kind"], option["default"]
    if kind == "flag":
        return False
    if text == "":
        return None
    if kind == "count":
        return int(text)
    try:
        return float(text) if kind == "quantity" else text
    except ValueError:
        return text


def annotation(option):
    """The type of an argument as a text, for the signature and the stubs."""
    kinds = {"flag": "bool", "count": "int", "quantity": "float | str", "text": "str | Sequence[float | str]"}
    kind = kinds[option["kind"]]
    if option["choices"]:
        kind = "Literal[" + ", ".join(repr(choice) for choice in option["choices"]) + "]"
    return kind if option["required"] or option["kind"] == "flag" or option["default"] else kind + " | None"


def _about(option):
    facts = []
    if option["unit"] not in ("", "1"):
        facts.append("unit " + option["unit"])
    if option["range"]:
        facts.append("range " + option["range"])
    return in_python(option["meaning"]) + (f" [{'; '.join(facts)}]" if facts else "")


def documented(verb, first=(), replaced=(), extra=(), returns="", common=True):
    """Decorator: signature and documentation of a function that takes the options of a verb.

    first, extra: (name, annotation, default, meaning) of arguments before and after the options; a default of inspect.Parameter.empty
    means that the argument is required. replaced: names of options that the function has in `extra` in another form, or has not.
    """
    def decorate(function):
        table = VERBS[verb]
        options = [option for option in table["options"] if argument(option["name"]) not in replaced]
        parameters, lines = [], []
        for name, kind, default, meaning in first:
            parameters.append(inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=default, annotation=kind))
            lines += [f"{name} : {kind}", f"    {meaning}"]
        for option in options:
            name = argument(option["name"])
            default = inspect.Parameter.empty if option["required"] else _default(option)
            parameters.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation(option)))
            shown = "" if option["required"] else f", default {default!r}"
            lines += [f"{name} : {annotation(option)}{shown}", f"    {_about(option)}"]
        of_all = [("progress", "Callable[[str, float, str], object] | None", None, PROGRESS), ("threads", "int | None", None, THREADS)]
        for name, kind, default, meaning in [*extra, *(of_all if common else [])]:
            parameters.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind))
            lines += [f"{name} : {kind}, default {default!r}", f"    {meaning}"]
        function.__signature__ = inspect.Signature(parameters, return_annotation=returns)
        summary = table["summary"][0].upper() + table["summary"][1:] + "."
        function.__doc__ = "\n".join([summary, "", inspect.cleandoc(function.__doc__ or ""), "", "Parameters", "----------", *lines])
        return function

    return decorate
