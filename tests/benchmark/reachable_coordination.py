#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which coordination the void expansion can reach: lowest and highest against volume fraction and voids per particle.

    tests/benchmark/reachable_coordination.py [--program build/bin/coagula] [--particles 500] [--picture FILE.png]

The program refuses a target that is too low or too high and says how far the packing comes; these numbers are read from its sentences.
Prints a Markdown table. --picture draws it and needs python3-matplotlib."""
import argparse
import os
import re
import subprocess
import tempfile

FRACTIONS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
RATIOS = (0.125, 0.5, 2)


def refusal(program, particles, voids, fraction, target):
    """The sentence of the refusal; empty where the target was reached."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, "generate", "vem", "--particles", str(particles), "--voids", str(voids), "--volume-fraction",
                               str(fraction), "--radius", "0.25um", "--target-coordination", str(target), "--quiet", "-o", "a.h5"],
                              cwd=folder, check=False, stderr=subprocess.PIPE, text=True)
    return done.stderr if done.returncode != 0 else ""


def number(pattern, sentence, otherwise):
    found = re.search(pattern, sentence)
    return float(found[1]) if found else otherwise


def lowest(program, particles, voids, fraction):
    return number(r"the packing has ([\d.]+) before any void", refusal(program, particles, voids, fraction, 0.01), 0.0)


def highest(program, particles, voids, fraction):
    """The highest target that the option takes is below 6. None where even that is too low."""
    sentence = refusal(program, particles, voids, fraction, 5.99)
    return None if "before any void" in sentence else number(r"the packing comes to ([\d.]+) where", sentence, 5.99)


def draw(found, picture):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.figure(figsize=(5.2, 3.4))
    pyplot.plot(FRACTIONS, [found[fraction, "low"] for fraction in FRACTIONS], "k--", label="lowest")
    for ratio in RATIOS:
        reached = [fraction for fraction in FRACTIONS if found[fraction, ratio] is not None]
        pyplot.plot(reached, [found[fraction, ratio] for fraction in reached], "o-", label=f"highest, {ratio:g} voids a particle")
    pyplot.xlabel("volume fraction")
    pyplot.ylabel("coordination that can be reached")
    pyplot.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncol=2, frameon=False)
    pyplot.savefig(picture, dpi=110, bbox_inches="tight", metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/bin/coagula")
    parser.add_argument("--particles", type=int, default=500)
    parser.add_argument("--picture")
    arguments = parser.parse_args()
    program, particles = os.path.abspath(arguments.program), arguments.particles
    heads = [f"highest, N_V/N = {ratio:g}" for ratio in RATIOS]
    print(f"| volume fraction | lowest | {' | '.join(heads)} |\n|---|---{'|---' * len(heads)}|")
    found = {}
    for fraction in FRACTIONS:
        found[fraction, "low"] = lowest(program, particles, particles // 2, fraction)
        for ratio in RATIOS:
            found[fraction, ratio] = highest(program, particles, round(ratio * particles), fraction)
        cells = [found[fraction, "low"], *(found[fraction, ratio] for ratio in RATIOS)]
        print(f"| {fraction:g} | " + " | ".join("none" if cell is None else f"{cell:.2f}" for cell in cells) + " |", flush=True)
    if arguments.picture:
        draw(found, arguments.picture)


if __name__ == "__main__":
    main()
