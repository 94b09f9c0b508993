# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose on torque, deflection and raw phase: the same as on their moduli, and bad values refused."""

import math
import random
import unittest

from diagnosis_support import PLATES, STIFFNESS, Tables


class RawColumns(Tables):
    """Torque, deflection and raw phase, as an instrument reads them of a stiff sample under a heavy tool."""

    FREQUENCIES = [10**(0.23 * k) for k in range(14)]  # rad/s
    PER_MODULUS = math.pi * 0.0125**4 / 2e-3          # torque over angle and modulus
    INERTIA = 5e-5

    def setUp(self):
        super().setUp()
        self.structure("known.h5", 1, 200)
        self.hidden = STIFFNESS / 100 * self.modulus("known.h5")

    def torque(self, frequency, number):
        """Per radian: amplitude and phase, with errors of 2 % and 4 mrad."""
        size = self.PER_MODULUS * self.hidden - self.INERTIA * frequency**2
        return abs(size) * (1 + number.gauss(0, 0.02)), (math.pi if size < 0 else 0) + number.gauss(0, 0.004)

    def write_tables(self):
        number = random.Random(3)
        parts = []
        for sample in "AB":
            rows, moduli = [], []
            for frequency in self.FREQUENCIES:
                torque, phase = self.torque(frequency, number)
                phase = math.remainder(phase, 2 * math.pi)
                rows.append((frequency, 1e3 * torque * 1e-3, 1, math.degrees(phase)))
                modulus = torque / self.PER_MODULUS
                moduli.append((frequency, modulus * math.cos(phase), modulus * math.sin(phase)))
            self.table(f"raw{sample}.csv", ("angular_frequency [rad/s]", "torque [mN.m]", "deflection [mrad]", "raw_phase [degree]"), rows)
            self.table(f"moduli{sample}.csv", ("angular_frequency [rad/s]", "storage_modulus [Pa]", "loss_modulus [Pa]"), moduli)
            parts.append(f'[[measurement]]\nkind = "frequency-sweep"\nfile = "raw{sample}.csv"\nsample = "{sample}"\n')
        return PLATES + '[structures]\nfiles = ["known.h5"]\n\n' + "".join(parts)

    def test_say_the_same_as_their_moduli(self):
        text = self.write_tables()
        raw = self.diagnosis(text)
        self.assertEqual((raw["verdict"], raw["credible_set"]), ("named", ["tool-inertia"]))
        inertia = raw["causes"][0]["parameters"]["inertia"]
        self.assertTrue(inertia["low"] < self.INERTIA < inertia["high"])
        self.assertTrue(any(row["measured"] < 0 for row in raw["rows"] if row["observable"] == "storage_modulus"))
        moduli = self.diagnosis(text.replace("raw", "moduli"))
        for one, other in zip(raw["rows"], moduli["rows"]):
            self.assertAlmostEqual(one["measured"], other["measured"], delta=1e-6 * self.hidden)

    def test_refusals(self):
        text = self.write_tables()
        self.refuse(text.replace('plate_radius = "12.5 mm"\n', ""), "rawA.csv", "need the size of the tool")
        self.refuse(text.replace('file = "rawA.csv"', 'file = "modulusA.csv"'), "modulusA.csv")
        self.refuse(text.replace('"rawA.csv"', '"moduliA.csv"\nmoduli = "raw"'), "moduliA.csv", "torque, deflection and raw_phase")
        self.refuse(text + 'moduli = "cooked"\n', "'cooked' is neither raw nor as-given")
        self.refuse(text.replace("raw", "moduli").replace("[structures]", "stress_constant = 1e5\n[structures]"), "stress_constant", "go together")
        self.refuse("[noise]\nstated_correlation = 1\n" + text, "stated_correlation", "below 1")


if __name__ == "__main__":
    unittest.main()
