# SPDX-License-Identifier: GPL-3.0-or-later
"""Brownian dynamics by LAMMPS: what it refuses, how its failures are told, and that its gels are those of the builtin engine."""

import math
import os
import shutil
import statistics
import unittest

import h5py

from support import ProgramTest

RADIUS, THERMAL = 0.25e-6, 1.380649e-23 * 293
RUN = ["generate", "brownian", "--particles", "300", "--volume-fraction", "0.4", "--radius", "0.25um", "--surface-potential", "0mV"]
BY_LAMMPS = [*RUN, "--engine", "lammps"]


def needs_lammps(test):
    return unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed (Debian: apt-get install lammps)")(test)


class Refusals(ProgramTest):
    def refuse(self, *words, says):
        self.program("lmp", "exit 0")
        self.fail_with(2, *BY_LAMMPS, "--stop-time", "1ms", "-o", "gel.h5", *words, says=says, env=self.environment())

    def program(self, name, commands):
        path = self.write(name, f"#!/bin/sh\n{commands}\n")
        path.chmod(0o755)

    def environment(self):
        return {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}

    def test_what_its_models_cannot_do(self):
        for words in (["--contact-shear-stiffness", "1"], ["--gravity", "9.81"], ["--shear-rate", "1"],
                      ["--shear-amplitude", "0.1", "--shear-frequency", "1"], ["--checkpoint", "a.state"], ["--integrator", "euler"]):
            self.refuse(*words, says=f"{words[0]} is not read with --engine lammps")
        self.refuse("--size-distribution", "normal:0.1", says="LAMMPS moves particles of one radius only")
        self.refuse("--cutoff-gap", "3um", says="the cut-off gap may be 10 radii at most")
        self.refuse("--time-step", "1us", says="the integrator is stable up to")

    def test_a_command_without_lammps(self):
        self.fail_with(2, *RUN, "--stop-time", "1ms", "-o", "gel.h5", "--engine-command", "lmp", says="read only with --engine lammps")

    def test_a_program_that_is_missing(self):
        for command in ("no-such-lmp", "./no-such-lmp", "mpirun-of-nobody -n 2 lmp"):
            self.fail_with(2, *BY_LAMMPS, "--stop-time", "1ms", "-o", "gel.h5", "--engine-command", command,
                           says=[f"there is no program {command.split()[0]}", "apt-get install lammps"])
        self.fail_with(2, *BY_LAMMPS, "--stop-time", "1ms", "-o", "gel.h5", "--engine-command", " ", says="names no program")

    def test_a_program_that_fails(self):
        start = [*BY_LAMMPS, "--stop-time", "1ms", "--equilibration-time", "1us", "-o", "gel.h5", "--engine-command", "./lmp"]
        os.mkdir(self.folder / "temporary")
        environment = {**os.environ, "TMPDIR": str(self.folder / "temporary")}
        for commands, says in (("exit 0", "LAMMPS failed: it ended and said nothing"),
                               ("echo ----; echo There are not enough slots; echo so it is; exit 1", "LAMMPS failed: There are not enough slots"),
                               ('read line; echo "ERROR: first" > "$2"; echo "ERROR: Lost atoms" >> "$2"; exit 1',
                                "LAMMPS failed: ERROR: Lost atoms")):
            self.program("lmp", commands)
            self.fail_with(1, *start, says=says, env=environment)
        self.assertEqual(os.listdir(self.folder / "temporary"), [])


@needs_lammps
class Runs(ProgramTest):
    def test_a_run_ends_at_its_coordination_and_tells_its_engine(self):
        found = self.succeed_json(*BY_LAMMPS, "--stop-coordination", "1.5", "--snapshots", "10us,30us", "-o", "gel.h5")
        self.assertEqual(found["ended_by"], "coordination")
        self.assertGreaterEqual(found["coordination"], 1.5)
        self.assertLess(found["coordination"], 2)
        self.assertRegex(found["engine"]["name"], r"^LAMMPS \d+ \w+ \d{4}")
        self.assertIn(found["engine"]["name"], self.succeed("info", "gel.h5"))
        with h5py.File(self.folder / "gel.h5") as file:
            self.assertEqual(file["particles/trajectory/position/value"].shape[0], 3)
            self.assertEqual(2 * len(file["connectivity/bonds"]) / 300, found["coordination"])
            series = file["generation/brownian/series"]
            self.assertEqual(series["coordination"][-1], found["coordination"])
            self.assertEqual(series["time"][0], 0)

    def test_the_same_seed_makes_the_same_gel(self):
        words = [*BY_LAMMPS, "--stop-time", "0.05ms", "--quiet"]
        for name, seed in (("a", 1), ("b", 1), ("c", 2)):
            self.succeed(*words, "--seed", seed, "-o", f"{name}.h5")
        one, same, other = (h5py.File(self.folder / f"{name}.h5")["particles/trajectory/position/value"][()] for name in "abc")
        self.assertTrue((one == same).all())
        self.assertFalse((one == other).any())

    def test_a_set_of_both_engines(self):
        self.write("sweep.toml", '''title = "engines"
[[generate]]
verb = "brownian"
particles = 200
volume-fraction = 0.4
radius = "0.25um"
surface-potential = 0
equilibration-time = "10us"
stop-time = ["10us", "30us"]
engine = ["builtin", "lammps"]
seed = 1
''')
        self.succeed("dataset", "run", "sweep.toml", "-o", "set.h5", "--quiet")
        with h5py.File(self.folder / "set.h5") as file:
            engines = [name.decode() for name in file["index/engine"]]
            for engine, identity in zip(engines, file["index/id"]):
                history = file["structures"][identity.decode()]["provenance/0001_generate_brownian"]["version"][()].decode()
                self.assertEqual("LAMMPS" in history, engine == "lammps", history)
        self.assertEqual(sorted(engines), ["builtin"] * 2 + ["lammps"] * 2)


