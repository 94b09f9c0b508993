#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""All eleven moduli of table 2 of Schenker et al. (2012) by the published test: plates of three layers, explicit steps, six orientations.

    tests/benchmark/reproduce_dem.py [--out published] [--rows 1/8,0mV,15mV:2000] [--particles 8000] [--oscillations 2] [--steps 20000]
                                     [--program build/bin/coagula] [--threads 1]

A row is named by voids per particle or by surface potential, and may have a number of particles of its own, 15mV:2000.
One structure per row, stopped at the published coordination number: six by void expansion, five by Brownian dynamics as
datasets/brownian_schenker2012/make.py makes them. Structures and finished rows are kept in OUT: a run that was interrupted goes on there, and a
finished row stands as it was measured until its file is deleted. Prints a Markdown table: G' of the last oscillation (amplitude 0.1 %) and its
standard deviation over the orientations, over the whole volume and in the measurement spheres (mean of the five, and the standard deviation of
single ones); "met" is within the published spread; the modulus at rest at a peak, which no rate enters; and that of the linear method in the
periodic cell. The seconds are those of the processor. Needs the Python standard library only.
"""
import argparse
import csv
import json
import os
import resource
import statistics
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

from reproduce_vem import run

DATASETS = Path(__file__).resolve().parents[2] / "datasets"
sys.path.insert(0, str(DATASETS / "brownian_schenker2012"))
from make import structure as coagulated  # noqa: E402

PUBLISHED_PARTICLES = 8000
MODEL = 'normal_strength = "1e-4 N"\nshear_strength = "1e-6 N"\n'  # table 1 of the paper
HEADER = ["structure", "N", "a (published)", "C (published)", "G' MPa", "published", "met", "in measurement spheres", "one sphere", "oscillations x steps",
          "phase, rad", "G' at rest", "broken bonds", "G' linear, periodic", "explicit test, s"]


def published_rows():
    """By name: generator, voids per particle or surface potential, and the published a, C, G' and its spread [MPa]."""
    rows = {}
    with open(DATASETS / "schenker2012" / "published_structures.csv") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            brownian = row["generator"] == "brownian"
            parameter = int(row["parameter"]) if brownian else Fraction(int(row["parameter"]), PUBLISHED_PARTICLES)
            rows[f"{parameter}mV" if brownian else str(parameter)] = (
                row["generator"], parameter, float(row["doh_a"]), float(row["coordination"]), float(row["G_Pa"]) / 1e6,
                float(row["G_spread_Pa"]) / 1e6)
    return rows


