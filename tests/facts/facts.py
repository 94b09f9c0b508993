#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Facts that the program told of recorded experiments and structures, and whether it still tells them.

    tests/facts/facts.py --program build/bin/coagula --datasets build/datasets                compares, and prints what differs
    tests/facts/facts.py ... 'oil-*' 'campaign-*'                                             these only
    tests/facts/facts.py ... --record ['oil-*']                                               keeps what the program tells now

A fact of a diagnosis is a number, a name or a truth of diagnosis.json; sentences, times and paths are none. Facts of generate, characterize
and shear are the numbers that they print, and one digest of all data sets, which counts on the kind of processor that recorded it.
experiments.tar.xz holds a folder for each experiment: experiment.toml, its tables and structures, `call` with further words, `links`
with the files that lie in datasets/, and simulations.txt where what takes long was simulated before. expected.json.xz holds the facts."""

import argparse
import fnmatch
import hashlib
import json
import lzma
import math
import shutil
import subprocess
import sys
import tarfile
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXPERIMENTS = HERE / "experiments.tar.xz"
EXPECTED = HERE / "expected.json.xz"
TOLERANCE = 1e-6
OUT_OF_SETS = 0.05  # posterior: a set holds 95 %

# Sentences, times, paths, and what is left of a number by rounding.
NO_FACTS = {"residual", "words", "sentence", "statement", "notes", "what", "seconds", "report", "extended_model", "extended_structures", "proposed_measurement",
            "labels", "call", "command", "file", "output", "version"}
# Numbers between 0 and 1, and logarithms of ratios: what counts is their difference, not its part of a small one.
OF_ORDER_ONE = {"posterior", "p_value", "extended_p_value", "information", "predicted_resolution", "log_bayes_factor", "bayes_factor",
                "autocorrelation", "excess_kurtosis", "elpd_difference", "elpd_ci90"}

VEM = "generate vem --particles 150 --voids 75 --volume-fraction 0.4 --radius 0.25um --seed 1"
RECIPES = {
    "vem": [f"{VEM} -o s.h5", "characterize s.h5 --samples 5000", "shear s.h5"],
    "vem-coordination": [f"{VEM} --target-coordination 4.6 -o s.h5", "characterize s.h5 --samples 5000", "shear s.h5 --model bending.toml"],
    "vem-sizes": [f"{VEM} --size-distribution lognormal:0.2 -o s.h5", "characterize s.h5 --samples 5000", "shear s.h5"],
    "vem-dense": ["generate vem --particles 120 --voids 40 --volume-fraction 0.48 --radius 1um --seed 3 -o s.h5",
                  "characterize s.h5 --samples 5000", "shear s.h5"],
    "frequency": [f"{VEM} -o s.h5", "shear s.h5 --model losses.toml --frequency 0.1Hz,1Hz,10Hz"],
    "drag": [f"{VEM} -o s.h5", "shear s.h5 --model drag.toml --frequency 1Hz,100Hz"],
    "quasistatic": [f"{VEM} -o s.h5", "shear s.h5 --method quasistatic --amplitudes 1e-3 --orientation xy"],
    "quasistatic-breaking": [f"{VEM} -o s.h5", "shear s.h5 --method quasistatic --model strength.toml --ramp 1e-3 --ramp-steps 10 --orientation xy"],
    "explicit": [f"{VEM} -o s.h5", "shear s.h5 --method dem --boundary periodic --oscillations 1 --amplitude 1e-5 --orientation xy"],
    "explicit-breaking": [f"{VEM} -o s.h5", "shear s.h5 --method dem --boundary periodic --model strength.toml --oscillations 2 --amplitude 5e-4 --orientation xy"],
    "brownian": ["generate brownian --particles 40 --volume-fraction 0.2 --radius 0.25um --surface-potential 0mV --equilibration-time 1us "
                 "--stop-time 0.2ms --sample-interval 50us --seed 1 -o s.h5", "characterize s.h5 --samples 2000"],
    "wide-bonds": [f"{VEM} -o s.h5", "shear s.h5 --bond-tolerance 0.03 --shear-stiffness 50N/m"],
}
MODELS = {
    "bending.toml": "bending_stiffness = 3e-15\ntwisting_stiffness = 3e-15\n",
    "losses.toml": "normal_viscosity = 0.05\nshear_viscosity = 0.005\nnormal_maxwell_stiffness = 10\nnormal_maxwell_time = 0.1\n",
    "drag.toml": "solvent_viscosity = 0.001\n",
    "strength.toml": "normal_strength = 1.25e-9\nshear_strength = 1.25e-9\n",
}


def settled(cause):
    """Without the best values of a cause that is in no set: where its likelihood is flat, rounding errors choose them. Their intervals stay."""
    if cause.get("posterior", 1) >= OUT_OF_SETS or not isinstance(cause.get("parameters"), dict):
        return cause
    return cause | {"parameters": {name: {key: each for key, each in one.items() if key != "value"} for name, one in cause["parameters"].items()}}


def facts_in(value):
    """What of a printed object is facts; numbers with ten digits. Causes are found by their names: the last of them, as probable as others, are
    in any order."""
    if isinstance(value, dict):
        if "causes" in value:
            value = value | {"causes": {cause["name"]: settled(cause) for cause in value["causes"]}}
        return {key: facts_in(each) for key, each in value.items() if key not in NO_FACTS and not (key == "where" and isinstance(each, str))}
    if isinstance(value, list):
        return [facts_in(each) for each in value]
    return float(f"{value:.10g}") if isinstance(value, float) else value


def scale_of(path, siblings):
    """What a number is small against, besides itself: an interval against its value, a row against its measured value."""
    if path[-1] in OF_ORDER_ONE or "sample_effects" in path:
        return 1.0
    if isinstance(siblings, dict) and ({"low", "high"} <= siblings.keys() or "rows" in path):
        return max((abs(each) for key, each in siblings.items() if isinstance(each, float)), default=0.0)
    return 0.0


def differences(expected, found, path=(), siblings=None):
    """A line for each fact that differs."""
    where = "/".join(map(str, path))
    both_numbers = all(isinstance(each, (int, float)) and not isinstance(each, bool) for each in (expected, found))
    if isinstance(expected, dict) and isinstance(found, dict):
        for key in expected.keys() | found.keys():
            if key not in expected or key not in found:
                yield f"{where}/{key}: is {'new' if key not in expected else 'missing'}"
            else:
                yield from differences(expected[key], found[key], (*path, key), expected)
    elif isinstance(expected, list) and isinstance(found, list) and len(expected) == len(found):
        for number, (one, other) in enumerate(zip(expected, found)):
            yield from differences(one, other, (*path, number), expected if siblings is None else siblings)
    elif both_numbers:
        scale = scale_of([each for each in path if isinstance(each, str)], siblings)
        if not math.isclose(expected, found, rel_tol=TOLERANCE, abs_tol=TOLERANCE * scale):
            yield f"{where}: {expected:.10g} -> {found:.10g}"
    elif expected != found or type(expected) is not type(found):
        yield f"{where}: {json.dumps(expected)[:120]} -> {json.dumps(found)[:120]}"


def processor():
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    flags = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    return hashlib.sha256(" ".join(sorted(flags.split())).encode()).hexdigest()[:12]


def digest_of(path):
    """Of name, type and bytes of each data set; /provenance has times."""
    import h5py
    digest = hashlib.sha256()

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance"):
            value = item[()]
            digest.update(f"{name} {item.dtype} {item.shape}".encode())
            digest.update(value if isinstance(value, bytes) else value.tobytes())

    with h5py.File(path) as file:
        file.visititems(visit)
    return digest.hexdigest()


class Program:
    def __init__(self, path, datasets):
        self.path = Path(path).resolve()
        self.datasets = Path(datasets).resolve()

    def run(self, folder, words):
        done = subprocess.run([self.path, *words, "--json", "--threads", "1", "--force"], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip())
        return facts_in(json.loads(done.stdout))

    def diagnosed(self, folder):
        links = folder / "links"
        for line in links.read_text().splitlines() if links.exists() else []:
            name, target = line.split("\t")
            (folder / name).symlink_to(self.datasets / target)
        if (folder / "simulations.txt").exists():
            (folder / "results").mkdir()
            (folder / "simulations.txt").rename(folder / "results" / "simulations.txt")
        words = (folder / "call").read_text().split()
        found = self.run(folder, ["diagnose", "experiment.toml", "-o", "results", *words])
        shutil.rmtree(folder / "results")
        return found

    def made(self, folder, commands):
        """What the commands of a recipe print, and what is in the file then."""
        folder.mkdir()
        for name, text in MODELS.items():
            (folder / name).write_text(text)
        printed = [self.run(folder, command.split()) for command in commands]
        return {"printed": printed, "digest": {processor(): digest_of(folder / "s.h5")}}


def all_facts(program, wanted, jobs, tell):
    """The facts of the recipes and experiments with these names; a text instead where one failed."""
    with tempfile.TemporaryDirectory(prefix="coagula-facts-") as place, ThreadPoolExecutor(jobs) as pool:
        place = Path(place)
        with tarfile.open(EXPERIMENTS) as archive:
            archive.extractall(place / "experiments")
        tasks = {f"recipe-{name}": lambda name=name: program.made(place / name, RECIPES[name]) for name in RECIPES}
        tasks |= {folder.name: lambda folder=folder: program.diagnosed(folder) for folder in sorted((place / "experiments").iterdir())}
        chosen = {name: task for name, task in tasks.items() if any(fnmatch.fnmatch(name, each) for each in wanted)}

        def attempt(name):
            try:
                return chosen[name]()
            except RuntimeError as problem:
                return f"failed: {problem}"
            finally:
                tell(name)

        return dict(zip(chosen, pool.map(attempt, chosen)))


def comparable(expected, found):
    """Digests count where both processors are of one kind."""
    if isinstance(expected, dict) and "digest" in expected and isinstance(found, dict) and found.get("digest", {}).keys() != expected["digest"].keys():
        return expected | {"digest": found.get("digest")}
    return expected


def names_in_archive():
    with tarfile.open(EXPERIMENTS) as archive:
        return {Path(name).parts[0] for name in archive.getnames()}


def read_expected():
    return json.loads(lzma.decompress(EXPECTED.read_bytes())) if EXPECTED.exists() else {}


def record(found):
    """Keeps these facts beside those of the other names; refuses failures."""
    failed = [f"{name} {facts}" for name, facts in found.items() if isinstance(facts, str)]
    if failed:
        sys.exit("\n".join(failed))
    text = json.dumps(read_expected() | found, sort_keys=True, separators=(",", ":"))
    EXPECTED.write_bytes(lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))
    print(f"recorded {len(found)}")


def compare(found):
    """Prints what differs; how many of these names have a difference."""
    expected, wrong = read_expected(), 0
    for name, facts in found.items():
        lines = list(differences(comparable(expected.get(name), facts), facts))
        wrong += bool(lines)
        for line in lines[:12]:
            print(f"{name}: {line}")
        if len(lines) > 12:
            print(f"{name}: ... {len(lines) - 12} more")
    print(f"{len(found) - wrong} of {len(found)} as recorded")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=["*"])
    parser.add_argument("--program", required=True)
    parser.add_argument("--datasets", required=True)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    chosen = parser.parse_args()
    tell = (lambda name: None) if chosen.quiet else (lambda name: print(name, file=sys.stderr, flush=True))
    found = all_facts(Program(chosen.program, chosen.datasets), chosen.names or ["*"], chosen.jobs, tell)
    if not found:
        sys.exit("no experiment has such a name")
    if chosen.record:
        record(found)
    elif compare(found):
        sys.exit(1)


if __name__ == "__main__":
    main()
