#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verdicts on real exports of instruments, beside what is known of them, as a table. The verdicts are the recorded facts (tests/facts).

    tests/benchmark/real_exports.py"""

import json
import lzma
from pathlib import Path

FACTS = Path(__file__).resolve().parent.parent / "facts" / "expected.json.xz"

# By the beginning of the name: what source and file say of it, causes that are no false names, and kinds that are right. No kinds: nobody knows.
KNOWN = {
    "export-blood": ("thixotropic, thins", ("shear-thinning",), ("material along shear_rate",)),
    "export-cement-laos-saos": ("builds up for 20 min", ("ageing",), ("history along time", "history along age")),
    "export-cement-laos-laos": ("builds up during the sweep, then yields", (), ("material along strain", "history along time")),
    "export-haake-rheowin-pt-sac": ("last rows jump: inertia of the tool", ("tool-inertia",), ("tool along frequency",)),
    "export-haake-rheowin-pt-ur": ("last rows jump: inertia of the tool", ("tool-inertia",), ("tool along frequency",)),
    "export-haake-rheowin-pt-agua": ("last rows jump up and down", ("tool-inertia",), ("tool along frequency", "material along frequency")),
    "export-restylane": ("yields, no fault", (), ()),
    "export-rheodata-toolkit-steady": ("linseed oil, no fault above 0.1 1/s", ("torque-offset",), ()),
    "export-rheodata-toolkit-txt": ("linseed oil, no fault above 0.1 1/s", ("torque-offset",), ()),
    "export-rheofit-flow-hs60": ("emulsion, thins", ("shear-thinning",), ("material along shear_rate",)),
    "export-rheofit-flow-flow": ("emulsion, thins", ("shear-thinning",), ("material along shear_rate",)),
    "export-rheofit-flow-las": ("raw phase near 180 degrees: inertia", ("tool-inertia", "sample-inertia"),
                                ("tool along frequency", "geometry along frequency", "material along frequency")),
    "export-rheoplus": ("sweeps from 160 to 120 degrees Celsius, which the experiment does not tell", (), ("history along time",)),
    "export-ttw": ("dries while it is heated: + 20 %", ("evaporation", "drying-rim"), ("history along time", "geometry along time")),
    "export-rheocompass-variants-frequency": ("made by hand", (), ()),
    "real-exports-dhr": ("raw: inertia of the tool 25.7 and 24.2 uN.m.s2", ("tool-inertia",), ("tool along frequency",)),
    "real-exports-wormlike": ("inertia of the tool", ("tool-inertia",), ("tool along frequency",)),
}


def known_of(name):
    found = max((each for each in KNOWN if name.startswith(each)), key=len, default=None)
    return KNOWN[found] if found else ("nothing", (), ())


def judged(facts, names, kinds):
    """Right or wrong of what the verdict is certain of."""
    if facts["verdict"] == "no-discrepancy":
        return "yes" if not kinds else "nothing found"
    if facts["verdict"] == "named":
        members = [each for cause in facts["credible_set"] for each in cause.split(" + ")]
        return "yes" if names and members[0] in names else "NO"
    follows = facts["follows"]
    if follows["posterior"] < 0.9:
        return "open"
    return "not known" if not kinds else "yes" if f"{follows['link']} along {follows['axis']}" in kinds else "NO"


def line(name, facts):
    known, names, kinds = known_of(name)
    follows = facts.get("follows")
    told = f"{follows['link']} along {follows['axis']} ({100 * follows['posterior']:.0f} %)" if facts["detected"] else ""
    causes = ", ".join(facts["credible_set"][:2]) + (" ..." if len(facts["credible_set"]) > 2 else "")
    return f"| {name.removeprefix('export-').removeprefix('real-exports-')} | {known} | {facts['verdict']} | {causes} | {told} | {judged(facts, names, kinds)} |"


def main():
    recorded = json.loads(lzma.decompress(FACTS.read_bytes()))
    print("| export | known of it | verdict | set | what it follows | right |")
    print("|---|---|---|---|---|---|")
    for name, facts in recorded.items():
        if name.startswith(("export-", "real-exports-")):
            print(line(name, facts))


if __name__ == "__main__":
    main()