def structure(arguments, name, particles, kind, parameter, coordination):
    """Path of the structure, which is made if it is not there."""
    if kind == "brownian":
        return coagulated(arguments.program, arguments.out, particles, "coordination", parameter)[0]
    path = arguments.out / f"vem-{name.replace('/', '_')}-{particles}.h5"
    if not path.exists():
        run([arguments.program, "generate", "vem", "--particles", str(particles), "--voids", str(round(parameter * particles)),
             "--volume-fraction", "0.4", "--radius", "0.25um", "--target-coordination", str(coordination), "--seed", "1", "--json", "--quiet", "-o", path])
    return path


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(arguments, path):
    model = arguments.out / "model.toml"
    model.write_text(MODEL)
    common = ["--json", "--quiet"]
    found = run([arguments.program, "characterize", path, *common])
    linear = run([arguments.program, "shear", path, *common])
    start = processor_seconds()
    explicit = run([arguments.program, "shear", path, "--method", "dem", "--model", model, "--oscillations", str(arguments.oscillations),
                    "--steps-per-oscillation", str(arguments.steps), "--checkpoint", path.with_suffix(".checkpoint.h5"), *common])
    seconds = processor_seconds() - start
    path.with_suffix(".checkpoint.h5").unlink()
    version = subprocess.run([arguments.program, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    return {"version": version, "a": found["doh"]["a"], "C": found["coordination"], "linear": linear["storage_modulus"], "explicit": explicit,
            "seconds": seconds}


def finished_row(arguments, name, particles, kind, parameter, coordination):
    """What is measured of a structure, from OUT if it is there."""
    kept = arguments.out / f"{name.replace('/', '_')}-{particles}.json"
    if not kept.exists():
        row = measure(arguments, structure(arguments, name, particles, kind, parameter, coordination))
        unfinished = kept.with_suffix(".unfinished")
        unfinished.write_text(json.dumps(row))
        unfinished.rename(kept)
    return json.loads(kept.read_text())


def plus_minus(values):
    return f"{statistics.mean(values) / 1e6:.3f} ± {statistics.pstdev(values) / 1e6:.3f}"


def at_rest(moduli):
    """Of the orientations that came to rest; a soft network may not."""
    resting = [modulus for modulus in moduli if modulus is not None]
    if not resting:
        return "-"
    return plus_minus(resting) + ("" if len(resting) == len(moduli) else f" ({len(resting)} of {len(moduli)})")


def cells(name, particles, row, a, coordination, published, spread):
    explicit = row["explicit"]
    modulus, spheres = explicit["storage_modulus"], explicit["sphere_storage_modulus"]
    difference = modulus["mean"] / 1e6 - published
    met = "yes" if abs(difference) <= spread else f"no, {100 * difference / published:+.0f} %"
    single = statistics.pstdev([value for orientation in spheres for value in orientation]) / 1e6
    return [name if name.endswith("mV") else f"N_V/N = {name}", str(particles), f"{row['a']:.3f} ({a})", f"{row['C']:.2f} ({coordination})",
            f"{modulus['mean'] / 1e6:.3f} ± {modulus['std'] / 1e6:.3f}", f"{published} ± {spread}", met,
            plus_minus([statistics.mean(orientation) for orientation in spheres]), f"± {single:.3f}",
            f"{len(explicit['oscillations']['phase'][0])} x {explicit['steps_per_oscillation']}", f"{explicit['phase']:.4f}",
            at_rest(explicit["rest_modulus"]), str(explicit["broken_bonds"]),
            f"{row['linear']['mean'] / 1e6:.3f} ± {row['linear']['std'] / 1e6:.3f}", f"{row['seconds']:.0f}"]


def parse(rows):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("published"))
    parser.add_argument("--rows", default=",".join(rows), help="names separated by commas (default: all eleven)")
    parser.add_argument("--particles", type=int, default=8000)
    parser.add_argument("--oscillations", type=int, default=2)
    parser.add_argument("--steps", type=int, default=20000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--program", type=Path, default=Path("build/bin/coagula"))
    arguments = parser.parse_args()
    arguments.rows = [(name, int(particles or arguments.particles))
                      for name, _, particles in (word.partition(":") for word in arguments.rows.split(","))]
    for name, _ in arguments.rows:
        if name not in rows:
            parser.error(f"--rows: there is no row '{name}'; the rows are {', '.join(rows)}")
    arguments.program = arguments.program.resolve()
    os.environ["OMP_NUM_THREADS"] = str(arguments.threads)
    return arguments


def main():
    rows = published_rows()
    arguments = parse(rows)
    arguments.out.mkdir(parents=True, exist_ok=True)
    print("| " + " | ".join(HEADER) + " |\n" + "|---" * len(HEADER) + "|", flush=True)
    measured = {}
    for name, particles in arguments.rows:
        kind, parameter, a, coordination, modulus, spread = rows[name]
        row = finished_row(arguments, name, particles, kind, parameter, coordination)
        measured[name] = row["explicit"]["storage_modulus"]["mean"]
        print("| " + " | ".join(cells(name, particles, row, a, coordination, modulus, spread)) + " |", flush=True)
    if {"0mV", "15mV"} <= measured.keys():
        print(f"\nG' at 15 mV over G' at 0 mV: {measured['15mV'] / measured['0mV']:.2f} (published 3.4, experiment 3.6)")


if __name__ == "__main__":
    main()
