# SPDX-License-Identifier: GPL-3.0-or-later
"""Names and sentences of the program as Python spells them."""

import keyword
import re

from . import _coagula

VERBS = _coagula.verbs()
# Verbs whose function has another name.
_FUNCTIONS = {"import": "read", "export": "write", "info": "table"}
_CHOICES = {option["name"]: option["choices"] for table in VERBS.values() for option in table["options"] if option["choices"]}
_PARTS = re.compile(r"\(see 'coagula (?P<helped>[a-z -]+?) --help'\)"
                    r"|(?P<quoted>(?<!\w)'[^']*'(?!\w))"  # a value that was given, or a command of the program
                    r"|\bcoagula (?P<verb>[a-z]+(?: [a-z-]+)??)(?= (?:needs|takes) )"
                    r"|(?<![\w-])--(?P<option>[a-z](?:[a-z0-9-]*[a-z0-9])?)(?P<given> (?P<value>[a-z0-9-]+))?(?!\.?\w)")


def argument(option):
    """The name of an option in Python: underscores, and one behind it where it is a word of the language (from_)."""
    name = option.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def _function(verb):
    return _FUNCTIONS.get(verb, verb.replace(" ", "_").replace("-", "_"))


def _in_python(part):
    if part["helped"]:
        return f"(see help(coagula.{_function(part['helped'])}))"
    if part["quoted"]:
        return part["quoted"]
    if part["verb"]:
        return _function(part["verb"]) + "()"
    option, value = part["option"], part["value"]
    if option == "force":
        return "overwrite=True" + (part["given"] or "")
    if value in _CHOICES.get(option, ()):
        return f"{argument(option)}={value!r}"
    return argument(option) + (part["given"] or "")


def in_python(sentence):
    """A sentence of the program with arguments of functions in place of options: "--volume-fraction" is "volume_fraction"."""
    return _PARTS.sub(_in_python, sentence)


_coagula.spell_errors_by(in_python)
