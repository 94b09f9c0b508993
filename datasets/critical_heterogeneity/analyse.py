#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What rules the modulus of a network of particles: the tables and the figure of this study.

    datasets/critical_heterogeneity/analyse.py index.csv.xz [FIGURE.png]

reads the index that tables.py has written and prints (1) how well measures of the structure predict G' for generators that the fit has not seen,
(2) what heterogeneity and the way of making leave over at equal contacts and triangles, (3) one variable for all generators, stiffness ratios, sizes
and volume fractions, and (4) what the published structures would need. Needs numpy; with gnuplot it draws the figure.
"""

import csv
import lzma
import pathlib
import shutil
import subprocess
import sys

import numpy

RESAMPLES = 1000
RATIOS = (1.0, 0.1, 0.01)  # shear over normal stiffness
MEASURES = {  # name: column of the index
    "heterogeneity a": "a",
    "coordination C": "C",
    "triangles per particle T": "triangles",
    "tetrahedra per particle": "tetrahedra",
    "contacts outside triangles": "outside",
    "particles with three contacts": "three",
    "particles with six contacts": "six",
    "largest cluster of those with six": "six_largest",
    "share of betweenness in a tenth": "betweenness",
    "particles in the largest dense cluster": "dense_largest",
    "contacts between dense clusters": "dense_between",
    "rings of four": "rings4",
    "redundancy per particle": "redundancy",
    "correlation length of the response": "length",
}
LAW = ("coordination C", "triangles per particle T")
PUBLISHED = pathlib.Path(__file__).parent.parent / "schenker2012" / "published_structures.csv"


def read(path):
    """The rows of the index: texts stay texts, numbers become numbers."""
    with lzma.open(path, "rt", encoding="utf-8") as file:
        return [{name: value if name in ("set", "generator") else float(value or "nan") for name, value in row.items()}
                for row in csv.DictReader(file)]


def published():
    """The rows of the paper's table."""
    with open(PUBLISHED, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def matrix_of(rows, names):
    return numpy.column_stack([numpy.ones(len(rows))] + [numpy.array([row[MEASURES[name]] for row in rows]) for name in names])


def column(rows, name):
    return numpy.array([row[name] for row in rows])


def fit(matrix, values):
    return numpy.linalg.lstsq(matrix, values, rcond=None)[0]


def unseen(matrix, values, groups):
    """Residuals of rows whose group the fit has not seen."""
    residuals = numpy.empty_like(values)
    for group in set(groups):
        out = groups == group
        residuals[out] = values[out] - matrix[out] @ fit(matrix[~out], values[~out])
    return residuals


def explained_with_error(matrix, values, groups):
    """Share of the variance that is explained where the generator is left out, its 90 % interval by resampled structures, and the rms error."""
    residuals = unseen(matrix, values, groups)
    generator = numpy.random.default_rng(1)
    shares = []
    for _ in range(RESAMPLES // 5):
        draw = generator.integers(len(values), size=len(values))
        left = unseen(matrix[draw], values[draw], groups[draw])
        shares.append(1 - numpy.mean(left**2) / numpy.var(values[draw]))
    return 1 - numpy.mean(residuals**2) / numpy.var(values), numpy.quantile(shares, (0.05, 0.95)), numpy.sqrt(numpy.mean(residuals**2))


def print_predictors(rows, modulus):
    groups = column(rows, "generator")
    names = [name for name in MEASURES if numpy.all(numpy.isfinite(column(rows, MEASURES[name])))]
    choices = [(name,) for name in names] + [("coordination C", name) for name in names if name != "coordination C"]
    choices.append(("coordination C", "triangles per particle T", "heterogeneity a"))
    print(f"{len(rows)} structures; generators {', '.join(sorted(set(groups)))}; each left out in turn")
    for chosen in choices:
        share, (low, high), error = explained_with_error(matrix_of(rows, chosen), modulus, groups)
        print(f"  {' + '.join(chosen):68s} {100 * share:5.0f} % ({100 * low:.0f} to {100 * high:.0f})   {error:.3f} MPa")


def resampled(rows, modulus, names, place):
    """A coefficient of the fit, and its standard deviation over resampled structures."""
    matrix = matrix_of(rows, names)
    generator = numpy.random.default_rng(2)
    draws = [generator.integers(len(rows), size=len(rows)) for _ in range(RESAMPLES)]
    return fit(matrix, modulus)[place], numpy.std([fit(matrix[draw], modulus[draw])[place] for draw in draws])


def print_left(rows):
    """What heterogeneity says at equal contacts and triangles, and what the way of making does."""
    for names in (LAW[:1], LAW, ("coordination C", "tetrahedra per particle")):
        for ratio in RATIOS:
            there = [row for row in rows if numpy.isfinite(row[f"G_{ratio:g}"])]
            value, error = resampled(there, column(there, f"G_{ratio:g}"), (*names, "heterogeneity a"), -1)
            print(f"  k_s/k_n = {ratio:<5g} G' by 0.1 of a at equal {' and '.join(names):48s} {value / 10:7.3f} +- {error / 10:.3f} MPa")
    modulus = column(rows, "G_0.1")
    left = modulus - matrix_of(rows, LAW) @ fit(matrix_of(rows, LAW), modulus)
    groups = column(rows, "generator")
    for group in sorted(set(groups)):
        own = left[groups == group]
        print(f"  {group:20s} off the common line by {own.mean():6.3f} +- {own.std() / len(own)**0.5:.3f} MPa")


def print_triangle_price(rows, kind="G"):
    """Contacts that a triangle takes away: G' = g (C - C0 - b T)."""
    for ratio in RATIOS:
        there = [row for row in rows if numpy.isfinite(row[f"{kind}_{ratio:g}"])]
        matrix, modulus = matrix_of(there, LAW), column(there, f"{kind}_{ratio:g}")
        generator = numpy.random.default_rng(3)
        draws = [fit(matrix[draw], modulus[draw]) for draw in (generator.integers(len(there), size=len(there)) for _ in range(RESAMPLES))]
        values = numpy.array([[-one[2] / one[1], -one[0] / one[1], one[1]] for one in [fit(matrix, modulus), *draws]])
        (price, onset, slope), errors = values[0], values[1:].std(axis=0)
        share = 1 - numpy.var(modulus - matrix @ fit(matrix, modulus)) / numpy.var(modulus)
        print(f"  k_s/k_n = {ratio:<5g} G' = {slope:.2f} MPa (C - {onset:.2f} - {price:.2f} T); errors {errors[2]:.2f}, {errors[1]:.2f}, {errors[0]:.2f}; "
              f"{100 * share:.0f} % of the variance, {len(there)} structures")


def collapse(rows, groups):
    """Places on the common variable C - b T, with b from the rows, and the share that a parabola through it explains in groups left out."""
    matrix, modulus = matrix_of(rows, LAW), column(rows, "G_0.1")
    _, by_contact, by_triangle = fit(matrix, modulus)
    place = matrix[:, 1] + by_triangle / by_contact * matrix[:, 2]
    residuals = unseen(numpy.vander(place - place.mean(), 3), modulus, groups)
    return place, 1 - numpy.mean(residuals**2) / numpy.var(modulus), numpy.sqrt(numpy.mean(residuals**2))


def print_sizes(rows, known):
    """Structures of other sizes, held against the line of those of 8000 particles."""
    law = fit(matrix_of(known, LAW), column(known, "G_0.1"))
    for particles in sorted({row["particles"] for row in rows}):
        there = [row for row in rows if row["particles"] == particles]
        off = column(there, "G_0.1") - matrix_of(there, LAW) @ law
        print(f"  N = {particles:g}: off the line by {off.mean():.3f} +- {off.std() / len(off)**0.5:.3f} MPa, {len(there)} structures")


def print_bending(rows):
    """The same structures with contacts that resist bending and twisting, beside contacts that do not."""
    for kind, words in (("G", "without bending"), ("bending", "with bending")):
        print(f"  {words}:")
        print_triangle_price(rows, kind)
    for ratio in RATIOS:
        more = column(rows, f"bending_{ratio:g}") / column(rows, f"G_{ratio:g}")
        value, error = resampled(rows, column(rows, f"bending_{ratio:g}"), (*LAW, "heterogeneity a"), -1)
        print(f"  k_s/k_n = {ratio:<5g} bending multiplies G' by {more.min():.2f} to {more.max():.2f}, median {numpy.median(more):.2f}; "
              f"G' with it by 0.1 of a at equal contacts and triangles {value / 10:.3f} +- {error / 10:.3f} MPa")


def print_fractions(rows, known):
    """The law of phi = 0.4, per volume, held against other volume fractions."""
    law = fit(matrix_of(known, LAW), column(known, "G_0.1") / 0.4)
    for fraction in sorted({row["volume_fraction"] for row in rows} - {0.4}):
        there = [row for row in rows if row["volume_fraction"] == fraction and numpy.isfinite(row["G_0.1"])]
        modulus = column(there, "G_0.1") / fraction
        off = modulus - matrix_of(there, LAW) @ law
        print(f"  phi = {fraction:g}: G'/phi off the law of phi = 0.4 by {off.mean():.2f} +- {off.std():.2f} MPa, of {modulus.mean():.2f}; {len(there)} structures")


def print_published(rows):
    """The published structures beside the law of ours."""
    constant, by_contact, by_triangle = fit(matrix_of(rows, LAW), column(rows, "G_0.1"))
    with_a = fit(matrix_of(rows, ("coordination C", "heterogeneity a")), column(rows, "triangles"))
    print("  structure                a      C     G' published   triangles for that G'   triangles of ours at that a and C")
    for row in published():
        a, contacts, modulus = float(row["doh_a"]), float(row["coordination"]), float(row["G_Pa"]) / 1e6
        needed = (modulus - constant - by_contact * contacts) / by_triangle
        print(f"  {row['generator'] + ' ' + row['parameter']:22s} {a:.3f}  {contacts:.2f}   {modulus:8.2f} MPa   {needed:18.2f} {with_a @ (1, contacts, a):26.2f}")


FIGURE = """set terminal pngcairo size 1200,470 font 'DejaVu Sans,11'
set output 'OUTPUT'
set multiplot layout 1,2
set ylabel "G' (MPa)"
set xlabel 'degree of heterogeneity a'
set yrange [0:*]
unset key
array shape[9] = [4, 5, 6, 7, 12, 9, 10, 1, 8]
array colour[9] = [0x88ccee, 0x44aa99, 0x117733, 0x332288, 0x8a2be2, 0xcc6677, 0xddaa33, 0x777777, 0]
plot for [k=0:KINDS-1] DATA index k using 1:3 with points pt shape[k+1] lc rgb colour[k+1] title columnheader(1), \\
  PUBLISHED with points pt 7 ps 1.6 lc 'black' title 'Schenker et al. 2012'
set xlabel 'contacts less the price of triangles, C - PRICE T'
set key bottom right samplen 1
plot for [k=0:KINDS-1] DATA index k using 2:3 with points pt shape[k+1] lc rgb colour[k+1] title columnheader(1), \\
  NaN with points pt 7 ps 1.6 lc 'black' title 'Schenker et al. 2012'
"""


def draw(rows, path):
    groups, modulus = column(rows, "generator"), column(rows, "G_0.1")
    place, _, _ = collapse(rows, groups)
    _, by_contact, by_triangle = fit(matrix_of(rows, LAW), modulus)
    kinds = sorted(set(groups))
    blocks = "\n\n".join(f'"{kind}"\n' + "\n".join(f"{row['a']} {at} {value}" for row, at, value in zip(rows, place, modulus)
                                                   if row["generator"] == kind) + "\n" for kind in kinds)
    points = "\n".join(f"{row['doh_a']} {float(row['G_Pa']) / 1e6}" for row in published())
    script = (FIGURE.replace("OUTPUT", str(path)).replace("KINDS", str(len(kinds))).replace("PRICE", f"{-by_triangle / by_contact:.2f}")
              .replace("DATA", "$data").replace("PUBLISHED", "$published"))
    text = f"$data << EOD\n{blocks}\nEOD\n$published << EOD\n{points}\nEOD\n{script}"
    subprocess.run(["gnuplot"], input=text, text=True, check=True)


def main():
    rows = [row for row in read(sys.argv[1]) if numpy.isfinite(row["G_0.1"])]
    with_diluted = [row for row in rows if row["set"].endswith("_8000")]
    ours = [row for row in with_diluted if row["generator"] != "diluted"]
    small = [row for row in rows if row["set"] in ("void_expansion", "brownian", "depletion", "to_dilute")]
    small_tuned = [row for row in small if row["generator"] not in ("depletion gel", "diluted")]
    print("G' at k_s/k_n = 0.1 predicted for a generator that the fit has not seen: share of the variance (90 % interval), rms error")
    for words, chosen in (("8000 particles", ours), ("the same with networks that were diluted at random", with_diluted),
                          ("2000 particles, with depletion gels and with diluted networks of 1000", small)):
        print(f"\n{words}")
        print_predictors(chosen, column(chosen, "G_0.1"))
    print("\nleft at equal contacts and triangles, 8000 particles without diluted networks")
    print_left(ours)
    print("\nthe price of a triangle, in contacts per particle")
    print_triangle_price(ours)
    print("\none variable, C - b T: variance that a parabola through it explains for what is left out")
    for name, chosen in (("8000 particles", ours), ("with diluted networks", with_diluted), ("2000 particles with gels and diluted networks", small)):
        _, share, error = collapse(chosen, column(chosen, "generator"))
        print(f"  {name}: {100 * share:.0f} %, {error:.3f} MPa, {len(chosen)} structures")
    print("\nother sizes beside that line")
    print_sizes([row for row in rows if row["set"] in ("sizes", "void_expansion", "brownian")], ours)
    print("\n2000 particles by themselves, without depletion gels")
    print_triangle_price(small_tuned)
    print_left(small_tuned)
    print("\nall generators of 2000 particles, and diluted networks of 1000, off their common line")
    print_left(small)
    print("\ncontacts that resist bending")
    print_bending([row for row in rows if row["set"] == "bending"])
    print("\nthe law of phi = 0.4 at other volume fractions")
    print_fractions(rows, ours)
    print("\nwhat the published structures would need")
    print_published(ours)
    if len(sys.argv) > 2 and shutil.which("gnuplot"):
        draw(with_diluted + [row for row in small if row["generator"] == "depletion gel"], pathlib.Path(sys.argv[2]))


if __name__ == "__main__":
    main()
