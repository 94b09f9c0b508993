# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose on creep, stress relaxation, start-up, and viscosity against time."""

import math
import os
import random
import tomllib
import unittest
from pathlib import Path

from diagnosis_support import PLATES, Tables

DATA = Path(os.environ["COAGULA_DATASETS"])
SMOOTH = '[material]\nkind = "smooth"\n'
OIL = '[material]\nkind = "newtonian"\n'
LAST = 10.0  # s
ROWS = [0.002 * k for k in range(1, 500)] + [10**(k / 60) for k in range(61)]


def measurement(kind, file="t.csv", more=""):
    return f'[[measurement]]\nkind = "{kind}"\nfile = "{file}"\n{more}\n'


def ringing_strains(inertia, stress=10.0, radius=12.5e-3, gap=1e-3):
    """Strain at the times ROWS under a constant torque, of a standard linear solid with a viscosity, by Runge and Kutta's method."""
    elastic, relaxing, relaxation, viscosity = 5000.0, 1000.0, 1.0, 5.0
    stiffness, torque = math.pi * radius**4 / (2 * gap), stress * math.pi * radius**3 / 2
    step = 5e-4

    def motion(state):
        angle, speed, relaxed = state
        return speed, (torque - stiffness * (elastic * angle + relaxed + viscosity * speed)) / inertia, relaxing * speed - relaxed / relaxation

    strains, state, done = [], (0.0, 0.0, 0.0), 0
    for time in ROWS:
        while done < round(time / step):
            a = motion(state)
            b = motion([x + step / 2 * d for x, d in zip(state, a)])
            c = motion([x + step / 2 * d for x, d in zip(state, b)])
            d = motion([x + step * e for x, e in zip(state, c)])
            state = tuple(x + step / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(state, a, b, c, d))
            done += 1
        strains.append(state[0] * radius / gap)
    return strains


class Creep(Tables):
    def ring(self, inertia, scatter=1e-3):
        number = random.Random(1)
        strains = ringing_strains(inertia)
        noise = scatter * strains[-1]
        times = [round(t / 5e-4) * 5e-4 for t in ROWS]
        self.table("t.csv", ("time [s]", "strain [1]", "stress [Pa]"),
                   [(t, s + number.gauss(0, noise), 10.0) for t, s in zip(times, strains)])
        return SMOOTH + PLATES + measurement("creep")

    def test_ringing_is_the_inertia_of_the_tool(self):
        found = self.diagnosis(self.ring(20e-6))
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["tool-inertia"]))
        self.assertEqual((found["follows"]["link"], found["follows"]["axis"]), ("tool", "frequency"))
        inertia = found["causes"][0]["parameters"]["inertia"]
        self.assertTrue(inertia["low"] < 20e-6 < inertia["high"], inertia)
        self.assertLess(inertia["high"] / inertia["low"], 1.6)
        self.assertIn("rows of the creep, from", found["notes"][0])
        (table,) = self.succeed_json("diagnose", "check", "experiment.toml")["measurements"]
        compared = table["compared_as"]
        self.assertEqual((compared["kind"], compared["rows_used"]), ("frequency-sweep", len(ROWS)))
        self.assertEqual(len(found["rows"]), 2 * compared["rows"])
        slowest = [row["measured"] for row in found["rows"] if row["observable"] == "storage_modulus"][-1]
        w = compared["lowest_frequency"]
        self.assertAlmostEqual(slowest / (5000 + 1000 * w**2 / (1 + w**2)), 1, delta=0.02)

    def test_without_inertia_nothing_is_found(self):
        # Of the equation of motion without its first term.
        found = self.diagnosis(self.ring(2e-7))
        self.assertEqual(found["verdict"], "no-discrepancy")

    def test_of_an_oil_at_several_gaps_tells_the_gap_error(self):
        number = random.Random(2)
        text = OIL + PLATES
        for place, gap in enumerate((0.4, 1.6, 0.15, 0.8, 2.4, 0.2, 1.2, 0.1, 0.6, 0.3)):
            rows = [(t, 10 * t / 2 * (1 + 0.03 / gap) * (1 + number.gauss(0, 0.002)), 10.0) for t in (10**(k / 20) for k in range(-40, 41))]
            self.table(f"{place}.csv", ("time [s]", "strain [1]", "stress [Pa]"), rows)
            text += measurement("creep", f"{place}.csv", f'sample = "oil"\nrun_order = {place}\nvalues = {{ gap = "{gap} mm" }}')
        found = self.diagnosis(text)
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["gap-error"]))
        gap = found["causes"][0]["parameters"]["gap_error"]
        self.assertTrue(gap["low"] < 3e-5 < gap["high"], gap)