@needs_lammps
class Statistics(ProgramTest):
    def pairs(self, side=8, spacing=7):
        """Isolated pairs at rest in their contact, along the axes in turn."""
        rows = ["x,y,z"]
        for number in range(side**3):
            centre = [spacing * (number // side**axis % side + 0.5) for axis in range(3)]
            for sign in (1, -1):
                rows.append(",".join(repr(c + sign * 1.002 * (axis == number % 3)) for axis, c in enumerate(centre)))
        self.write("pairs.csv", "\n".join(rows) + "\n")
        self.succeed("import", "pairs.csv", "--radius", RADIUS, "--length-unit", RADIUS, "--box", side * spacing * RADIUS, "-o", "pairs.h5")
        return side * spacing * RADIUS

    def boltzmann_variance(self):
        """Of the gap of two particles in their contact [m^2]."""
        curve = self.succeed_json("generate", "brownian", "--potential-curve", "--surface-potential", "0mV", "--radius", RADIUS)
        cut, stiffness, rest = curve["cut_gap"], curve["contact_stiffness"], curve["contact"]["gap"]
        width = math.sqrt(THERMAL / stiffness)
        self.assertGreater(cut - rest, 0)
        gaps = [rest + width * (-8 + 0.001 * row) for row in range(16001)]
        # Elastic below the cut-off gap, the curve above it.
        table = list(zip(curve["curve"]["gap"], curve["curve"]["energy_kT"]))
        lowest = curve["contact"]["energy_kT"]
        weights = []
        for gap in gaps:
            energy = 0.5 * stiffness * (gap - rest) ** 2 / THERMAL if gap < cut else self.between(table, gap) - lowest
            weights.append((2 * RADIUS + gap) ** 2 * math.exp(-energy))
        mean = sum(w * g for w, g in zip(weights, gaps)) / sum(weights)
        return sum(w * (g - mean) ** 2 for w, g in zip(weights, gaps)) / sum(weights)

    @staticmethod
    def between(table, gap):
        for (low, one), (high, other) in zip(table, table[1:]):
            if low <= gap <= high:
                return one + (other - one) * (gap - low) / (high - low)
        return math.inf

    def test_contacts_fluctuate_as_boltzmann_has_it(self):
        edge = self.pairs()
        times = [0.02 + 0.002 * number for number in range(20)]
        self.succeed("generate", "brownian", "--start", "pairs.h5", "--surface-potential", "0mV", "--engine", "lammps", "--stop-time",
                     "0.06ms", "--snapshots", ",".join(f"{time:.3f}ms" for time in times), "--quiet", "-o", "run.h5")
        with h5py.File(self.folder / "run.h5") as file:
            frames = 1e-9 * file["particles/trajectory/position/value"][()]
        gaps = []
        for frame in frames[:20]:
            for one, other in zip(frame[::2].tolist(), frame[1::2].tolist()):
                gaps.append(math.sqrt(sum(math.remainder(a - b, edge) ** 2 for a, b in zip(one, other))) - 2 * RADIUS)
        # 10240 values, hardly correlated over 2 us: a standard error of 1.4 %.
        self.assertAlmostEqual(statistics.variance(gaps) / self.boltzmann_variance(), 1, delta=0.06)

    def test_its_gels_are_as_coordinated_as_those_of_the_builtin_engine(self):
        found = {}
        for engine in ("builtin", "lammps"):
            found[engine] = [self.succeed_json(*RUN, "--engine", engine, "--stop-time", "0.3ms", "--seed", seed, "-o",
                                               f"{engine}{seed}.h5")["coordination"] for seed in range(1, 6)]
        means = {engine: statistics.mean(values) for engine, values in found.items()}
        error = math.hypot(*(statistics.stdev(values) / math.sqrt(5) for values in found.values()))
        self.assertLess(error, 0.1)
        self.assertLess(abs(means["builtin"] - means["lammps"]), 3 * error)
        self.assertGreater(means["builtin"], 1)


if __name__ == "__main__":
    unittest.main()
