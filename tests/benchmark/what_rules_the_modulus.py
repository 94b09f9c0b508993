#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What rules the modulus of a network at equal volume fraction: heterogeneity, coordination, or what else?

    tests/benchmark/what_rules_the_modulus.py build/bin/coagula FOLDER [SHEAR_STIFFNESS]

makes structures by void expansion (several numbers of voids) and by Brownian dynamics (several surface potentials) to the same coordination
numbers, measures and shears them, and asks (1) which measures explain G' over all structures, with errors from structures that the fit has not
seen, (2) how much of the difference between the two generators at equal heterogeneity and coordination each measure accounts for, and (3) whether
the heterogeneity still matters at equal coordination and one measure more. Needs numpy; with gnuplot it draws
FOLDER/what_rules_SHEAR_STIFFNESS.png. The values of all structures go to FOLDER/structures_SHEAR_STIFFNESS.csv. What is in the folder already is
used. SHEAR_STIFFNESS: of a particle [N/m], 10 when not given; the normal one is 100.
"""

import concurrent.futures
import csv
import json
import pathlib
import shutil
import subprocess
import sys

import numpy

PARTICLES = 1000
VOIDS = (1 / 4, 1 / 2, 1, 13 / 8)  # per particle
POTENTIALS = (0, 12, 13, 14)  # mV
COORDINATIONS = (4.5, 4.7, 4.9)
SEEDS = (1, 2, 3)
MEASURES = ("coordination", "doh", "topology", "rings", "rigidity")
RESAMPLES = 2000

VARIABLES = {  # name: how it follows from the JSON object of characterize
    "heterogeneity a": lambda c: c["doh"]["a"],
    "coordination C": lambda c: c["coordination"],
    "redundancy per particle": lambda c: c["rigidity"]["redundancy_per_particle"],
    "freedom per particle": lambda c: c["rigidity"]["freedom_per_particle"],
    "normal share of redundancy": lambda c: c["rigidity"]["normal_redundancy_per_contact"] / c["rigidity"]["redundancy_per_contact"],
    "in the largest rigid cluster": lambda c: c["rigidity"]["largest_fraction"],
    "spread of the contacts": lambda c: c["topology"]["contact_spread"],
    "below three contacts": lambda c: c["below_three_fraction"],
    "rattlers": lambda c: c["rattler_fraction"],
    "triangles per particle": lambda c: c["topology"]["triangles"],
    "rings of 4": lambda c: c["rings"]["per_particle"][4],
    "rings of 5": lambda c: c["rings"]["per_particle"][5],
}
CARRIED = "energy in shear springs"  # not a measure of the structure: how it carries the load
BASE = ("heterogeneity a", "coordination C")


def run(program, *words):
    result = subprocess.run([program, *map(str, words), "--quiet", "--threads", "1"], check=True, capture_output=True, text=True)
    return json.loads(result.stdout) if "--json" in words else None


def structures():
    """(generator, its parameter, coordination number, seed)"""
    for coordination in COORDINATIONS:
        for seed in SEEDS:
            yield from (("vem", voids, coordination, seed) for voids in VOIDS)
            yield from (("brownian", potential, coordination, seed) for potential in POTENTIALS)


def generate(program, path, generator, parameter, coordination, seed):
    common = ("--particles", PARTICLES, "--volume-fraction", 0.4, "--radius", "0.25um", "--seed", seed, "-o", path)
    if generator == "vem":
        run(program, "generate", "vem", "--voids", int(parameter * PARTICLES), "--target-coordination", coordination, *common)
    else:
        run(program, "generate", "brownian", "--surface-potential", f"{parameter}mV", "--stop-coordination", coordination,
            "--sample-interval", "0.05ms", *common)


def measure(program, folder, structure, shear_stiffness):
    name = "_".join(str(round(part, 3)) for part in structure[1:])
    path = folder / f"{structure[0]}_{name}.h5"
    known = path.with_suffix(".json" if shear_stiffness == "10" else f".{shear_stiffness}.json")
    if not known.exists():
        if not path.exists():
            try:
                generate(program, path, *structure)
            except subprocess.CalledProcessError as error:  # some coordinations are out of reach of some numbers of voids
                print(f"{path.stem} left out: {error.stderr.strip()}", file=sys.stderr)
                return None
        found = run(program, "characterize", path, "--only", ",".join(MEASURES), "--json", "--force", "-o", path.with_suffix(".measured"))
        response = run(program, "shear", path, "--shear-stiffness", shear_stiffness, "--json", "--force", "-o",
                       known.with_suffix(".sheared"))
        row = {name: of(found) for name, of in VARIABLES.items()}
        row["G"] = response["storage_modulus"]["mean"] / 1e6
        row["affine G"] = response["affine_modulus"] / 1e6
        row[CARRIED] = response["load_structure"]["mean"]["shear_spring_share"]
        known.write_text(json.dumps(row))
    return json.loads(known.read_text())


def design(rows, names, brownian=None):
    columns = [numpy.ones(len(rows))] + [numpy.array([row[name] for row in rows]) for name in names]
    return numpy.column_stack(columns + ([brownian] if brownian is not None else []))


def fit(matrix, moduli):
    return numpy.linalg.lstsq(matrix, moduli, rcond=None)[0]


def unseen_residuals(matrix, moduli, groups):
    """Of structures that the fit has not seen; the seeds of one recipe are left out together."""
    residuals = numpy.empty_like(moduli)
    for group in set(groups):
        out = numpy.array([g == group for g in groups])
        residuals[out] = moduli[out] - matrix[out] @ fit(matrix[~out], moduli[~out])
    return residuals


def explained(residuals, moduli):
    return 1 - numpy.mean(residuals**2) / numpy.var(moduli)


def offsets(rows, names, brownian, moduli):
    """Brownian minus void expansion at equal values of the named measures [MPa], and resampled ones."""
    matrix = design(rows, names, brownian)
    generator = numpy.random.default_rng(1)
    draws = [numpy.concatenate([generator.choice(numpy.flatnonzero(brownian == kind), int(numpy.sum(brownian == kind)))
                                for kind in (0, 1)]) for _ in range(RESAMPLES)]
    return fit(matrix, moduli)[-1], numpy.array([fit(matrix[draw], moduli[draw])[-1] for draw in draws])


def transfer(rows, names, brownian, moduli):
    """Mean and rms error on Brownian structures of a line through those of void expansion alone [MPa]."""
    matrix = design(rows, names)
    error = moduli[brownian == 1] - matrix[brownian == 1] @ fit(matrix[brownian == 0], moduli[brownian == 0])
    return error.mean(), numpy.sqrt(numpy.mean(error**2))


def table(rows, groups, brownian):
    moduli = numpy.array([row["G"] for row in rows])
    others = [name for name in VARIABLES if name not in BASE]
    print(f"{len(rows)} structures of {PARTICLES} particles, {int(brownian.sum())} of them Brownian; G' {moduli.min():.2f} .. {moduli.max():.2f} MPa")
    print("\nvariance of G' explained in structures left out (per recipe), and rms error there")
    pairs = [("coordination C", name) for name in VARIABLES if name != "coordination C"]
    for names in [(name,) for name in (*VARIABLES, CARRIED)] + pairs + [(*BASE, name) for name in others]:
        residuals = unseen_residuals(design(rows, names), moduli, groups)
        print(f"  {' + '.join(names):62s} {100 * explained(residuals, moduli):5.0f} %   {numpy.sqrt(numpy.mean(residuals**2)):.3f} MPa")
    reference, resampled = offsets(rows, BASE, brownian, moduli)
    print(f"\nBrownian minus void expansion at equal a and C: {reference:.3f} +- {resampled.std():.3f} MPa")
    print("what is left of it at equal values of one measure more; the share explained; void expansion predicts Brownian: mean, rms error")
    for name in (None, *others):
        names = BASE if name is None else (*BASE, name)
        left, draws = offsets(rows, names, brownian, moduli)
        share = 1 - draws / resampled
        mean, rms = transfer(rows, names, brownian, moduli)
        print(f"  {name or '(a and C only)':30s} {left:7.3f} +- {draws.std():.3f} MPa   {100 * (1 - left / reference):5.0f} % "
              f"({100 * numpy.quantile(share, 0.05):.0f} to {100 * numpy.quantile(share, 0.95):.0f})   {mean:7.3f}, {rms:.3f} MPa")
    heterogeneity(rows, moduli)


def heterogeneity(rows, moduli):
    """Slope of G' along a at equal values of other measures, with the spread of resampled ones."""
    print("\nG' by a at equal C and one measure more, MPa per 0.1 of a; correlation of that measure with a at equal C")
    generator = numpy.random.default_rng(2)
    at_equal = lambda name: (lambda value: value - design(rows, BASE[1:]) @ fit(design(rows, BASE[1:]), value))(design(rows, (name,))[:, 1])
    for name in (None, *(name for name in VARIABLES if name not in BASE)):
        matrix = design(rows, BASE if name is None else (*BASE, name))
        draws = [generator.integers(len(rows), size=len(rows)) for _ in range(RESAMPLES)]
        slopes = [fit(matrix[draw], moduli[draw])[1] / 10 for draw in draws]
        alike = "" if name is None else f"   {numpy.corrcoef(at_equal(BASE[0]), at_equal(name))[0, 1]:5.2f}"
        print(f"  {name or '(C only)':30s} {fit(matrix, moduli)[1] / 10:7.3f} +- {numpy.std(slopes):.3f}{alike}")