class Relaxation(Tables):
    def test_of_a_gel_without_a_fault(self):
        number = random.Random(3)
        rows = [(t, 0.01, 0.01 * (1000 + 300 * math.exp(-t / 3) + 200 * (1 + t)**-0.5) * (1 + number.gauss(0, 0.01)))
                for t in (10**(k / 40) for k in range(-80, 81))]
        self.table("t.csv", ("time [s]", "strain [1]", "stress [Pa]"), rows)
        self.assertEqual(self.diagnosis(SMOOTH + PLATES + measurement("stress-relaxation"))["verdict"], "no-discrepancy")

    def moduli(self, text):
        """By angular frequency, in tables of their own."""
        found = self.diagnosis(SMOOTH + PLATES + text)
        self.assertEqual(found["verdict"], "no-discrepancy")
        (table,) = self.succeed_json("diagnose", "check", "experiment.toml")["measurements"]
        parts = [[row["measured"] for row in found["rows"] if row["observable"] == name] for name in ("storage_modulus", "loss_modulus")]
        return {table["compared_as"]["highest_frequency"] / 10**(k / 5): complex(*both) for k, both in enumerate(zip(*parts))}

    def test_of_a_step_down_and_a_start_up_is_the_same_modulus(self):
        times = [10**(k / 40) for k in range(-80, 81)]
        self.table("r.csv", ("time [s]", "relaxation modulus [Pa]"), [(t, 100 * math.exp(-t)) for t in times])
        self.table("u.csv", ("time [s]", "shear rate [1/s]", "stress [Pa]"), [(t, 0.1, 10 * (1 - math.exp(-t))) for t in times])
        self.table("h.csv", ("time [s]", "shear rate [1/s]", "stress [Pa]"), [(t, 0.05, 5 + 5 * math.exp(-t)) for t in times])
        self.table("d.csv", ("time [s]", "stress [Pa]"), [(t, 10 * math.exp(-t)) for t in times])
        before = 'rate_before = "0.1 1/s"\nstress_before = 10'
        for text in (measurement("stress-relaxation", "r.csv"), measurement("start-up", "u.csv"), measurement("start-up", "h.csv", before),
                     measurement("start-up", "d.csv", before)):
            moduli = self.moduli(text)
            self.assertGreater(len(moduli), 15)
            for w, modulus in moduli.items():
                self.assertLess(abs(modulus / (100j * w / (1 + 1j * w)) - 1), 0.01, (text, w))

    def test_of_a_start_up_beside_a_relaxation(self):
        times = [10**(k / 40) for k in range(-80, 81)]
        self.table("r.csv", ("time [s]", "relaxation modulus [Pa]"), [(t, 100 * math.exp(-t)) for t in times])
        self.table("s.csv", ("time [s]", "shear rate [1/s]", "stress [Pa]"), [(t, 0.1, 10 * (1 - math.exp(-t))) for t in times])
        found = self.diagnosis(SMOOTH + PLATES + measurement("stress-relaxation", "r.csv") + measurement("start-up", "s.csv"))
        self.assertEqual(found["verdict"], "no-discrepancy")
        moduli = [{row["row"]: row["measured"] for row in found["rows"] if row["measurement"] == m and row["observable"] == "loss_modulus"}
                  for m in sorted({row["measurement"] for row in found["rows"]})]
        self.assertEqual(len(moduli), 2)


class SteadyShear(Tables):
    def test_a_drift_of_the_temperature_is_seen_in_the_viscosity(self):
        number = random.Random(4)
        rows = [(t, 10.0, math.exp(0.2 * math.exp(-t / 600)) * (1 + number.gauss(0, 0.003))) for t in range(20, 3620, 60)]
        self.table("t.csv", ("time [s]", "shear rate [1/s]", "viscosity [Pa.s]"), rows)
        found = self.diagnosis(OIL + PLATES + "[noise]\nstated_relative = 0.003\n" + measurement("steady-shear"))
        self.assertTrue(found["detected"])
        self.assertEqual(found["credible_set"][0], "temperature-drift")

    def test_nothing_is_found_in_one_that_stays(self):
        number = random.Random(5)
        rows = [(t, 10.0, 1 + number.gauss(0, 0.003)) for t in range(20, 3620, 60)]
        self.table("t.csv", ("time [s]", "shear rate [1/s]", "stress [Pa]"), [(t, r, r * v) for t, r, v in rows])
        found = self.diagnosis(OIL + PLATES + "[noise]\nstated_relative = 0.003\n" + measurement("steady-shear"))
        self.assertEqual(found["verdict"], "no-discrepancy")


