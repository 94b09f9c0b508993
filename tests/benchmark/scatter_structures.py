# SPDX-License-Identifier: GPL-3.0-or-later
"""Structures by void expansion, and the command line, of the scripts that measure how far structures differ."""

import argparse
import json
import subprocess
from pathlib import Path

RADIUS = 0.25e-6


def run(program, *words):
    """What the program says, by one thread."""
    done = subprocess.run([program, *map(str, words), "--threads", "1", "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def structure(program, folder, particles, coordination, seed):
    """Path of a structure at a volume fraction of 0.4, which is made if it is not there."""
    path = folder / f"{particles}_{coordination}_{seed}.h5"
    if not path.exists():
        run(program, "generate", "vem", "--particles", particles, "--voids", particles // 2, "--volume-fraction", 0.4, "--radius", RADIUS,
            "--seed", 5000 + seed, "--target-coordination", coordination, "-o", path)
    return path


def program_and_folder(about):
    """From the command line; the folder is there then."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    chosen = parser.parse_args()
    chosen.folder.mkdir(parents=True, exist_ok=True)
    return chosen.program.resolve(), chosen.folder