FIGURE = """set terminal pngcairo size 1100,430 font 'DejaVu Sans,11'
set output 'PREFIX.png'
set datafile separator ','
set multiplot layout 1,2
set ylabel "G' (MPa)"
set key top left
set yrange [0:*]
set palette defined (4.5 '#7fc3e8', 4.9 '#08306b')
set cbrange [4.45:4.95]
set cblabel 'coordination C'
set xlabel 'degree of heterogeneity a'
plot 'PREFIX.csv' using ($1 == 0 ? $2 : NaN):4:3 with points pt 7 palette title 'void expansion', \\
  '' using ($1 == 1 ? $2 : NaN):4:3 with points pt 8 ps 1.2 lw 1.5 palette title 'Brownian'
set xlabel "G' from C and triangles per particle (MPa), recipe left out"
set xrange [0:*]
plot x with lines lc 'gray' notitle, 'PREFIX.csv' using ($1 == 0 ? $5 : NaN):4:3 with points pt 7 palette notitle, \\
  '' using ($1 == 1 ? $5 : NaN):4:3 with points pt 8 ps 1.2 lw 1.5 palette notitle
"""


def draw(rows, groups, brownian, prefix):
    moduli = numpy.array([row["G"] for row in rows])
    predicted = moduli - unseen_residuals(design(rows, ("coordination C", "triangles per particle")), moduli, groups)
    columns = (brownian, [row["heterogeneity a"] for row in rows], [row["coordination C"] for row in rows], moduli, predicted)
    numpy.savetxt(prefix.parent / f"{prefix.name}.csv", numpy.column_stack(columns), delimiter=",")
    if shutil.which("gnuplot"):
        subprocess.run(["gnuplot"], input=FIGURE.replace("PREFIX", prefix.name), text=True, cwd=prefix.parent, check=True)


def keep(structures, rows, path):
    """All values as a table."""
    names = ["G", *VARIABLES, "affine G", CARRIED]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["generator", "parameter", "target C", "seed", *names])
        writer.writerows([*structure, *(f"{row[name]:.6g}" for name in names)] for structure, row in zip(structures, rows))


def main():
    program, folder, shear_stiffness = sys.argv[1], pathlib.Path(sys.argv[2]), (*sys.argv[3:], "10")[0]
    folder.mkdir(parents=True, exist_ok=True)
    every = list(structures())
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda structure: measure(program, folder, structure, shear_stiffness), every))
    made = [(structure, row) for structure, row in zip(every, rows) if row is not None]
    found = [row for _, row in made]
    groups = [structure[:3] for structure, _ in made]
    brownian = numpy.array([float(structure[0] == "brownian") for structure, _ in made])
    keep([structure for structure, _ in made], found, folder / f"structures_{shear_stiffness}.csv")
    table(found, groups, brownian)
    draw(found, groups, brownian, folder / f"what_rules_{shear_stiffness}")


if __name__ == "__main__":
    main()
