#!/usr/bin/env python3
"""Makes the five coagulated structures of Schenker et al. 2012 and measures them.

    datasets/brownian_schenker2012/make.py [--program build/bin/coagula] [--particles 8000] [--law RULE] [--potentials 0,12,13,14,15]
                                           [--out structures]

RULE: central        contacts that slide and roll freely, stopped when a is the published one (a time per structure: a fit)
      coordination   the same contacts, stopped when the coordination number is the published one
      sticking       contacts that do not slip, one stopping time for all
      slipping       contacts that slip beyond 0.3 of their elastic normal force, the same stopping time
      rolling        contacts that neither slip nor roll freely, the same stopping time

One suspension is brought to equilibrium at 50 mV; every structure starts from it. A run that was interrupted goes on from its checkpoint, a
structure that is there is measured and not made again. Prints one row per structure and writes them to OUT/table.csv.
"""

import argparse
import csv
import json
import subprocess
import sys
import time
from pathlib import Path

RADIUS, VOLUME_FRACTION, SEED = "0.25um", "0.4", "1"
# Simulated time in ms at which the degree of heterogeneity is the published one: a fit, one number per structure.
FITTED_STOP_TIME = {0: 3.06, 12: 6.59, 13: 9.36, 14: 38.1, 15: 247.5}
PUBLISHED_COORDINATION = {0: 4.52, 12: 4.84, 13: 4.75, 14: 5.08, 15: 4.97}
# One stop rule for all: half of the diffusion time R^2/D. Stiffnesses are 4e4 kB T/R^2.
STICKING = ["--contact-shear-stiffness", "2.59mN/m", "--stop-time", "36.4ms"]
CONTACT_LAWS = {"sticking": STICKING, "slipping": [*STICKING, "--friction", "0.3"], "rolling": [*STICKING, "--rolling-stiffness", "2.59mN/m"]}
COLUMNS = ["surface_potential_mV", "particles", "law", "time_ms", "doh_a", "coordination", "G_Pa", "G_spread_Pa", "seconds"]


def call(program, *words):
    done = subprocess.run([str(program), *map(str, words), "--json", "--quiet"], stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"coagula {' '.join(map(str, words))} failed")
    return json.loads(done.stdout)


def suspension(program, out, particles):
    path = out / f"suspension-{particles}.h5"
    if not path.exists():
        call(program, "generate", "brownian", "--particles", particles, "--volume-fraction", VOLUME_FRACTION, "--radius", RADIUS, "--seed", SEED,
             "--surface-potential", "50mV", "--stop-time", "1ms", "-o", path)
    return path


def end_of_run(law, potential):
    if law in CONTACT_LAWS:
        return CONTACT_LAWS[law]
    if law == "coordination":
        return ["--stop-coordination", PUBLISHED_COORDINATION[potential], "--sample-interval", "0.02ms"]
    return ["--stop-time", f"{FITTED_STOP_TIME[potential]}ms"]


def structure(program, out, particles, law, potential):
    """Its path, the seconds it took and the time simulated in ms, both empty if it was there."""
    path = out / f"{law}-{potential}mV-{particles}.h5"
    if path.exists():
        return path, "", ""
    begin = time.monotonic()
    made = call(program, "generate", "brownian", "--start", suspension(program, out, particles), "--surface-potential", f"{potential}mV", "--seed", SEED,
         *end_of_run(law, potential), "--checkpoint", path.with_suffix(".checkpoint.h5"), "-o", path)
    path.with_suffix(".checkpoint.h5").unlink(missing_ok=True)
    return path, f"{time.monotonic() - begin:.0f}", f"{1e3 * made['time']:.2f}"


def measure(program, path, particles, law, potential, seconds, simulated):
    found = call(program, "characterize", path)
    shear = call(program, "shear", path)["storage_modulus"]
    return dict(zip(COLUMNS, [potential, particles, law, simulated, round(found["doh"]["a"], 4), round(found["coordination"], 3), round(shear["mean"]), round(shear["std"]), seconds]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/bin/coagula"))
    parser.add_argument("--particles", type=int, default=8000)
    parser.add_argument("--law", choices=("central", "coordination", *CONTACT_LAWS), default="central")
    parser.add_argument("--potentials", default="0,12,13,14,15")
    parser.add_argument("--out", type=Path, default=Path("structures"))
    arguments = parser.parse_args()
    program, out, particles, law = arguments.program.resolve(), arguments.out, arguments.particles, arguments.law
    out.mkdir(parents=True, exist_ok=True)
    potentials = [int(word) for word in arguments.potentials.split(",")]
    suspension(program, out, particles)
    with open(out / "table.csv", "a", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        if file.tell() == 0:
            table.writeheader()
        for potential in potentials:
            path, seconds, simulated = structure(program, out, particles, law, potential)
            row = measure(program, path, particles, law, potential, seconds, simulated)
            table.writerow(row)
            file.flush()
            print(", ".join(f"{key} {value}" for key, value in row.items() if value != ""), flush=True)


if __name__ == "__main__":
    main()
