#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What explains the modulus of simulated structures: heterogeneity, coordination, weakly bonded particles?

    tests/benchmark/heterogeneity_and_coordination.py build/bin/coagula FOLDER

makes void expansion structures of 500 particles at the published numbers of voids and coordinations, and others of two numbers of voids at a
lower and a higher coordination, two seeds each; measures and shears them; and fits straight lines by least squares. Files that are in the
folder already are used. The published moduli of the six void expansion structures are diagnosed against the structures as a series.
"""

import json
import pathlib
import subprocess
import sys

PUBLISHED = [  # voids per particle, heterogeneity, coordination, modulus and its spread over the orientations [MPa] (table 2 of the paper)
    (1 / 8, 0.594, 4.68, 1.73, 0.383), (1 / 4, 0.521, 4.71, 1.83, 0.136), (1 / 2, 0.467, 4.69, 1.62, 0.190),
    (1, 0.418, 4.69, 1.32, 0.237), (13 / 8, 0.399, 4.69, 1.32, 0.267), (2, 0.392, 4.61, 1.17, 0.231)]
OTHERS = [(1 / 2, 4.35), (1 / 2, 5.0), (2, 4.35), (2, 5.0)]
PARTICLES = 500
SEEDS = (1, 2)


def run(program, *words):
    result = subprocess.run([program, *map(str, words), "--quiet"], check=True, capture_output=True, text=True)
    return json.loads(result.stdout) if "--json" in words else None


def measure(program, folder, name, voids_per_particle, coordination, seed):
    """(heterogeneity, coordination, share of particles with fewer than three contacts, modulus [MPa])"""
    path = folder / f"{name}_{seed}.h5"
    if not path.exists():
        run(program, "generate", "vem", "--particles", PARTICLES, "--voids", int(voids_per_particle * PARTICLES), "--volume-fraction", 0.4,
            "--radius", "0.25um", "--seed", seed, "--target-coordination", coordination, "-o", path)
    structure = run(program, "characterize", path, "--json", "--force", "-o", folder / "characterized.h5")
    response = run(program, "shear", path, "--json", "--force", "-o", folder / "sheared.h5")
    return structure["doh"]["a"], structure["coordination"], structure["below_three_fraction"], response["storage_modulus"]["mean"] / 1e6


def solve(matrix, right):
    """Gauss's elimination."""
    rows = [row[:] + [value] for row, value in zip(matrix, right)]
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(len(rows)):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def line(structures, columns):
    """Coefficients (constant first), share of the variance that is explained, and rms residual [MPa]."""
    design = [[1.0] + [row[column] for column in columns] for row in structures]
    moduli = [row[-1] for row in structures]
    normal = [[sum(x[i] * x[j] for x in design) for j in range(len(design[0]))] for i in range(len(design[0]))]
    coefficients = solve(normal, [sum(x[i] * y for x, y in zip(design, moduli)) for i in range(len(design[0]))])
    left = sum((y - sum(a * b for a, b in zip(x, coefficients)))**2 for x, y in zip(design, moduli))
    mean = sum(moduli) / len(moduli)
    return coefficients, 1 - left / sum((y - mean)**2 for y in moduli), (left / (len(moduli) - len(coefficients)))**0.5


def experiment(folder):
    files = [f"published{row + 1}_{seed}.h5" for row in range(len(PUBLISHED)) for seed in SEEDS]
    groups = [row + 1 for row in range(len(PUBLISHED)) for _ in SEEDS]
    table = ["heterogeneity,coordination,storage_modulus [MPa],spread [MPa]"]
    table += [f"{a},{coordination},{modulus},{spread}" for _, a, coordination, modulus, spread in PUBLISHED]
    (folder / "published.csv").write_text("\n".join(table) + "\n")
    path = folder / "published.toml"
    path.write_text('[sample]\nparticle_radius = "0.25 um"\n\n[structures]\n' + f"files = {json.dumps(files)}\ngroups = {groups}\n\n" +
                    '[[measurement]]\nkind = "structure-series"\nfile = "published.csv"\n' +
                    'standard_errors = { storage_modulus = "spread [MPa]" }\n')
    return path


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    published = [measure(program, folder, f"published{k + 1}", row[0], row[2], seed) for k, row in enumerate(PUBLISHED) for seed in SEEDS]
    others = [measure(program, folder, f"other{k + 1}", *row, seed) for k, row in enumerate(OTHERS) for seed in SEEDS]
    names = {0: "heterogeneity", 1: "coordination", 2: "share below three contacts"}
    for what, structures in (("published coordinations", published), ("all coordinations", published + others)):
        print(f"{what}, {len(structures)} structures")
        for columns in ((0,), (1,), (0, 1), (0, 1, 2)):
            coefficients, explained, residual = line(structures, columns)
            terms = ", ".join(f"{names[column]} {value:.3g}" for column, value in zip(columns, coefficients[1:]))
            print(f"  explained {100 * explained:3.0f} %, residual {residual:.3f} MPa: {terms}")
    found = run(program, "diagnose", experiment(folder), "-o", folder / "diagnosis", "--force", "--json")
    stiffness = found["base"]["parameters"]["normal_stiffness"]
    print(f"the published moduli: {found['verdict']}, p = {found['p_value']:.2g}, normal stiffness {stiffness['value']:.0f} N/m " +
          f"({stiffness['low']:.0f} to {stiffness['high']:.0f})")


if __name__ == "__main__":
    main()
