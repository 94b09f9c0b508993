# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose: a hidden loss of the contacts is named, the extended model runs, what cannot be diagnosed is refused."""

import hashlib
import json
import math
import unittest

from support import VEM, ProgramTest

MODEL = """normal_springpot_stiffness = 12
normal_springpot_time = 0.15915494309189535
normal_springpot_exponent = 0.08
shear_springpot_stiffness = 1.2
shear_springpot_time = 0.15915494309189535
shear_springpot_exponent = 0.08
"""

EXPERIMENT = """title = "hidden loss"

[sample]
particle_radius = "0.25 um"

[structures]
files = ["packing.h5"]

[[measurement]]
kind = "frequency-sweep"
file = "sweep.csv"
sample = "one"
"""


def summed(line):
    """A line of the cache with its checksum."""
    return f"{line}\t{hashlib.sha256(line.encode()).hexdigest()[:16]}\n"


class Diagnosis(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed(*VEM[:3], "200", "--voids", "100", *VEM[6:], "-o", "packing.h5")
        self.write("experiment.toml", EXPERIMENT)

    def sweep_of(self, *words):
        """Moduli of a structure that the diagnosis does not see, with an error of 2 % that alternates."""
        self.succeed("generate", "vem", "--particles", "300", "--voids", "150", "--volume-fraction", "0.4", "--radius", "0.25um", "--seed",
                     "9", "--quiet", "--force", "-o", "other.h5")
        found = self.succeed_json("shear", "other.h5", "-o", "swept.h5", "--force", "--frequency-sweep", "0.1Hz:100Hz:16", *words)
        lines = ["frequency [Hz],storage_modulus [Pa],loss_modulus [Pa]"]
        for k, frequency in enumerate(found["frequency"]):
            error = 1 + 0.02 * math.sin(2.4 * k)
            lines.append(f"{frequency},{error * found['storage_modulus']['mean'][k]},{found['loss_modulus']['mean'][k] / error}")
        self.write("sweep.csv", "\n".join(lines) + "\n")

    def test_a_hidden_loss_is_found(self):
        self.write("hidden.toml", MODEL)
        self.sweep_of("--model", "hidden.toml")
        found = self.succeed_json("diagnose", "experiment.toml", "-o", "results")
        self.assertTrue(found["detected"])
        self.assertEqual(found["verdict"], "tied")  # only an oil tells it from an error of the phase
        self.assertEqual(found["credible_set"], ["contact-loss", "none of the catalogue"])
        self.assertEqual([one["name"] for one in found["conditions"] if not one["holds"]], ["separated"])
        self.assertEqual((found["follows"]["link"], found["follows"]["axis"]), ("material", "frequency"))
        self.assertGreater(found["follows"]["posterior"], 0.9)
        self.assertAlmostEqual(sum(kind["posterior"] for kind in found["kinds"]), 1)
        self.assertGreater(found["gain"]["rmse_ratio"], 2)
        self.assertTrue(found["where"][0]["sentence"])
        parameters = found["causes"][0]["parameters"]
        self.assertLess(parameters["exponent"]["low"], 0.08)
        self.assertGreater(parameters["exponent"]["high"], 0.08)
        with open(self.folder / "results" / "diagnosis.json") as file:
            self.assertEqual(json.load(file)["verdict"], "tied")
        # The extended model makes the moduli that the diagnosis predicts.
        again = self.succeed_json("shear", "packing.h5", "-o", "again.h5", "--frequency-sweep", "0.1Hz:100Hz:16", "--model",
                                  found["extended_model"])
        predicted = {(row["row"], row["observable"]): row["extended"] for row in found["rows"]}
        for k in (0, 7, 15):
            for part in ("storage_modulus", "loss_modulus"):
                self.assertAlmostEqual(again[part]["mean"][k] / predicted[(k + 1, part)], 1, delta=1e-6)
        self.fail_with(3, "diagnose", "experiment.toml", "-o", "results", says="--force")

    def smooth_sweep(self, rows=11):
        self.write("sweep.csv", "frequency [Hz],storage_modulus [Pa],loss_modulus [Pa],error [Pa]\n" +
                   "".join(f"{k},{1e6 + k},{1e4 + k},1e-9\n" for k in range(1, rows + 1)))

    def test_errors_that_no_instrument_has_are_no_reason_for_nan(self):
        self.smooth_sweep()
        self.write("experiment.toml", EXPERIMENT + 'standard_errors = { storage_modulus = "error", loss_modulus = "error" }\n')
        found = self.succeed_json("diagnose", "experiment.toml", "-o", "results", "--bootstrap", "99", "--causes", "ageing")
        for cause in found["causes"]:
            self.assertIsInstance(cause["posterior"], float)
        self.assertAlmostEqual(found["rows"][0]["standard_deviation"] / found["rows"][0]["measured"], 1e-4, delta=1e-9)

    def test_one_row_held_out_gives_a_gain_without_an_interval(self):
        self.smooth_sweep(6)
        words = ("diagnose", "experiment.toml", "-o", "results", "--force", "--bootstrap", "99", "--causes", "contact-loss")
        gain = self.succeed_json(*words)["gain"]
        self.assertEqual((gain["held_out"], gain["elpd_ci90"]), (2, [None, None]))
        self.assertGreater(gain["elpd_difference"], 0)
        self.assertIn("(too few rows for an interval)", self.succeed(*words))
        self.assertIn("(too few rows for an interval)", (self.folder / "results" / "report.html").read_text())

    def test_nothing_of_the_folder_is_lost(self):
        self.smooth_sweep()
        results = self.folder / "results"
        for name in ("simulations.txt", "report.html"):
            with self.subTest(folder=name):
                (results / name).mkdir(parents=True)
                self.fail_with(2, "diagnose", "experiment.toml", "-o", "results", "--force", says=[name, "is a folder"])
                self.assertEqual([path.name for path in results.iterdir()], [name])
                (results / name).rmdir()
        (results / "report.html").write_text("mine")
        self.fail_with(3, "diagnose", "experiment.toml", "-o", "results", says="report.html is there already; use --force")
        self.assertEqual((results / "report.html").read_text(), "mine")

    def test_a_damaged_cache_of_simulations_is_refused(self):
        self.smooth_sweep(6)
        words = ("diagnose", "experiment.toml", "-o", "results", "--force", "--bootstrap", "99", "--causes", "contact-loss")
        first = self.succeed_json(*words)
        cache = self.folder / "results" / "simulations.txt"
        whole = cache.read_text()
        key, numbers, _ = whole.splitlines()[0].split("\t")
        changed = " ".join(str(1.7 * float(number)) for number in numbers.split())
        older = f"{key}\t{numbers}\n"
        for text, line in ((whole[:-3], 1), (whole + "rest", 2), (f"{key}\t\n", 1), (summed(f"{key}\t1 2,5 3 4"), 1), (summed(f"{key}\tnan 2 3 4"), 1),
                           (whole.replace(numbers, changed), 1), (whole.replace(key, key + "0"), 1), (older, 1), (whole + older, 2)):
            with self.subTest(text=text):
                cache.write_text(text)
                self.fail_with(2, *words, says=(f"simulations.txt: line {line} is no result of a simulation as it was written", "remove the file"))
        cache.write_text(summed(f"{key}\t{numbers.rsplit(' ', 1)[0]}"))
        self.assertEqual(self.succeed_json(*words)["rows"], first["rows"])
        self.assertEqual(cache.read_text(), whole)

    def test_structures_that_are_not_the_sample_are_noted(self):
        self.smooth_sweep()
        self.write("experiment.toml", EXPERIMENT.replace('"0.25 um"', '"2.5 um"\nvolume_fraction = 0.3'))
        note = "the structures have a volume fraction of 0.4, with which they are simulated, but sample.volume_fraction is 0.3"
        words = ("diagnose", "experiment.toml", "-o", "results", "--force", "--bootstrap", "99", "--causes", "ageing")
        found = self.succeed_json(*words)["notes"]
        self.assertEqual((found[0], len(found)), (note, 2))
        self.assertIn("particle radius of 250 nm", found[1])
        self.assertIn(note, self.succeed(*words))
        self.assertIn(note, (self.folder / "results" / "report.html").read_text())

    def test_refusals(self):
        self.refuse_experiment("sweep.csv")
        self.smooth_sweep()
        self.fail_with(2, "diagnose", "experiment.toml", says="--output")
        self.smooth_sweep(1600)
        self.refuse_experiment("experiment.toml: the experiment has 3200 numbers, more than 3000")
        self.smooth_sweep()
        (self.folder / "copy.h5").write_bytes((self.folder / "packing.h5").read_bytes())
        self.write("experiment.toml", EXPERIMENT.replace('["packing.h5"]', '["packing.h5", "copy.h5"]'))
        self.refuse_experiment("copy.h5: the same particles as in")
        self.write("experiment.toml", EXPERIMENT.replace('[structures]\nfiles = ["packing.h5"]\n', ""))
        self.fail_with(2, "diagnose", "experiment.toml", "-o", "results", says="experiment.toml: [structures] gives no structures")
        self.assertIn("names no structures yet", self.succeed("diagnose", "check", "experiment.toml"))
        self.fail_with(2, "diagnose", "experiment.toml", "-o", "sweep.csv", says="is not a folder")


if __name__ == "__main__":
    unittest.main()
