#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The index of this study: one row for each structure, with its measures and its moduli at three ratios of the stiffnesses.

    datasets/critical_heterogeneity/tables.py FOLDER index.csv.xz [SET ...]

reads the data sets that `coagula dataset run` has made in FOLDER of the sweep files beside this script, takes measures of the contact network that the
sweeps leave out from the particles, and dilutes the networks of to_dilute.h5 and to_dilute_8000.h5. With names of sets only their rows are made anew. Needs the Python package of coagula, numpy and scipy.
"""

import csv
import lzma
import math
import pathlib
import sys

import coagula
import numpy
import scipy.spatial

from networks import Network, shear_modulus

SETS = ("void_expansion", "brownian", "depletion", "volume_fractions", "sizes", "bending", "void_expansion_8000", "brownian_8000")
DILUTED = ("to_dilute", "to_dilute_8000")
RATIOS = {100.0: "G_1", 10.0: "G_0.1", 1.0: "G_0.01"}  # by the shear stiffness of a particle [N/m]
BENDING = {name: name.replace("G", "bending") for name in RATIOS.values()}  # the same where contacts resist bending, too
COLUMNS = {"a": "doh.a", "C": "coordination", "redundancy": "rigidity.redundancy_per_particle"}
NETWORK = {"triangles": "topology.triangles", "tetrahedra": "topology.tetrahedra", "outside": "topology.contacts_outside_triangles",
           "three": "coordination_percolation.three_or_more.fraction", "six": "coordination_percolation.six_or_more.fraction",
           "six_largest": "coordination_percolation.six_or_more.largest_fraction", "betweenness": "betweenness.top_tenth_share",
           "dense_largest": "dense_clusters.triangles.largest_fraction", "dense_between": "dense_clusters.triangles.contacts_between"}
FIELDS = ["set", "generator", "particles", "volume_fraction", "recipe", "seed", *COLUMNS, "rings4", *NETWORK, "length", *RATIOS.values(), *BENDING.values()]
FARTHEST = 4.0  # diameters up to which directions are compared


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


def correlation_length(packing, tolerance):
    """Of the non-affine displacement under shear [diameters]: the integral over the distance, up to FARTHEST, of the mean cosine between the
    displacements of two particles, less the median displacement. A length of the response, as those of arXiv:2504.19568 and 2505.04554 are."""
    moved = coagula.shear(packing, bond_tolerance=tolerance, tolerance=1e-7).per_particle
    diameter, edges = 2 * packing.radii.mean(), numpy.diag(packing.edges)
    tree = scipy.spatial.cKDTree(numpy.mod(packing.positions, edges), boxsize=edges)
    pairs = tree.query_pairs(FARTHEST * diameter, output_type="ndarray")
    apart = packing.positions[pairs[:, 1]] - packing.positions[pairs[:, 0]]
    distance = numpy.linalg.norm(apart - edges * numpy.round(apart / edges), axis=1) / diameter
    cosines = numpy.zeros(len(pairs))
    for plane in ("xy", "xz", "yz"):
        displacement = numpy.asarray(moved[f"nonaffine_displacement_{plane}"])
        displacement = displacement - numpy.median(displacement, axis=0)
        direction = displacement / numpy.maximum(numpy.linalg.norm(displacement, axis=1), 1e-300)[:, None]
        cosines += numpy.einsum("pi,pi->p", direction[pairs[:, 0]], direction[pairs[:, 1]]) / 3
    shells = numpy.arange(1.0, FARTHEST + 0.25, 0.25)
    within = numpy.digitize(distance, shells)
    number = numpy.bincount(within, minlength=len(shells) + 1)
    mean = numpy.bincount(within, cosines, minlength=len(shells) + 1) / numpy.maximum(number, 1)
    return 1.0 + 0.25 * float(mean[1:len(shells)].sum())  # a particle moves with itself: the first diameter counts whole


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
                         **network_measures(structure, float(table["contact_tolerance"][number])),
                         "length": correlation_length(structure.packing, float(table["bond_tolerance"][number]))}
        column = RATIOS[float(table["shear-stiffness"][number])]
        resists = name == "bending" and str(table["model"][number]) == "bending_contacts.toml"
        rows[key][BENDING[column] if resists else column] = float(table["storage_modulus.mean"][number]) / 1e6
    return list(rows.values())


def diluted(name, folder, coordinations=(4.5, 4.7, 4.9)):
    """Dense networks without contacts that were drawn at random; large ones at one ratio of the stiffnesses."""
    ratios = RATIOS if name == "to_dilute" else {10.0: "G_0.1"}
    data = coagula.open_dataset(str(folder / f"{name}.h5"))
    table = data.table()
    for number in range(len(data)):
        if str(table["status"][number]) != "done":
            continue
        whole = Network.of_packing(data.structure(table["id"][number]).packing)
        order = numpy.random.default_rng(number).permutation(len(whole.bonds))
        for contacts in coordinations:
            part = whole.part(numpy.sort(order[:round(contacts * whole.particles / 2)]))
            moduli = {column: shear_modulus(part, 50.0, stiffness / 2) / 1e6 for stiffness, column in ratios.items()}
            yield {"set": name, "generator": "diluted", "particles": whole.particles,
                   "volume_fraction": 0.4, "recipe": contacts, "seed": int(table["seed"][number]), "a": float(table["doh.a"][number]),
                   **part.measures(), **moduli}


def main():
    folder, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    wanted = sys.argv[3:] or [*SETS, *DILUTED]
    rows = []
    if output.exists():
        with lzma.open(output, "rt", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["set"] not in wanted]
    for name in wanted:
        rows += diluted(name, folder) if name in DILUTED else rows_of(name, folder)
    with lzma.open(output, "wt", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, FIELDS, restval="")
        writer.writeheader()
        writer.writerows({name: f"{entry:.7g}" if isinstance(entry, float) else entry for name, entry in row.items()} for row in rows)
    print(f"{len(rows)} structures written to {output}")


if __name__ == "__main__":
    main()
