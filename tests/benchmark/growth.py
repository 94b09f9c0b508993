#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws how processor time grows with the number of particles, from the tables under "Speed" in tests/benchmark/README.md, and prints the
exponents between neighbouring sizes: tests/benchmark/growth.py [PICTURE.png]

Needs gnuplot and the Python standard library. The picture is docs/images/explanation/growth.png when none is named."""

import math
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
ROW = re.compile(r"^\| (generate vem|characterize|shear), N = (\d+)[^|]* \| [\d.]+ \| ([\d.]+) \| [\d.]+ \| `coagula", re.MULTILINE)

PLOT = """set terminal pngcairo size 900,640 font "DejaVu Sans,14"
set output "{picture}"
set logscale xy
set key top left
set grid
set xlabel "particles N"
set ylabel "processor time over N [ms]"
set xrange [700:800000]
set yrange [0.1:10]
plot {curves}
"""


def rows():
    """{work: [(N, processor seconds), ...]}, each by N."""
    found = {}
    for work, particles, seconds in ROW.findall((ROOT / "tests/benchmark/README.md").read_text()):
        found.setdefault(work, []).append((int(particles), float(seconds)))
    return {work: sorted(points) for work, points in found.items()}


def main():
    picture = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images/explanation/growth.png"
    works = rows()
    data, curves = "", []
    for number, (work, points) in enumerate(works.items()):
        data += f"$d{number} << EOD\n" + "".join(f"{n} {1e3 * seconds / n}\n" for n, seconds in points) + "EOD\n"
        curves.append(f'$d{number} with linespoints linewidth 2 pointtype {5 + 2 * number} title "{work}"')
        steps = [f"{math.log(t2 / t1) / math.log(n2 / n1):.2f}" for (n1, t1), (n2, t2) in zip(points, points[1:])]
        print(f"{work}: N = {', '.join(str(n) for n, _ in points)}; exponents {', '.join(steps)}")
    subprocess.run(["gnuplot"], input=data + PLOT.format(picture=picture, curves=", ".join(curves)), text=True, check=True)


if __name__ == "__main__":
    main()