class BadInput(Tables):
    TIMES = [10**(k / 10) for k in range(-20, 21)]

    def refuse_table(self, kind, heads, rows, *says, more=""):
        self.table("t.csv", heads, rows)
        self.refuse(SMOOTH + PLATES + measurement(kind, more=more), "t.csv: ", *says)

    def test_creep(self):
        heads = ("time [s]", "strain [1]", "stress [Pa]")
        rise = [1 - math.exp(-t) for t in self.TIMES]
        self.refuse_table("creep", heads, zip(self.TIMES, rise, [0.0] * 41), "'stress' is 0 in every row, but a creep is the answer to a step of it")
        self.refuse_table("creep", heads, zip(self.TIMES, rise, [-1.0] * 41), "'stress' and 'strain' have opposite signs in most rows")
        self.refuse_table("creep", heads, zip(reversed(self.TIMES), rise, [1.0] * 41), "the rows are in the wrong order: 40 of 41 values of 'time'")
        self.refuse_table("creep", heads, list(zip(self.TIMES, rise, [1.0] * 41))[:1], "1 usable rows are too few: a table of kind creep needs at least 8")
        self.refuse_table("creep", heads, zip(self.TIMES, rise, [math.nan] * 41), "column 'compliance' has no readable number")
        self.refuse_table("creep", heads, zip(self.TIMES, rise, self.TIMES), "'stress' must stay in a creep, but goes from 10 mPa to 100 Pa")
        self.refuse_table("creep", heads[:2], zip(self.TIMES, rise), "there is no column 'compliance', which a table of kind creep needs")
        self.refuse_table("creep", heads, ((t + 1000, s, 1.0) for t, s in zip(self.TIMES, rise)), "state time_zero")
        self.refuse_table("creep", ("time [s]", "compliance [m]"), zip(self.TIMES, rise), "column 'compliance': ")
        self.refuse_table("creep", ("time [s]", "compliance [1/Pa]"), ((t, -s) for t, s in zip(self.TIMES, rise)), "0 usable rows are too few")

    def test_start_up_that_overshoots(self):
        rows = [(t, 2.0, 1 - math.exp(-t) + t * math.exp(-t / 2)) for t in self.TIMES]
        self.refuse_table("start-up", ("time [s]", "shear rate [1/s]", "stress [Pa]"), rows,
                          "the stress overshoots by", "the sample is not linear there", "choose the rows before it by rows = [first, last]")

    def test_rate_before(self):
        self.table("t.csv", ("time [s]", "stress [Pa]"), [(t, math.exp(-t)) for t in self.TIMES])
        rate, stress = 'rate_before = "0.1 1/s"', "stress_before = 10"
        self.refuse(SMOOTH + measurement("start-up", more=rate), "key 'rate_before'", "needs stress_before, too: the steady stress")
        self.refuse(SMOOTH + measurement("start-up", more=stress), "key 'stress_before'", "needs rate_before")
        self.refuse(SMOOTH + measurement("creep", more=f"{rate}\n{stress}"), "key 'rate_before'", "only a table of kind start-up begins from a rate")

    def test_relaxation_too_short(self):
        rows = [(1 + 0.2 * k, 0.1, 10 - k) for k in range(9)]
        self.refuse_table("stress-relaxation", ("time [s]", "strain [1]", "stress [Pa]"), rows, "its first row is at 1 s and its last one at 2.6 s")

    def test_planned(self):
        self.refuse('[[measurement]]\nkind = "creep"\nplanned = { from = "1 s", to = "10 s", points = 9 }\n',
                    "a creep is planned as a table of kind frequency-sweep")

    def test_on_a_network_flow_needs_another_material(self):
        self.table("t.csv", ("time [s]", "shear rate [1/s]", "viscosity [Pa.s]"), [(t, 10.0, 1 + 0.01 * t) for t in self.TIMES])
        self.refuse(measurement("steady-shear"), "t.csv is of steady flow, which no simulated network of particles stands for")


class Exports(Tables):
    def accepted(self, *exports):
        self.succeed("diagnose", "new", *exports, "-o", "e.toml", "--force")
        return self.succeed_json("diagnose", "check", "e.toml")["measurements"]

    def test_of_instruments_are_recognised(self):
        toolkit = DATA / "rheodata_toolkit/anton_paar"
        relaxations = self.accepted(toolkit / "relaxation_curve/multiple relaxation.csv")
        self.assertEqual([table["kind"] for table in relaxations], 2 * ["stress-relaxation"])
        self.assertEqual([table["compared_as"]["rows_used"] for table in relaxations], [450, 151])
        (steady,) = self.accepted(toolkit / "shear_test/shear_test.csv")
        self.assertEqual(steady["kind"], "steady-shear")
        self.assertIn('\nkind = "newtonian"', (self.folder / "e.toml").read_text())
        (creep,) = self.accepted(DATA / "trios_lims_json/creep_experiment.txt")
        self.assertEqual(creep["kind"], "creep")
        self.assertIn('\nkind = "smooth"', (self.folder / "e.toml").read_text())

    def test_a_creep_of_an_instrument_rings_with_its_inertia(self):
        creep = DATA / "trios_lims_json/creep_experiment.txt"
        found = self.diagnosis(f'{SMOOTH}[instrument]\nstress_constant = 325950\nstrain_constant = 12.5\n{measurement("creep", creep)}')
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["tool-inertia"]))
        inertia = found["causes"][0]["parameters"]["inertia"]
        self.assertTrue(20e-6 < inertia["low"] and inertia["high"] < 35e-6, inertia)  # of the instrument alone: 20.9 to 25


