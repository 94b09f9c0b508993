# SPDX-License-Identifier: GPL-3.0-or-later
"""Hides effects in data and counts what `coagula diagnose` finds.

    python3 tests/benchmark/diagnosis_campaign/campaign.py --program build/bin/coagula --folder campaign --runs 200 --jobs 2

Each run draws a session (cases.py) from the seed of its number, writes experiment file and tables, runs the program and keeps what it said in
results.jsonl; runs that are there already are not repeated. The table of results.jsonl is printed at the end (table.py)."""

import argparse
import fcntl
import json
import os
import shutil
import subprocess
import time
import zlib
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy

import open_set
import shown_cases
from cases import ROWS as SESSION_ROWS, SETTLING_LOOK_ALIKES
from days import placed
from material import Material
from session import follow_up
from table import BREAKING, in_set, print_rows, print_table


ROWS = {**SESSION_ROWS, **shown_cases.ROWS, **open_set.ROWS}
DEFAULT_ROWS = ["null", "null-tails", "null-correlated", "null-offsets", "single", "pair", "tie", "outside"]
BREAKING_ROWS = {*BREAKING, "tie-yield"}
RUPTURE_ROWS = {"activated-rupture", "bond-strength-rates"}
SETTLING_ROWS = {"sedimentation", "volume-fraction-gradient", *(f"{name}-gaps" for name in SETTLING_LOOK_ALIKES)}
LOADED_ROWS = {"normal-load", "loading-relaxation"}
SERIES_ROWS = {"null-series", "structure-series", "missing-contacts", "prestress", "bond-bending-series"}
CONTACT_ROWS = {"structure-series", "tie-level", "bond-bending-series"}


