# SPDX-License-Identifier: GPL-3.0-or-later
"""Several structures in one call: each gets its results, and the mean has the error of their scatter."""

import json

from support import SMALL, ProgramTest


class OverStructures(ProgramTest):
    def made(self, seeds):
        names = [f"s{seed}.h5" for seed in seeds]
        for seed, name in zip(seeds, names):
            self.succeed(*SMALL, "--seed", seed, "-o", name)
        return names

    def test_mean_and_standard_error(self):
        names = self.made((1, 2, 3))
        found = self.succeed_json("shear", *names)
        moduli = [structure["storage_modulus"]["mean"] for structure in found["structures"]]
        self.assertEqual([structure["file"] for structure in found["structures"]], names)
        for name, modulus in zip(names, moduli):
            stored = json.loads(self.succeed("info", name, "--json"))["results"]["/mechanics/linear/storage_modulus/mean"]
            self.assertEqual(stored["value"], modulus)
            self.assertEqual(self.succeed_json("shear", name)["storage_modulus"]["mean"], modulus)
        mean = sum(moduli) / 3
        error = (sum((modulus - mean) ** 2 for modulus in moduli) / 2 / 3) ** 0.5
        summary = found["over_structures"]["storage_modulus"]
        self.assertAlmostEqual(summary["mean"] / mean, 1, places=12)
        self.assertAlmostEqual(summary["standard_error"] / error, 1, places=12)
        table = self.succeed("shear", *names)
        self.assertIn("mean of 3", table)
        self.assertIn("standard deviation over the orientations of one structure", table)

    def test_of_a_sweep_each_entry_has_its_mean(self):
        names = self.made((1, 2))
        found = self.succeed_json("shear", *names, "--frequency", "1Hz,10Hz")
        summary = found["over_structures"]["storage_modulus"]
        first, second = (structure["storage_modulus"]["mean"] for structure in found["structures"])
        for entry in (0, 1):
            self.assertAlmostEqual(summary["mean"][entry] * 2 / (first[entry] + second[entry]), 1, places=12)
            self.assertAlmostEqual(summary["standard_error"][entry] * 2 / abs(first[entry] - second[entry]), 1, places=9)

    def test_what_is_refused(self):
        names = self.made((1, 2))
        self.fail_with(2, "shear", *names, "-o", "c.h5", says="--output")
        self.fail_with(2, "shear", names[0], names[0], says="twice")
        self.fail_with(2, "shear", *names, "none.h5", says="none.h5")
        history = json.loads(self.succeed("info", names[0], "--json"))["provenance"]
        self.assertEqual(len(history), 1)  # nothing was sheared before the third was missed