class RatesOneBelowTheOther(Tables):
    """One table with several shear rates, as an instrument writes steps of the rate."""

    RATES = (1.0, 10.0, 2.0)  # 1/s
    VISCOSITY, RELAXATION = 0.5, 0.3  # of a Maxwell fluid

    def table(self, heading, row, clock_restarts=False):
        noise = random.Random(1)
        rows, stress = [], 0.0
        for number, rate in enumerate(self.RATES):
            steady = self.VISCOSITY * rate
            for time in [0.02 * 1500 ** (k / 39) for k in range(40)]:
                now = steady + (stress - steady) * math.exp(-time / self.RELAXATION)
                measured = rate * (1 + 0.002 * noise.gauss(0, 1))
                rows.append(row(time + (0 if clock_restarts else 30 * number), measured, now))
            stress = steady
        return "\n".join([heading, *(",".join(f"{value:.6g}" for value in values) for values in rows)]) + "\n"

    def proposed(self, text):
        self.write("t.csv", text)
        self.succeed("diagnose", "new", "t.csv", "-o", "e.toml", "--force")
        return tomllib.loads((self.folder / "e.toml").read_text()).get("measurement", [])

    def number(self, text):
        value, unit = text.split(" ")
        return float(value) * {"m": 1e-3}.get(unit[0] if len(unit) > 3 or unit == "mPa" else "", 1)

    def check_steps(self, tables, zeros):
        self.assertEqual([table["kind"] for table in tables], ["start-up"] * 3)
        self.assertEqual([table["rows"] for table in tables], [[1, 40], [41, 80], [81, 120]])
        self.assertNotIn("rate_before", tables[0])
        for table, rate, zero in zip(tables[1:], self.RATES, zeros):
            self.assertAlmostEqual(self.number(table["rate_before"]) / rate, 1, delta=0.01)
            self.assertAlmostEqual(self.number(table["stress_before"]) / (self.VISCOSITY * rate), 1, delta=0.01)
            self.assertEqual(table.get("time_zero"), zero)
        found = self.succeed_json("diagnose", "check", "e.toml")
        self.assertEqual(len(found["measurements"]), 3)

    def test_are_start_ups_from_the_rate_before(self):
        tables = self.proposed(self.table("time [s],shear rate [1/s],shear stress [Pa]", lambda t, r, s: (t, r, s)))
        self.check_steps(tables, ["30 s", "60 s"])
        self.assertEqual(self.succeed_json("diagnose", "e.toml", "--bootstrap", 99, "-o", "out")["verdict"], "no-discrepancy")

    def test_a_clock_that_restarts_and_a_viscosity(self):
        text = self.table("time [s],shear rate [1/s],viscosity [Pa s]", lambda t, r, s: (t, r, s / r), clock_restarts=True)
        self.check_steps(self.proposed(text), [None, None])

    def test_a_ramp_has_no_rates_that_stay(self):
        rates = [0.1 * 1.01**k for k in range(300)] + [0.1 * 1.01**k for k in range(300, 0, -1)]
        text = "time [s],shear rate [1/s],shear stress [Pa]\n" + "".join(f"{k},{r:.6g},{0.5 * r:.6g}\n" for k, r in enumerate(rates))
        self.write("t.csv", text)
        self.fail_with(2, "diagnose", "new", "t.csv", says=["flow-curve", "wrong order"])

    def test_blood_overshoots(self):
        self.succeed("diagnose", "new", DATA / "blood_steps" / "Steps.xlsx", "-o", "e.toml")
        text = (self.folder / "e.toml").read_text()
        for rate in ("0.1014 1/s to 5.0154", "0.10092 1/s to 10.031", "0.10022 1/s to 20.062"):
            self.assertIn(f"shear_rate steps from {rate} 1/s, but", text)
        self.assertEqual(text.count("the stress overshoots by"), 4)


if __name__ == "__main__":
    unittest.main()
