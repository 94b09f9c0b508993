#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples whose volume fraction, coordination or number of voids is another than the recipe of the experiment says: what `coagula diagnose`
says of their pores and of their coordinates. Run: tests/benchmark/structure_causes.py [--runs 8] [--hidden nothing] [--seen coordinates] [--particles 700]
[--coagula build/bin/coagula]

Each run sees two samples of so many particles of their own, beside two structures of 500 by the recipe (volume fraction 0.4, coordination 4.69,
a void for every other particle). The structures that the diagnosis makes again are made once for all runs.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import tempfile

RECIPE = {"volume-fraction": 0.4, "target-coordination": 4.69, "voids": 0.5}  # voids per particle
# What is hidden, the cause that it is, its parameter, and its value.
HIDDEN = [
    ({}, None, None, None),
    ({"volume-fraction": 0.43}, "volume-fraction", "volume_fraction_over_stated", 0.43 / 0.4),
    ({"target-coordination": 5.0}, "coordination", "coordination", 5.0),
    ({"voids": 0.2}, "heterogeneity", "voids_per_particle", 0.2),
]
EXPERIMENT = """[sample]
particle_radius = "0.25 um"
volume_fraction = 0.4
[structures]
generator = "vem"
particles = 500
seeds = [1, 2]
"""
KINDS = ("pore-curve", "coordinates")
TABLE = '[[measurement]]\nkind = "{kind}"\nfile = "{file}"\nsample = "{file}"\n'


def sample(coagula, folder, hidden, particles, seed):
    """Makes a sample; returns its table of pores and its table of coordinates by kind."""
    recipe = {**RECIPE, **hidden}
    recipe["voids"] = round(recipe["voids"] * particles)
    words = [word for key, value in recipe.items() for word in (f"--{key}", str(value))]
    run = lambda *call: subprocess.run([coagula, *call], cwd=folder, check=True, capture_output=True, text=True).stdout
    run("generate", "vem", "--particles", str(particles), "--radius", "0.25um", "--seed", str(seed), *words, "-o", "sample.h5", "--force")
    run("export", "sample.h5", "--format", "csv", "-o", f"coordinates{seed}.csv")
    curve = json.loads(run("characterize", "sample.h5", "--only", "pores", "--radii", "40", "--json", "-o", "pores.h5", "--force"))["pore_curve"]
    rows = "".join(f"{r},{p}\n" for r, p in zip(curve["radius"], curve["exclusion_probability"]))
    (folder / f"pores{seed}.csv").write_text("pore_radius [m],exclusion_probability\n" + rows)
    return {"pore-curve": f"pores{seed}.csv", "coordinates": f"coordinates{seed}.csv"}


def diagnose(coagula, folder, kind, files):
    text = EXPERIMENT + "".join(TABLE.format(kind=kind, file=file) for file in files)
    (folder / "experiment.toml").write_text(text)
    call = [coagula, "diagnose", "experiment.toml", "-o", "results", "--force", "--json"]
    return json.loads(subprocess.run(call, cwd=folder, check=True, capture_output=True, text=True).stdout)


def row(kind, cause, parameter, truth, found):
    """One line of the table: how often what was said."""
    runs = len(found)
    count = lambda holds: f"{sum(map(holds, found))}/{runs}"
    said = collections.Counter(", ".join(one["credible_set"]) or "nothing" for one in found).most_common(1)[0]
    detected = count(lambda d: d["detected"])
    if cause is None:
        return f"| nothing | {kind} | {detected} | | | | {said[0]} ({said[1]}) |"
    covers = lambda d: any(c["name"] == cause and c["parameters"][parameter]["low"] <= truth <= c["parameters"][parameter]["high"] for c in d["causes"])
    alone = count(lambda d: d["verdict"] == "named" and d["credible_set"] == [cause])
    return (f"| {parameter} {truth:.4g} | {kind} | {detected} | {count(lambda d: cause in d['credible_set'])} | {alone} | {count(covers)} | "
            f"{said[0]} ({said[1]}) |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=8)
    parser.add_argument("--hidden", choices=[cause or "nothing" for _, cause, _, _ in HIDDEN], help="this row alone")
    parser.add_argument("--seen", choices=KINDS, help="in these alone")
    parser.add_argument("--particles", type=int, default=700, help="of a sample")
    parser.add_argument("--coagula", default="build/bin/coagula")
    arguments = parser.parse_args()
    coagula = str(pathlib.Path(arguments.coagula).resolve())
    print("| hidden | seen in | found | in the set | named alone | 90 % interval covers | said most often |\n|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, (hidden, cause, parameter, truth) in enumerate(HIDDEN):
            if arguments.hidden not in (None, cause or "nothing"):
                continue
            seeds = [[1000 * (number + 1) + 2 * run + k for k in range(2)] for run in range(arguments.runs)]
            tables = [[sample(coagula, folder, hidden, arguments.particles, seed) for seed in pair] for pair in seeds]
            for kind in KINDS if arguments.seen is None else [arguments.seen]:
                found = [diagnose(coagula, folder, kind, [table[kind] for table in pair]) for pair in tables]
                print(row(kind, cause, parameter, truth, found), flush=True)


if __name__ == "__main__":
    main()
