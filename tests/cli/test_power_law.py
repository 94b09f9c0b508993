# SPDX-License-Identifier: GPL-3.0-or-later
"""The fit of a power law to a table: values, units, weights, profile, what is refused."""

import csv
import math
import unittest

from support import ProgramTest

A = [0.40, 0.42, 0.45, 0.50, 0.55, 0.60]


def law(a, c=2.0, a0=0.37, beta=0.3):
    return c * (a - a0) ** beta


def table(header="a,modulus [MPa]", values=law):
    return header + "\n" + "".join(f"{a},{values(a)!r}\n" for a in A)


class PowerLaw(ProgramTest):
    def fit(self, text, *words):
        self.write("table.csv", text)
        return self.succeed_json("fit", "power-law", "table.csv", *words)

    def test_exact_table_in_any_unit(self):
        for text, words in ((table(), ()), (table("A [1];Modulus (MPa)").replace(",", ";"), ()),
                            ("# moduli by coagula shear\n" + table("a,storage [Mbar]", lambda a: law(a) / 1e5), ("--modulus", "storage")),
                            (table("a,modulus"), ("--modulus-unit", "1MPa"))):
            with self.subTest(text=text.split("\n")[0]):
                found = self.fit(text, *words)
                self.assertAlmostEqual(found["a0"], 0.37, delta=1e-6)
                self.assertAlmostEqual(found["beta"], 0.3, delta=1e-5)
                self.assertAlmostEqual(found["c"] / 2e6, 1, delta=1e-4)
                self.assertEqual((found["minimum"], found["structures"], found["degrees_of_freedom"]), ("inside", 6, 3))
                self.assertFalse(found["weighted"])

    def test_profile_and_interval(self):
        wrong = [0.03, -0.04, 0.02, 0.03, -0.03, 0.01]
        text = "a,modulus [MPa]\n" + "".join(f"{a},{law(a) * (1 + w)}\n" for a, w in zip(A, wrong))
        found = self.fit(text, "--confidence", "0.8", "-o", "profile.csv")
        profile = found["profile"]
        self.assertEqual(profile["a0"], sorted(profile["a0"]))
        least = min(range(len(profile["a0"])), key=lambda k: profile["sum_of_squares"][k])
        self.assertEqual(profile["a0"][least], found["a0"])
        self.assertEqual(profile["confidence"][least], 0)
        low, high = found["a0_interval"]
        for a0, squares, confidence, beta, log_c in zip(*(profile[name] for name in
                                                        ("a0", "sum_of_squares", "confidence", "beta", "log_c"))):
            inside = (low is None or a0 >= low) and a0 <= high
            self.assertEqual(confidence <= 0.8, inside)
            model = [math.exp(log_c + beta * math.log(a - a0)) for a in A]
            total = sum((law(a) * (1 + w) * 1e6 - m) ** 2 for a, w, m in zip(A, wrong, model))
            self.assertAlmostEqual(total / squares, 1, delta=1e-9)
        with open(self.folder / "profile.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(row["a0"]) for row in rows], profile["a0"])
        self.assertEqual([float(row["sum_of_squares [Pa2]"]) for row in rows], profile["sum_of_squares"])

    def test_leaving_one_out(self):
        text = table().replace(f"0.4,{law(0.4)!r}", "0.4,0.1")
        found = self.fit(text)
        self.assertEqual(found["decisive_structure"], 1)
        self.assertAlmostEqual(found["without"][0]["a0"], 0.37, delta=1e-6)
        self.assertEqual([entry["a"] for entry in found["without"]], A)
        self.assertRegex(self.succeed("fit", "power-law", "table.csv"), r"without a = 0.4 +a0 0.37, .*<- moves a0 most\n")

    def test_standard_errors_weigh(self):
        def weighted(errors):
            return "a,modulus [MPa],standard_error [kPa]\n" + "".join(f"{a},{law(a)!r},{e}\n" for a, e in zip(A, errors))

        even = self.fit(weighted([20] * 6).replace(f"0.6,{law(0.6)!r}", "0.6,1.25"))
        self.assertTrue(even["weighted"])
        doubted = self.fit(weighted([20] * 5 + [1e5]).replace(f"0.6,{law(0.6)!r}", "0.6,1.25"))
        self.assertGreater(abs(even["a0"] - 0.37), 1e-4)
        self.assertAlmostEqual(doubted["a0"], 0.37, delta=1e-6)
        self.assertGreater(even["a0_stderr"], 0)

    def test_data_that_decide_nothing_say_so(self):
        found = self.fit(table(values=lambda a: 0.01 * math.exp(10 * a)))
        self.assertEqual(found["minimum"], "far_away")
        self.assertIn("without a threshold", found["summary"])
        self.assertIsNone(found["a0_stderr"])
        self.assertIn("unbounded", self.succeed("fit", "power-law", "table.csv"))
        falling = self.fit(table(values=lambda a: 1 / a))  # a power law too
        self.assertAlmostEqual(falling["beta"], -1, delta=1e-5)
        self.assertIn("not a threshold", falling["summary"])

    def test_refused(self):
        def refuse(text, says, *words):
            self.write("bad.csv", text)
            self.fail_with(2, "fit", "power-law", "bad.csv", *words, says=["bad.csv", says], may_say_nan=True)

        refuse("", "no header")
        refuse("a,modulus [MPa]\n0.4,1\n0.5,2\n", "at least three structures")
        refuse(table(values=lambda a: 1.5), "no exponent")
        refuse(table(values=lambda a: 0.0), "positive")
        refuse(table("a,modulus"), "names no unit")
        refuse(table("a,modulus [s]"), "another dimension")
        refuse(table("a [um],modulus [Pa]"), "another dimension")
        refuse(table("b,modulus [Pa]"), "no column a")
        refuse(table() + "0.7\n", "line 8")
        refuse(table() + "0.7,nan\n", "line 8")
        refuse(table() + "0.7,1e308\n", "too large")
        refuse(table(), "error", "--standard-error", "error")
        self.fail_with(2, "fit", "power-law", "absent.csv", says="absent.csv")
        self.write("good.csv", table())
        self.fail_with(2, "fit", "power-law", "good.csv", "--confidence", "1", says="--confidence")
        self.fail_with(2, "fit", "power-law", "good.csv", "-o", "good.csv", says="good.csv")


if __name__ == "__main__":
    unittest.main()
