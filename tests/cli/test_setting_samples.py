# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose where a part of the rows lies far from the others: the evidence of the base model and of a remainder."""

import cmath
import math
import random
import unittest

from diagnosis_support import PLATES, Tables


class SettingSamples(Tables):
    """Four samples that set within minutes: a part of the rows lies far below the others."""

    RUNS = ((5, [1.0] * 12), (20, [0.1 * 300**(k / 7) for k in range(8)]), (450, [1.0] * 16))  # seconds a row, frequencies [Hz]
    HEADS = ("strain [1]", "frequency [Hz]", "time [s]", "storage_modulus [Pa]", "loss_modulus [Pa]")

    def setUp(self):
        super().setUp()
        self.structure("known.h5", 1)

    def runs(self, seed):
        number = random.Random(seed)
        text = '[structures]\nfiles = ["known.h5"]\n\n' + PLATES
        for sample, radius in (("A", 0.0125), ("B", 0.0125), ("C", 0.025), ("D", 0.025)):
            level, start = 6e5 * (1 + 0.08 * number.gauss(0, 1)), 0
            for order, (step, frequencies) in enumerate(self.RUNS):
                rows = []
                for k, frequency in enumerate(frequencies, 1):
                    grown = level * (3.57 - 2.57 * math.exp(-(start + step * k) / 113.2))
                    shown = grown * (1 + 0.02 * number.gauss(0, 1)) * cmath.exp(0.004j * number.gauss(0, 1))
                    rows.append((1e-5, frequency, step * k, shown.real, shown.imag))
                start += step * len(frequencies) + 10
                self.table(f"{sample}{order}.csv", self.HEADS, rows)
                kind = "frequency-sweep" if order == 1 else "time-sweep"
                text += (f'\n[[measurement]]\nkind = "{kind}"\nfile = "{sample}{order}.csv"\nsample = "{sample}"\nrun_order = {order}\n'
                         f"values = {{ plate_radius = {radius} }}\n")
        return text

    def test_the_base_model_is_fitted_where_most_rows_are(self):
        """At one gap slip changes no more than the level, which the stiffness does as well: it cannot explain more than the base model."""
        for seed in (1, 2, 4):
            found = self.diagnosis(self.runs(seed), "--causes", "ageing-saturating,wall-slip")
            evidence = {cause["name"]: cause["log_evidence"] for cause in found["causes"]}
            self.assertGreater(evidence["base"], evidence["wall-slip"] - 5, seed)
            self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["ageing-saturating"]))
            # Two parameters in place of some ten coefficients of a smooth departure.
            self.assertGreater(evidence["ageing-saturating"], evidence["none of the catalogue"] + 30, seed)
            posterior = {cause["name"]: cause["posterior"] for cause in found["causes"]}
            self.assertLess(posterior["wall-slip"], posterior["none of the catalogue"], seed)  # nor beside a remainder


class Losses(Tables):
    """A network without losses beside samples that have them at every frequency."""

    def test_the_level_of_the_base_model_lies_among_the_data(self):
        self.structure("known.h5", 1)
        number = random.Random(5)
        text = '[structures]\nfiles = ["known.h5"]\n\n' + PLATES
        for sample, factor in (("A", 1.0), ("B", 1.12), ("C", 0.93)):
            rows = []
            for k in range(16):
                omega = 0.1 * 10**(k / 5)
                shown = factor * (150 + 30 * (1j * omega)**0.3) * (1 + 0.02 * number.gauss(0, 1)) * cmath.exp(0.005j * number.gauss(0, 1))
                rows.append((omega, shown.real, shown.imag))
            self.table(f"{sample}.csv", ("angular frequency [rad/s]", "storage_modulus [Pa]", "loss_modulus [Pa]"), rows)
            text += f'\n[[measurement]]\nkind = "frequency-sweep"\nfile = "{sample}.csv"\nsample = "{sample}"\n'
        effects = self.diagnosis(text)["sample_effects"]["base"]
        self.assertLess(max(map(abs, effects.values())), 0.3, effects)


if __name__ == "__main__":
    unittest.main()