def diagnose(program, experiment, cache, *words):
    """What the program says; its simulations go into and out of `cache`."""
    folder = experiment.parent / "diagnosis"
    folder.mkdir(exist_ok=True)
    if cache.exists():
        shutil.copy(cache, folder / "simulations.txt")
    done = subprocess.run([program, "diagnose", experiment, "-o", folder, "--force", "--json", "--threads", "1", "--quiet",
                           "--bootstrap", "399", *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    remember(folder / "simulations.txt", cache)
    return json.loads(done.stdout)


def remember(new, cache):
    """Adds what was simulated to what is known; other processes do the same."""
    with cache.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        known = cache.read_text().splitlines() if cache.exists() else []
        lines = dict.fromkeys(known + (new.read_text().splitlines() if new.exists() else []))
        if len(lines) > len(known):
            temporary = cache.with_suffix(".new")
            temporary.write_text("\n".join(lines) + "\n")
            temporary.rename(cache)


def session_of(row, number, generator, material):
    """Rows of the open set go through their effects one by one."""
    return ROWS[row](generator, material, number) if row in open_set.ROWS else ROWS[row](generator, material)


def allowed_causes(row, program, truth):
    """Of the command line: all but the true one, where that is struck from the catalogue."""
    if row != "struck":
        return ()
    listed = subprocess.run([program, "diagnose", "catalogue", "--json"], capture_output=True, text=True, check=True)
    return ("--causes", ",".join(cause["name"] for cause in json.loads(listed.stdout) if cause["name"] != truth))


def drawn_by(row, number):
    """The random generator of a run, whatever other rows there are."""
    return numpy.random.default_rng([zlib.crc32(row.encode()), number])


def prepared(row, number, program, folder, proposals=()):
    """The session of a run with the tables that were proposed, and its experiment file; the same errors whatever follows."""
    generator = drawn_by(row, number)
    material = Material(program, folder / f"bank{os.getpid()}", shared=folder / "bank")
    session = session_of(row, number, generator, material)
    place = folder / "runs" / f"{row}_{number}"
    experiment = session.write(material, place, generator)
    for count, what in enumerate(proposals):
        session.tables += placed([replace(table, sample=f"{table.sample}{count}") for table in follow_up(session, what)])
    if proposals:
        generator = drawn_by(row, number)
        session_of(row, number, generator, material)
        experiment = session.write(material, place, generator)
    return session, material, experiment


def resolve(row, number, program, folder, found, truth, seed):
    """Makes the measurement that is proposed, and then the next ones; after how many the true cause alone is left, 0 if never."""
    proposals = []
    for count in (1, 2, 3):
        proposals.append(found["proposed_measurement"]["what"])
        _, _, experiment = prepared(row, number, program, folder, proposals)
        found = diagnose(program, experiment, folder / "simulations.txt", *seed)
        if found["verdict"] == "named" and in_set(truth, found["credible_set"]):
            return count, proposals
        if "proposed_measurement" not in found:
            break
    return 0, proposals


def stated_share(causes):
    """The posterior of the credible set: in how many of such runs it should hold the truth."""
    total = 0.0
    for cause in sorted(causes, key=lambda each: -each["posterior"]):
        if total >= 0.95:
            break
        total += cause["posterior"]
    return total


def run(row, number, program, folder):
    session, material, experiment = prepared(row, number, program, folder)
    place = experiment.parent
    started = time.time()
    seed = ("--seed", str(number + 1))  # or all tests share the errors of one bootstrap
    found = diagnose(program, experiment, folder / "simulations.txt", *seed, *allowed_causes(row, program, session.hidden.name))
    entry = {"row": row, "number": number, "truth": session.hidden.name, "hidden": {key: value for key, value in vars(session.hidden).items() if not callable(value)}, "stiffness": session.stiffness,
             "gain": session.gain(material), "wall": time.time() - started}
    keep = ("detected", "p_value", "verdict", "credible_set", "gain", "extended_p_value", "proposed_measurement", "seconds",
            "notes", "remainder", "level_alone", "follows", "conditions")
    entry["found"] = {key: found.get(key) for key in keep}
    entry["found"]["statistics"] = found.get("statistics", [])[:2]
    entry["found"]["causes"] = [{key: cause[key] for key in ("name", "posterior", "parameters")} for cause in found["causes"]
                                if cause["posterior"] > 0.01 or cause["name"] == session.hidden.name]
    entry["found"]["stated"] = stated_share(found["causes"])
    told = session.hidden.name
    in_catalogue = row not in ("outside", "contacts-removed", "volume-fraction", *open_set.ROWS) and told != "nothing" and " + " not in told
    if in_catalogue and found["detected"] and found["causes"][0]["name"] != told:
        entry["told"] = diagnose(program, experiment, folder / "simulations.txt", "--causes", told, *seed).get("gain")
    if row in ("tie", "tie-stiffening", "tie-yield") and found["verdict"] == "tied" and "proposed_measurement" in found:
        entry["resolved_after"], entry["proposals"] = resolve(row, number, program, folder, found, told, seed)
    shutil.rmtree(place)
    return entry


def attempt(task):
    try:
        return run(*task)
    except Exception as problem:  # one bad run must not lose the others
        return {"row": task[0], "number": task[1], "problem": str(problem)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, type=Path)
    parser.add_argument("--folder", required=True, type=Path)
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--rows", nargs="*", choices=sorted(ROWS), default=DEFAULT_ROWS)
    chosen = parser.parse_args()
    program, folder = chosen.program.resolve(), chosen.folder.resolve()
    (folder / "bank").mkdir(parents=True, exist_ok=True)
    Material(program, folder / "bank").prepare(jobs=chosen.jobs, breaking=not BREAKING_ROWS.isdisjoint(chosen.rows),
                                                   series=not SERIES_ROWS.isdisjoint(chosen.rows), contacts=not CONTACT_ROWS.isdisjoint(chosen.rows),
                                                   dragged="drag" in chosen.rows, rupture=not RUPTURE_ROWS.isdisjoint(chosen.rows),
                                                   settling=not SETTLING_ROWS.isdisjoint(chosen.rows),
                                                   hertzian="contact-nonlinearity" in chosen.rows, loaded=not LOADED_ROWS.isdisjoint(chosen.rows))
    results = folder / "results.jsonl"
    done = {(each["row"], each["number"]) for each in map(json.loads, results.open())} if results.exists() else set()
    tasks = [(row, number, program, folder) for number in range(chosen.runs) for row in chosen.rows if (row, number) not in done]
    with ProcessPoolExecutor(chosen.jobs) as pool, results.open("a") as file:
        for entry in pool.map(attempt, tasks):
            file.write(json.dumps(entry, default=float) + "\n")
            file.flush()
    print_table(results)
    print_rows(results)


if __name__ == "__main__":
    main()
