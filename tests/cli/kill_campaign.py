# SPDX-License-Identifier: GPL-3.0-or-later
"""Kills the program at every write, fsync and rename of its files and looks at what is left.

Whatever the moment, a file is whole: the old one or the new one. The next run removes what a killed one left, and a run that goes on
from a checkpoint ends with the same bytes as one that was never killed.

    COAGULA_PROGRAM=build/bin/coagula tests/cli/kill_campaign.py --kills 1000
"""

import argparse
import hashlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

import h5py

HERE = Path(__file__).resolve().parent
CSV = "x [um],y [um],z [um]\n1,1,1\n2.1,1,1\n1,2.1,1\n2.1,2.1,1.2\n5,5,5\n"
MODULI = "doh_a,storage_modulus [Pa]\n" + "".join(f"{0.5 + 0.05 * k},{1e5 * (0.2 + 0.05 * k) ** 1.5 * (1 + 0.01 * (-1) ** k)}\n" for k in range(8))
SWEEP = "frequency [Hz],storage_modulus [Pa],loss_modulus [Pa]\n" + "".join(f"{10 ** (k / 2 - 1)},{1e5 + 1e4 * k},{2e4 + 400 * (-1) ** k}\n" for k in range(6))
EXPERIMENT = """[sample]
particle_radius = "0.5 um"
[structures]
files = ["gel.h5"]
[[measurement]]
kind = "frequency-sweep"
file = "sweep.csv"
sample = "one"
"""
GEL = ["generate", "vem", "--particles", "60", "--volume-fraction", "0.4", "--radius", "0.5um", "-o", "gel.h5"]
BROWNIAN = ["generate", "brownian", "--particles", "60", "--volume-fraction", "0.3", "--radius", "0.25um", "--surface-potential", "0mV",
            "--equilibration-time", "10us", "--stop-time", "0.2ms", "--sample-interval", "10us"]
DEM = ["shear", "small.h5", "--method", "dem", "--boundary", "periodic", "--bond-tolerance", "0.2", "--oscillations", "6",
       "--steps-per-oscillation", "200", "--orientation", "xy,zx"]

# What each verb writes, and the call. The calls are repeated: files are replaced in place or by --force.
CALLS = {
    "import": ("made.h5", ["import", "small.csv", "--radius", "0.5um", "--box", "8um", "-o", "made.h5", "--force"]),
    "generate vem": ("vem.h5", ["generate", "vem", "--particles", "60", "--volume-fraction", "0.3", "--radius", "1um", "-o", "vem.h5",
                                "--force"]),
    "characterize": ("small.h5", ["characterize", "small.h5", "--only", "coordination,overlap"]),
    "shear": ("small.h5", ["shear", "small.h5", "--bond-tolerance", "0.2"]),
    "shear to a new file": ("sheared.h5", ["shear", "small.h5", "--bond-tolerance", "0.2", "-o", "sheared.h5", "--force"]),
    "export": ("small.csv.out.csv", ["export", "small.h5", "--format", "csv", "-o", "small.csv.out.csv", "--force"]),
    "calibrate": ("table.csv", ["calibrate", "small.h5", "--from", "50N/m", "--to", "100N/m", "--steps", "2", "-o", "table.csv",
                                "--force"]),
    "fit power-law": ("profile.csv", ["fit", "power-law", "moduli.csv", "--a", "doh_a", "--modulus", "storage_modulus", "--points", "20",
                                      "-o", "profile.csv", "--force"]),
    "diagnose": ("diagnosis", ["diagnose", "experiment.toml", "-o", "diagnosis", "--bootstrap", "99", "--causes", "contact-loss",
                               "--force"]),
    "diagnose new": ("new.toml", ["diagnose", "new", "sweep.csv", "-o", "new.toml", "--force"]),
    "report": ("page.html", ["report", "small.h5", "-o", "page.html", "--force"]),
    "plot": ("figure.svg", ["plot", "small.h5", "--figure", "packing", "-o", "figure.svg", "--force"]),
    "man": ("pages", ["man", "-o", "pages", "--force"]),
}
PICTURE = ["generate", "brownian", "--potential-curve", "--radius", "0.25um", "--surface-potential", "15mV", "--picture", "curve.svg", "--force"]
CALLS["generate brownian --picture"] = ("curve.svg", PICTURE)
KEY_FILE = "diagnosis.json"  # where it stands, all files of the folder are of one run
# Runs with checkpoints: the call and its result.
RESUMED = {
    "generate brownian": ("brownian.h5", [*BROWNIAN, "--checkpoint", "state.h5", "--checkpoint-interval", "0s", "-o", "brownian.h5"]),
    "shear --method dem": ("dem.h5", [*DEM, "--checkpoint", "state.h5", "-o", "dem.h5"]),
}


