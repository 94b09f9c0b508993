#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The index of this study: one row for each structure, with its measures and its moduli at three ratios of the stiffnesses.

    datasets/critical_heterogeneity/tables.py FOLDER index.csv.xz [SET ...]

reads the data sets that `coagula dataset run` has made in FOLDER of the sweep files beside this script, takes measures of the contact network that the
sweeps leave out from the particles, and dilutes the networks of to_dilute.h5. With names of sets only their rows are made anew. Needs the Python package of coagula, numpy and scipy.
"""

import csv
import lzma
import math
import pathlib
import sys

import coagula
import numpy

from networks import Network, shear_modulus

SETS = ("void_expansion", "brownian", "depletion", "volume_fractions", "sizes", "void_expansion_8000", "brownian_8000")
RATIOS = {100.0: "G_1", 10.0: "G_0.1", 1.0: "G_0.01"}  # by the shear stiffness of a particle [N/m]
COLUMNS = {"a": "doh.a", "C": "coordination", "redundancy": "rigidity.redundancy_per_particle"}
NETWORK = {"triangles": "topology.triangles", "tetrahedra": "topology.tetrahedra", "outside": "topology.contacts_outside_triangles",
           "three": "coordination_percolation.three_or_more.fraction", "six": "coordination_percolation.six_or_more.fraction",
           "six_largest": "coordination_percolation.six_or_more.largest_fraction", "betweenness": "betweenness.top_tenth_share",
           "dense_largest": "dense_clusters.triangles.largest_fraction", "dense_between": "dense_clusters.triangles.contacts_between"}
FIELDS = ["set", "generator", "particles", "volume_fraction", "recipe", "seed", *COLUMNS, "rings4", *NETWORK, *RATIOS.values()]


def at(result, path):
    for name in path.split("."):
        result = result[name]
    return float(result)


def value(table, name, row):
    return table[name][row] if name in table else math.nan


def recipe(name, table, row, particles):
    """Generator, and what tells its recipes apart: voids per particle, surface potential [mV]."""
    if name == "depletion":
        return "depletion gel", 0.0
    if str(table["generator"][row]) == "vem":
        return "void expansion", round(float(value(table, "voids", row)) / particles, 3)
    potential = value(table, "surface-potential", row)
    millivolts = 0.0 if isinstance(potential, float) and math.isnan(potential) else 1e3 * float(potential)
    return f"Brownian {round(millivolts)} mV", round(millivolts, 3)


def network_measures(structure, tolerance):
    found = coagula.characterize(structure.packing, only="coordination,topology,rings,coordination_percolation,dense_clusters,betweenness",
                                 contact_tolerance=tolerance).to_dict()
    return {name: at(found, path) for name, path in NETWORK.items()} | {"rings4": float(found["rings"]["per_particle"][4])}


def rows_of(name, folder):
    """One row for each structure, whose copies in the set differ in the shear stiffness alone."""
    data = coagula.open_dataset(str(folder / f"{name}.h5"))
    table = data.table()
    rows = {}
    for number in range(len(data)):
        if str(table["status"][number]) != "done":
            continue
        key = str(table["sha256"][number])
        if key not in rows:
            structure = data.structure(table["id"][number])
            particles = len(structure.packing.radii)
            generator, parameter = recipe(name, table, number, particles)
            rows[key] = {"set": name, "generator": generator, "recipe": parameter,
                         "particles": particles, "seed": int(table["seed"][number]),
                         "volume_fraction": round(float(table["volume_fraction"][number]), 6),
                         **{short: float(table[column][number]) for short, column in COLUMNS.items()},
                         **network_measures(structure, float(table["contact_tolerance"][number]))}
        rows[key][RATIOS[float(table["shear-stiffness"][number])]] = float(table["storage_modulus.mean"][number]) / 1e6
    return list(rows.values())


def diluted(folder, coordinations=(4.5, 4.7, 4.9)):
    """Dense networks without contacts that were drawn at random."""
    data = coagula.open_dataset(str(folder / "to_dilute.h5"))
    table = data.table()
    for number in range(len(data)):
        if str(table["status"][number]) != "done":
            continue
        whole = Network.of_packing(data.structure(table["id"][number]).packing)
        order = numpy.random.default_rng(number).permutation(len(whole.bonds))
        for contacts in coordinations:
            part = whole.part(numpy.sort(order[:round(contacts * whole.particles / 2)]))
            moduli = {name: shear_modulus(part, 50.0, stiffness / 2) / 1e6 for stiffness, name in RATIOS.items()}
            yield {"set": "to_dilute", "generator": "diluted", "particles": whole.particles,
                   "volume_fraction": 0.4, "recipe": contacts, "seed": int(table["seed"][number]), "a": float(table["doh.a"][number]),
                   **part.measures(), **moduli}


def main():
    folder, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    wanted = sys.argv[3:] or [*SETS, "to_dilute"]
    rows = []
    if output.exists():
        with lzma.open(output, "rt", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["set"] not in wanted]
    for name in wanted:
        rows += diluted(folder) if name == "to_dilute" else rows_of(name, folder)
    with lzma.open(output, "wt", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, FIELDS, restval="")
        writer.writeheader()
        writer.writerows({name: f"{entry:.7g}" if isinstance(entry, float) else entry for name, entry in row.items()} for row in rows)
    print(f"{len(rows)} structures written to {output}")


if __name__ == "__main__":
    main()
