# SPDX-License-Identifier: GPL-3.0-or-later
"""What the catalogue does not have: effects that never had a cause in it (foreign.py), and causes that are struck from it (`struck`). A name is wrong there,
whatever it is; right is what a verdict says of the link of the chain and of the axis that it follows.

Runs with an even effect are the half on which thresholds are set; those with an odd one are reported."""

from dataclasses import dataclass

import foreign
from cases import ROWS as CASES, of_effect

TIME, FREQUENCY, STRAIN = ("time", "age"), ("frequency",), ("strain", "stress")


@dataclass(frozen=True)
class Struck:
    """A cause that is hidden and may not be named, and what a right verdict may state of it."""
    name: str
    links: tuple
    axes: tuple


STRUCK = [
    Struck("contact-loss", ("material",), FREQUENCY),
    Struck("ageing", ("history", "material"), TIME),
    Struck("tool-compliance", ("tool", "geometry"), ("radius", "gap")),
    Struck("tool-inertia", ("tool",), FREQUENCY),
    Struck("wall-slip", ("geometry",), ("gap",)),
    Struck("gap-error", ("geometry",), ("gap",)),
    Struck("ageing-power", ("history", "material"), TIME),
    Struck("ageing-saturating", ("history", "material"), TIME),
    Struck("temperature-drift", ("history", "material"), TIME),
    Struck("evaporation", ("history", "geometry"), (*TIME, "radius")),
    Struck("drying-rim", ("history", "geometry"), (*TIME, "radius")),
    Struck("radius-error", ("geometry",), ("radius",)),
    Struck("edge-fracture", ("geometry", "material"), (*STRAIN, "gap")),
    Struck("reversible-softening", ("material",), STRAIN),
    Struck("thixotropy", ("history", "material"), (*TIME, *STRAIN)),
    Struck("contact-dashpot", ("material", "tool"), FREQUENCY),
    Struck("contact-relaxation", ("material",), FREQUENCY),
    Struck("sudden-loss", ("geometry", "errors", "history"), ("sample", *TIME)),
    Struck("sample-inertia", ("geometry", "tool"), (*FREQUENCY, "gap")),
    Struck("bearing-damping", ("tool", "material"), FREQUENCY),
    Struck("poroelastic-backflow", ("history", "geometry"), (*TIME, "gap", "radius")),
    Struck("phase-offset", ("tool", "material"), ("level", *FREQUENCY)),
]


def struck(generator, material, number):
    name = STRUCK[number % len(STRUCK)].name
    return (CASES[name] if name in CASES else of_effect(name))(generator, material)


ROWS = {"foreign": foreign.foreign, "struck": struck}
MAY_STATE = {"foreign": foreign.EFFECTS, "struck": STRUCK}


def is_named(entry):
    return entry["found"]["verdict"] == "named"


def is_right(entry):
    """Whether link and axis that the verdict states are among those that the effect allows."""
    follows = entry["found"].get("follows") or {}
    effect = MAY_STATE[entry["row"]][entry["number"] % len(MAY_STATE[entry["row"]])]
    return follows.get("link") in effect.links and follows.get("axis") in effect.axes


def add_open_set(table, of):
    """Lines of the table of a campaign."""
    for row, effects in MAY_STATE.items():
        for half, parity in (("set on this half", 0), ("reported", 1)):
            own = [entry for entry in of(row) if entry["number"] % len(effects) % 2 == parity]
            found = [entry for entry in own if entry["found"]["detected"]]
            case = f"{row}, {half}"
            table.add(case, "detected", [entry["found"]["detected"] for entry in own], 0.95)
            table.add(case, "confidently wrong", [is_named(entry) for entry in own], 0.0, 0.02)
            table.add(case, "tied, without none of the catalogue", [entry["found"]["verdict"] == "tied" and "none of the catalogue" not in
                                                                    entry["found"]["credible_set"] for entry in own], 0.0, 0.1)
            table.add(case, "link and axis right", [is_right(entry) for entry in found], 0.90)
