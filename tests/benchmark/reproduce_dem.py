#!/usr/bin/env python3
"""The void-expansion half of table 2 of Schenker et al. (2012) by the published shear test: plates, six orientations, explicit steps.

    tests/benchmark/reproduce_dem.py [--particles 8000] [--oscillations 2] [--steps 20000] [--program build/bin/coagula] [--threads 1]

One structure per row, grown to the published coordination number. Prints a Markdown table: G' of the last oscillation (amplitude 0.1 %) with its
standard deviation over the orientations, the value at rest at a peak, which no rate enters, and the linear method in the periodic cell.
Needs the Python standard library only.
"""
import argparse
import os
import statistics
import tempfile
import time

from reproduce_vem import PUBLISHED, run

MODEL = 'normal_strength = "1e-4 N"\nshear_strength = "1e-6 N"\n'  # table 1 of the paper


def one_row(arguments, folder, ratio, coordination):
    path, model = os.path.join(folder, "vem.h5"), os.path.join(folder, "model.toml")
    with open(model, "w") as file:
        file.write(MODEL)
    run([arguments.program, "generate", "vem", "--particles", str(arguments.particles), "--voids",
         str(round(ratio * arguments.particles)), "--volume-fraction", "0.4", "--radius", "0.25um", "--target-coordination",
         str(coordination), "--seed", "1", "--json", "--quiet", "-o", path])
    linear = run([arguments.program, "shear", path, "--json", "--quiet"])
    start = time.monotonic()
    explicit = run([arguments.program, "shear", path, "--method", "dem", "--model", model, "--oscillations",
                    str(arguments.oscillations), "--steps-per-oscillation", str(arguments.steps), "--threads", str(arguments.threads),
                    "--json", "--quiet"])
    return linear, explicit, time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--particles", type=int, default=8000)
    parser.add_argument("--oscillations", type=int, default=2)
    parser.add_argument("--steps", type=int, default=20000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--program", default="build/bin/coagula")
    arguments = parser.parse_args()
    print("| N_V/N | G' MPa, plates, explicit | phase, rad | G' at rest | in measurement spheres | broken bonds | G' linear, periodic | "
          "published | explicit test, s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for ratio, name, _, coordination, published, spread in PUBLISHED:
        with tempfile.TemporaryDirectory() as folder:
            linear, explicit, seconds = one_row(arguments, folder, ratio, coordination)
        modulus, rest = explicit["storage_modulus"], explicit["rest_modulus"]
        spheres = [value for row in explicit["sphere_storage_modulus"] for value in row]
        print(f"| {name} | {modulus['mean'] / 1e6:.3f} ± {modulus['std'] / 1e6:.3f} | {explicit['phase']:.3f} | "
              f"{statistics.mean(rest) / 1e6:.3f} ± {statistics.pstdev(rest) / 1e6:.3f} | {statistics.mean(spheres) / 1e6:.3f} | "
              f"{explicit['broken_bonds']} | {linear['storage_modulus']['mean'] / 1e6:.3f} ± "
              f"{linear['storage_modulus']['std'] / 1e6:.3f} | {published} ± {spread} | {seconds:.0f} |", flush=True)


if __name__ == "__main__":
    main()