def data_sets(path):
    """Values by path, the history aside."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance"):
            value = item[()]
            found[name] = (str(item.dtype), item.shape, value if isinstance(value, bytes) else value.tobytes())

    with h5py.File(path) as file:
        file.visititems(visit)
    return found


def values_of(path):
    """What a file holds, apart from when and how fast it was made; of a folder by name."""
    if path.is_dir():
        return {part.name: values_of(part) for part in path.iterdir() if not part.name.startswith(".")}
    if path.suffix == ".h5":
        return data_sets(path)
    if path.suffix == ".json":
        return {name: value for name, value in json.loads(path.read_bytes()).items() if name != "seconds"}
    if path.suffix == ".html":
        return re.sub(rb"\d{4}-\d\d-\d\dT[\d:]+Z(, [\d.e-]+ s)?", b"", path.read_bytes())
    return path.read_bytes()


def checksum(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else ""


class Campaign:
    """Kills in a folder of its own. Every wrong finding is an AssertionError that says which kill led to it."""

    def __init__(self, program, seed=1):
        self.program = str(Path(program).resolve())
        self.folder = Path(tempfile.mkdtemp(prefix="coagula-kills-")).resolve()
        self.draw = random.Random(seed)
        self.library = self.folder.with_suffix(".so")
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", str(HERE / "kill_at.c"), "-o", str(self.library), "-ldl"], check=True)
        for name, text in (("small.csv", CSV), ("moduli.csv", MODULI), ("sweep.csv", SWEEP), ("experiment.toml", EXPERIMENT)):
            (self.folder / name).write_text(text)
        self.succeed(GEL)
        self.run(CALLS["import"][1])
        os.rename(self.folder / "made.h5", self.folder / "small.h5")
        self.kills = {}

    def close(self):
        shutil.rmtree(self.folder)
        self.library.unlink()

    def run(self, words, **environment):
        return subprocess.run([self.program, *words, "--quiet"], cwd=self.folder, env={**os.environ, **environment}, start_new_session=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=600)

    def kill(self, name, words, at, when):
        """True when the call was killed; otherwise it ended before and did well."""
        done = self.run(words, LD_PRELOAD=str(self.library), KILL_FOLDER=str(self.folder), KILL_AT=str(at), KILL_WHEN=when)
        if done.returncode == -signal.SIGKILL:
            self.kills[name] = self.kills.get(name, 0) + 1
            return True
        assert done.returncode == 0, f"{name}, killed {when} call {at}: {done.stderr}"
        return False

    def succeed(self, words):
        done = self.run(words)
        assert done.returncode == 0, f"{words}: {done.stderr}"

    def require_clean(self):
        hidden = [path.name for path in self.folder.rglob(".*")]
        assert not hidden, f"left behind: {hidden}"

    def require_whole(self, name, path, reference):
        """The values of the new file, which replaced an old one of the same values; only its history may differ."""
        found = values_of(path)
        if path.is_dir():
            half = KEY_FILE not in found and (path / ".whole").exists()  # the next run puts the rest in place
            assert half or found.keys() == reference.keys(), f"{name}: only {sorted(found)} are there"
            reference = {part: reference[part] for part in found}
        assert found == reference, f"{name}: {path.name} holds other values"

    def kill_everywhere(self, name):
        """Every call of the verb, at every moment of it."""
        output, words = CALLS[name]
        path = self.folder / output
        self.succeed(words)
        reference = values_of(path)
        at = 1
        while True:
            killed = [self.kill(name, words, at, when) for when in ("before", "half", "after")]
            self.require_whole(name, path, reference)
            if not any(killed):
                break
            at += 1
        assert at > 3, f"{name} wrote, synced and renamed less than expected"
        self.succeed(words)
        assert values_of(path) == reference, f"{name}: the run after the kills ends with other values"
        self.require_clean()

    def kill_a_new_file(self, name):
        """As long as the verb has not come to its end there is no file."""
        output, words = CALLS[name]
        path = self.folder / output
        words = [word for word in words if word != "--force"]
        for at in range(1, 5):  # write, fsync, rename, fsync of the folder
            for when in ("before", "half", "after"):
                path.unlink(missing_ok=True)
                killed = self.kill(name, words, at, when)
                renamed = at == 4 or (at == 3 and when != "before")
                assert path.exists() == (renamed or not killed), f"{name}: killed {when} call {at}"
        if path.exists():
            path.unlink()
        self.succeed(words)
        self.require_clean()

    def kill_and_resume(self, name):
        """One run in many pieces."""
        output, words = RESUMED[name]
        path, state = self.folder / output, self.folder / "state.h5"
        self.succeed([*words[:words.index("--checkpoint")], "-o", "whole.h5", "--force"])
        while True:
            before = checksum(state)
            at, when = self.draw.randint(1, 9), self.draw.choice(("before", "half", "after"))
            if not self.kill(name, words, at, when):
                break
            if checksum(state) != before:
                data_sets(state)
            if path.exists():  # killed behind the last rename
                self.succeed([*words, "--force"])  # and what that left goes
                break
        assert data_sets(path) == data_sets(self.folder / "whole.h5"), f"{name}: the pieces differ from the whole"
        path.unlink()
        state.unlink()

    def round(self):
        for name in CALLS:
            self.kill_everywhere(name)
        for name in ("import", "generate vem", "export"):
            self.kill_a_new_file(name)
        for name in RESUMED:
            self.kill_and_resume(name)
            self.require_clean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    campaign = Campaign(os.environ["COAGULA_PROGRAM"], arguments.seed)
    try:
        while sum(campaign.kills.values()) < arguments.kills:
            campaign.round()
            print("kills so far:", sum(campaign.kills.values()), flush=True)
    finally:
        print(json.dumps(campaign.kills, indent=2), "kills:", sum(campaign.kills.values()), flush=True)
    campaign.close()


if __name__ == "__main__":
    main()
