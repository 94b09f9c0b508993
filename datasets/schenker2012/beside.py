#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The structures of structures.toml beside those published: a Markdown table.

    datasets/schenker2012/beside.py TABLE.csv

TABLE.csv is what `coagula dataset table` writes of their set. Needs the Python standard library only."""
import csv
import sys
from pathlib import Path


def rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def beside(value, published, digits):
    difference = 100 * (value / published - 1)
    return f"{value:.{digits}f} ({published:.{digits}f}), {difference:+.1f} %"


def main():
    made = rows(sys.argv[1])
    published = rows(Path(__file__).parent / "published_structures.csv")
    print("| structure | a (published) | C (published) | G' MPa (published) | spread of G' over six orientations (published) |\n|---|---|---|---|---|")
    for one in made:
        vem = one["generator"] == "vem"
        number = float(one["voids"]) if vem else 1e3 * float(one["surface-potential [V]"])
        name = f"{number:.0f} voids" if vem else f"{number:.0f} mV"
        other = [row for row in published if (row["generator"] == "vem") == vem and abs(float(row["parameter"]) - number) < 1e-6]
        modulus, spread = (float(one[f"storage_modulus.{key} [Pa]"]) / 1e6 for key in ("mean", "std"))
        if other:
            cells = [beside(float(one["doh.a"]), float(other[0]["doh_a"]), 3), beside(float(one["coordination"]), float(other[0]["coordination"]), 2),
                     beside(modulus, float(other[0]["G_Pa"]) / 1e6, 3), f"{spread:.3f} ({float(other[0]['G_spread_Pa']) / 1e6:.3f})"]
        else:
            cells = [f"{float(one['doh.a']):.3f}", f"{float(one['coordination']):.2f}", f"{modulus:.3f}", f"{spread:.3f}"]
        print("|", " | ".join([name, *cells]), "|")


if __name__ == "__main__":
    main()
