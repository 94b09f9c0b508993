# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose check on the exports of a real instrument: cement paste in large and in small oscillations."""

import math
import os
import unittest
from pathlib import Path

from support import ProgramTest

CEMENT = Path(os.environ["COAGULA_DATASETS"]) / "cement_laos"


class CementPaste(ProgramTest):
    """The example of docs/how-to/measured-data.md on the exports themselves."""

    def setUp(self):
        super().setUp()
        document = Path(__file__).parents[2] / "docs/how-to/measured-data.md"
        example = document.read_text().split("```toml\n")[1].split("```")[0]
        for path in CEMENT.glob("*.csv"):
            (self.folder / path.name).symlink_to(path.resolve())
        self.write("experiment.toml", example)
        self.found = self.succeed_json("diagnose", "check", "experiment.toml")

    def test_columns_and_rows(self):
        kinds = [(table["kind"], table["rows"]) for table in self.found["measurements"]]
        self.assertEqual(kinds, 3 * [("amplitude-sweep", 51)] + [("waveform", 513)] + [("time-sweep", 200)])
        for table in self.found["measurements"][:4]:
            self.assertEqual(table["left_out"], [])

    def test_exactly_the_slipped_stress_cells_are_left_out(self):
        cells = self.found["measurements"][-1]["left_out"]
        left_out = {cell["row"]: cell["value"] for cell in cells if cell["column"] == "stress"}
        # Independently, from the text of the file: the stress that G', G'' and the strain of the row make.
        lines = (CEMENT / "SAOS_0.55_250.csv").read_bytes().decode("utf-16").splitlines()
        start = [i for i, line in enumerate(lines) if line.startswith("Abschnitt und")][1]
        slipped = {}
        for line in lines[start + 4:start + 204]:
            cell = line.split("\t")
            strain, stress, storage, loss = (float(cell[i].replace(",", ".")) for i in (2, 4, 5, 6))
            ratio = stress / (math.hypot(storage, loss) * strain / 100)
            if abs(ratio - 1) > 0.5:
                self.assertAlmostEqual(ratio, 10, delta=0.02)  # the separator, and nothing else
                slipped[int(cell[1])] = stress
            else:
                self.assertAlmostEqual(ratio, 1, delta=0.002)
        self.assertEqual(len(slipped), 43)
        self.assertEqual(set(left_out), set(slipped))
        for row, value in left_out.items():
            self.assertEqual(float(value), slipped[row])

    def test_no_modulus_or_axis_is_lost(self):
        cells = self.found["measurements"][-1]["left_out"]
        self.assertEqual({cell["column"] for cell in cells}, {"stress", "torque", "complex_viscosity", "gap"})
        self.assertEqual([cell["value"] for cell in cells if cell["column"] == "torque"], ["7.67E-01"])

    def test_harmonics_of_the_waveform_are_the_moduli_of_the_instrument(self):
        found = self.found["measurements"][3]["harmonics"]
        lines = (CEMENT / "LAOS_0.55_250_1.csv").read_bytes().decode("utf-16").splitlines()
        start = [i for i, line in enumerate(lines) if line.startswith("Abschnitt und")][1]
        points = (line.split("\t") for line in lines[start + 4:])
        point = next(cells for cells in points if len(cells) > 8 and cells[1] == "41" and cells[2])
        strain, storage, loss = (float(point[i].replace(",", ".")) for i in (2, 6, 7))
        self.assertAlmostEqual(found["strain"] / (strain / 100), 1, delta=0.01)
        self.assertAlmostEqual(found["storage_modulus"] / storage, 1, delta=0.015)
        self.assertAlmostEqual(found["loss_modulus"] / loss, 1, delta=0.015)
        self.assertAlmostEqual(found["third_harmonic"], 0.31, delta=0.01)  # a plastic body has a third
        for table in self.found["measurements"][:3]:
            self.assertNotIn("harmonics", table)

    def test_the_third_batch_is_a_sample_effect(self):
        torque = [noise for noise in self.found["noise"] if noise["observable"] == "complex_modulus"]
        self.assertGreaterEqual(len(torque), 1)
        for noise in torque[:1]:
            self.assertEqual(noise["samples"], 3)
            effects = noise["sample_effects"]
            ratio = (1 + effects["batch 3"]) / (1 + (effects["batch 1"] + effects["batch 2"]) / 2)
            self.assertAlmostEqual(ratio, 0.66, delta=0.06)
            self.assertTrue(noise["sample"]["low"] > 3 * noise["relative"]["high"] / 2)
            self.assertLess(noise["relative"]["value"], 0.05)


if __name__ == "__main__":
    unittest.main()
