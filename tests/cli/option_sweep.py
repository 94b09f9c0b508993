#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every numeric option of every verb, as --help lists them, at values that nobody means: 0, negative, tiny, huge, not a number, and the
ends of its range. The program may refuse with a sentence, work, or run long and stop on Ctrl-C. A crash, a hang, a number that is
missing from the results of a call that succeeds, or a file that a refused call leaves behind is a defect. A value that is out of the
range of its option is given to the first call of a verb only.

    option_sweep.py PROGRAM [VERB ...]"""

import collections
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STRANGE = ["0", "-1", "5e-324", "-5e-324", "1e-300", "1e150", "-1e150", "1e300", "1.8e308", "nan", "inf"]
STRANGE_COUNTS = ["0", "-1", "9223372036854775807", "-9223372036854775808", "1e300", "nan"]
PATIENCE = 0.5  # seconds until Ctrl-C
HANGING = 5  # seconds after that
USUAL_PATIENCE = 120  # of a call as it is meant, on a busy machine
MEMORY = 4 << 30

SUSPENSION = "generate brownian --particles 100 --volume-fraction 0.2 --radius 0.25um --equilibration-time 1us --surface-potential 0"
RUN = SUSPENSION + " --stop-time 1us -o made.h5"
CURVE = "generate brownian --potential-curve --radius 0.25um --surface-potential 15mV"
WELL = "generate brownian --potential-curve --radius 0.25um --law depletion --depth 5kT --size-ratio 0.1"

# Small calls of each verb; an option is added to each of them, unless its text begins with the name of a method.
CALLS = {
    "generate vem": ["generate vem --particles 30 --voids 15 --volume-fraction 0.4 --target-coordination 4 --radius 1um -o made.h5"],
    "generate brownian": [RUN, CURVE, WELL],
    "characterize": ["characterize packing.h5 -o made.h5 --radii 20"],
    "shear": ["shear packing.h5 -o made.h5", "shear packing.h5 -o made.h5 --frequency 1Hz --model losses.toml"],
    "calibrate": ["calibrate packing.h5 -o made.csv"],
    "fit power-law": ["fit power-law table.csv -o made.csv"],
    "diagnose": ["diagnose experiment.toml --causes contact-loss -o made"],
    "diagnose new": ["diagnose new sweep.csv -o made.toml"],
    "diagnose check": ["diagnose check experiment.toml"],
    "diagnose plan": ["diagnose plan experiment.toml --causes contact-loss --data-sets 20 --diagnoses 0"],
    "diagnose catalogue": ["diagnose catalogue"],
    "dataset plan": ["dataset plan set.toml"],
    "dataset run": ["dataset run set.toml -o made.h5"],
    "dataset table": ["dataset table set.h5 -o made.csv"],
    "dataset verify": ["dataset verify set.h5"],
    "dataset join": ["dataset join set.h5 -o made.h5"],
    "dataset workflow": ["dataset workflow set.toml -o made"],
    "info": ["info packing.h5"],
    "import": ["import points.csv --radius 0.5um --box 8um -o made.h5", "import plain.csv --length-unit 1um --radius 0.5um --open -o made.h5"],
    "export": ["export packing.h5 --format csv -o made.csv"],
    "report": ["report packing.h5 -o made.html"],
    "plot": ["plot packing.h5 --figure packing -o made.png"],
    "completion": ["completion bash"],
    "man": ["man shear"],
}
METHODS = {"dem": "shear packing.h5 -o made.h5 --method dem --orientation xy --oscillations 1 --steps-per-oscillation 200",
           "quasistatic": "shear packing.h5 -o made.h5 --method quasistatic --orientation xy --rest-length found"}
# What an option needs beside it to have any effect.
COMPANIONS = {"yukawa-energy": "--yukawa-length 1nm", "yukawa-length": "--yukawa-energy 1e-20J", "gravity": "--density-difference 1000",
              "density-difference": "--gravity 10", "shear-amplitude": "--shear-frequency 1kHz",
              "shear-frequency": "--shear-amplitude 0.01", "friction": "--contact-shear-stiffness 1", "rolling-stiffness": "--contact-shear-stiffness 1",
              "rolling-friction": "--contact-shear-stiffness 1 --rolling-stiffness 1", "plateau-time": "--stop-plateau mean-gap",
              "plateau-change": "--stop-plateau mean-gap", "checkpoint-interval": "--checkpoint state.h5",
              "depth": "--law depletion --size-ratio 0.1", "polymer-concentration": "--law depletion --size-ratio 0.1",
              "attraction-range": "--law depletion --depth 5", "size-ratio": "--law depletion --depth 5",
              "cycles": "--amplitudes 1e-4", "steps-per-cycle": "--amplitudes 1e-4", "ramp-steps": "--ramp 1e-4",
              "modulus-tolerance": "--solver iterative", "noise-replicas": "--position-noise 5nm",
              "voxels-per-radius": "--only transport", "most-voxels": "--only transport"}
WITHOUT = {"stop-coordination": "--stop-time 1us", "voxels-per-radius": "--radii 20", "most-voxels": "--radii 20",
           "depth": "--surface-potential 0", "polymer-concentration": "--surface-potential 0", "attraction-range": "--surface-potential 0",
           "size-ratio": "--surface-potential 0"}  # parts of a call that would hide the option
# Numbers that may be missing, as the documentation says: ends of an interval that the data do not bound, errors of a line through two
# points, ratios to a structure without load, a barrier that is not there, strengths that are found
# too rarely, the model of a cause where none is found.
MAY_BE_MISSING = re.compile(r"a0_interval/|_stderr$|ratio_to_first$|failure_strain$|yield_strain$|decisive_structure$|barrier$|secondary_minimum$|"
                            r"floppy_modes$|modulus_error$|found_(half|most)(/|$)|extended_model$")  # the iterative solver counts no modes and may need no step

OPTION = re.compile(r"^  (?:-\w, |    )--([a-z-]+) (\S+) +(.*)$")
RANGE = re.compile(r"range ([^;\]]+)")


def ends(text):
    """The smallest and the largest value of a range as --help has it."""
    numbers = [float(word) for word in re.findall(r"-?\d[\d.e+-]*", text.replace("..", " "))]
    if " .. " in text:
        return numbers
    if len(numbers) == 2:
        return [numbers[0] + 1e-6 * (numbers[1] - numbers[0]), numbers[1] - 1e-6 * (numbers[1] - numbers[0])]
    return numbers


class Option:
    def __init__(self, name, placeholder, text):
        self.name = name
        self.method = next((method for method in METHODS if text.startswith(method + ":")), None)
        found = RANGE.search(text)
        self.values = []
        if placeholder == "N":
            self.values = STRANGE_COUNTS + [f"{value:.0f}" for value in ends(found[1])[:1]] if found else STRANGE_COUNTS
        elif placeholder == "X":
            self.values = STRANGE + [repr(value) for value in (ends(found[1]) if found else [])]
        elif (example := re.search(r"such as ([\d.]+(?:e-?\d+)?)([A-Za-z]*)(:?)", text)) or placeholder.startswith("L|"):
            unit, sweep = (example[2], ":1kHz:3" if example[3] else "") if example else ("m", "")
            self.values = [value + unit + sweep for value in STRANGE]


def options_of(program, verb):
    text = subprocess.run([program, *verb.split(), "--help"], capture_output=True, text=True, check=True).stdout
    matches = [OPTION.match(line) for line in text.split("\n")]
    return [Option(*match.groups()) for match in matches if match]


def write_inputs(program, folder):
    def call(words):
        subprocess.run([program, *words.split(), "--quiet"], cwd=folder, check=True)

    call("generate vem --particles 60 --voids 30 --volume-fraction 0.4 --radius 0.25um -o packing.h5")
    (folder / "set.toml").write_text('[[generate]]\nverb = "vem"\nparticles = 30\nvolume-fraction = 0.4\n'
                                     'target-coordination = 4\nradius = "1um"\n[shear]\n')
    call("dataset run set.toml -o set.h5")
    points = "".join(f"{x},{y},{z}\n" for x in (1, 2, 3) for y in (1, 2, 3) for z in (1, 2, 3))
    (folder / "points.csv").write_text("x [um],y [um],z [um]\n" + points)
    (folder / "plain.csv").write_text("x,y,z\n" + points)
    (folder / "table.csv").write_text("a,modulus [MPa]\n" + "".join(f"{a},{(a - 0.2) ** 2 + 0.001 * a}\n" for a in (0.3, 0.4, 0.5, 0.6, 0.7)))
    (folder / "losses.toml").write_text("normal_viscosity = 1e-3\nshear_viscosity = 1e-4\n")
    rows = "".join(f"{1e-5 * 2**k},{500 - k},{50 + k}\n" for k in range(12))
    (folder / "sweep.csv").write_text("strain [1],storage modulus [Pa],loss modulus [Pa]\n" + rows)
    (folder / "experiment.toml").write_text('[sample]\nparticle_radius = "0.25um"\n\n[structures]\nfiles = ["packing.h5"]\n\n'
                                            '[[measurement]]\nkind = "amplitude-sweep"\nfile = "sweep.csv"\nsample = "A"\n'
                                            'values = { angular_frequency = "10 rad/s" }\n')


def nulls(value, path=""):
    """Where a result has no number."""
    if value is None:
        return set() if MAY_BE_MISSING.search(path) else {re.sub(r"/\d+", "/#", path)}
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return set().union(*(nulls(entry, f"{path}/{key}") for key, entry in entries))


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Sweep:
    def __init__(self, program, folder):
        self.program = program
        self.folder = folder
        self.inputs = set(os.listdir(folder))
        self.counts = collections.Counter()
        self.defects = []
        self.usual = {}

    def run(self, words, patience):
        """Exit code, output and complaint; the code is None for a call that does not stop."""
        process = subprocess.Popen([self.program, *words, "--json", "--threads", "1"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=limit_memory)
        for number, seconds in ((signal.SIGINT, patience), (signal.SIGKILL, HANGING)):
            try:
                output, complaint = process.communicate(timeout=seconds)
                return process.returncode, output, complaint
            except subprocess.TimeoutExpired:
                process.send_signal(number)
        process.communicate()
        return None, "", ""

    def verdict(self, call, code, output, complaint):
        """What happened, and whether it is a defect."""
        if code is None:
            return "hangs", True
        if code < 0:
            return f"dies of {signal.Signals(-code).name}", True
        if code == 0:
            try:
                missing = nulls(json.loads(output, parse_constant=lambda name: None)) - self.usual.get(call, set())
            except json.JSONDecodeError:
                return "prints no JSON", True
            return (f"succeeds without {sorted(missing)}", True) if missing else ("works", False)
        if not re.fullmatch(r"coagula: \S[^\n]*\n", complaint) or "boost" in complaint or "exception" in complaint:
            return f"complains with {complaint!r}", True
        left = set(os.listdir(self.folder)) - self.inputs - {"state.h5", "made.h5.parts"}
        if left:
            return f"leaves {sorted(left)} behind", True
        return ("stops on Ctrl-C" if "interrupted" in complaint else "is refused" if code in (2, 4) else "fails with a sentence"), False

    def clean(self):
        for name in set(os.listdir(self.folder)) - self.inputs:
            path = self.folder / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    def check(self, call, option=None, value=None):
        """Whether the value may stand in any call."""
        words = call.split()
        if option:
            hidden = WITHOUT.get(option.name, "")
            words = call.replace(hidden, "").split() if hidden else words
            words += COMPANIONS.get(option.name, "").split()
            flag = "--" + option.name
            if flag in words:
                del words[words.index(flag): words.index(flag) + 2]
            words.append(f"{flag}={value}")
        code, output, complaint = self.run(words, PATIENCE if option else USUAL_PATIENCE)
        what, defect = self.verdict(call, code, output, complaint)
        if option is None and code == 0:
            self.usual[call] = nulls(json.loads(output))
        elif option is None:
            self.defects.append(f"{call}: {what} {complaint}")
        else:
            self.counts["defects" if defect else what] += 1
            if defect:
                self.defects.append(f"{' '.join(words)}: {what}")
                print(self.defects[-1], flush=True)
        self.clean()
        return option is None or code != 2 or not re.match(rf"coagula: --{option.name}: \S+ is (out of range|not a )", complaint)

    def verb(self, name):
        for option in options_of(self.program, name):
            if option.name == "threads":
                continue
            values = option.values
            for call in [METHODS[option.method]] if option.method and name == "shear" else CALLS[name]:
                if call not in self.usual:
                    self.check(call)
                values = [value for value in values if self.check(call, option, value)]


def verbs_of(program):
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  ([a-z-]+(?: [a-z-]+)?)  ", text.split("verbs:\n")[1].split("\n\n")[0], re.MULTILINE)


def main():
    program = str(Path(sys.argv[1]).resolve())
    verbs = verbs_of(program)
    if set(verbs) != set(CALLS):
        sys.exit(f"option_sweep.py has calls of {sorted(CALLS)}, but the verbs are {sorted(verbs)}")
    folder = Path(tempfile.mkdtemp(prefix="coagula-sweep-"))
    try:
        write_inputs(program, folder)
        sweep = Sweep(program, folder)
        for verb in sys.argv[2:] or verbs:
            start, before = time.time(), sum(sweep.counts.values())
            sweep.verb(verb)
            print(f"{verb:20}{sum(sweep.counts.values()) - before:6} calls, {time.time() - start:.0f} s", flush=True)
    finally:
        shutil.rmtree(folder)
    print(", ".join(f"{count} {what}" for what, count in sorted(sweep.counts.items())))
    for defect in sweep.defects:
        print("DEFECT:", defect)
    sys.exit(1 if sweep.defects or not sweep.counts else 0)


if __name__ == "__main__":
    main()
