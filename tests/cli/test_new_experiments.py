# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose new proposes what diagnose check accepts: derived moduli, units, stepped sweeps, clocks, tables side by side, shifted columns."""

import math
import os
import unittest
from pathlib import Path

from support import ProgramTest

DATA = Path(os.environ["COAGULA_DATASETS"])
OMEGAS = [10 ** (2 - k / 5) for k in range(16)]  # rad/s, 100 to 0.1


def storage(omega):
    return 900 + 3 * omega


def loss(omega):
    return 100 + 0.8 * omega


def size(omega):
    return math.hypot(storage(omega), loss(omega))


def phase(omega):
    return math.atan2(loss(omega), storage(omega))


class Proposals(ProgramTest):
    def proposed(self, *exports):
        """The measurements of an experiment that --check accepts as it stands."""
        self.succeed("diagnose", "new", *exports, "-o", "e.toml", "--force")
        self.text = (self.folder / "e.toml").read_text()
        self.found = self.succeed_json("diagnose", "check", "e.toml")
        return self.found["measurements"]

    def ranges(self, table):
        return {column["name"]: (column["min"], column["max"]) for column in table["columns"]}


class DerivedModuli(Proposals):
    """Exports of |G*| or |eta*| with a phase or its tangent, as rheometers for asphalt give them."""

    def test_the_moduli_follow(self):
        angles = (("δ [°]", lambda w: math.degrees(phase(w))), ("Phase angle [rad]", phase), ("tan(delta)", lambda w: math.tan(phase(w))))
        sizes = (("G* [Pa]", size), ("|G*| [kPa]", lambda w: size(w) / 1e3), ("Complex viscosity [mPa·s]", lambda w: 1e3 * size(w) / w))
        axes = (("Angular frequency [rad/s]", lambda w: w), ("Frequency [Hz]", lambda w: w / 2 / math.pi), ("Freq [rad/s]", lambda w: w))
        for columns in [(axes[k % 3], sizes[k // 3], angles[(k + k // 3) % 3]) for k in range(9)]:
            with self.subTest(headings=[heading for heading, _ in columns]):
                rows = [",".join(heading for heading, _ in columns)]
                rows += [",".join(f"{value(omega):.8g}" for _, value in columns) for omega in OMEGAS]
                self.write("s.csv", "\n".join(rows) + "\n")
                (table,) = self.proposed("s.csv")
                self.assertEqual((table["kind"], table["rows"]), ("frequency-sweep", 16))
                found = self.ranges(table)
                for name, value in (("angular_frequency", lambda w: w), ("storage_modulus", storage), ("loss_modulus", loss)):
                    for got, right in zip(found[name], (value(OMEGAS[-1]), value(OMEGAS[0]))):
                        self.assertAlmostEqual(got / right, 1, delta=1e-6)

    def test_what_is_missing_is_named(self):
        rows = "".join(f"{omega:.6g},{storage(omega):.6g}\n" for omega in OMEGAS)
        self.write("s.csv", "ω [rad/s],Steifigkeit [Pa]\n" + rows)
        self.fail_with(2, "diagnose", "new", "s.csv", says=(
            "s.csv: the table cannot be diagnosed as it is: table 1: an oscillation: there is neither a storage modulus nor |G*|",
            "not understood: 'Steifigkeit [Pa]'", 'columns = { storage_modulus = "Steifigkeit [Pa]" }'))
        self.write("s.csv", "ω [rad/s],G' [Pa],G'' [Pa]\n" + "".join(f"{omega:.6g},---,1\n" for omega in OMEGAS))
        self.fail_with(2, "diagnose", "new", "s.csv", says="the column 'G'' holds no number")


class Units(Proposals):
    def sweep(self, headings, *values):
        lines = [",".join(f"{value(omega):.8g}" for value in (lambda w: w, storage, loss, *values)) for omega in OMEGAS]
        self.write("s.csv", "\n".join([headings, *lines]) + "\n")

    def test_a_column_without_a_unit_that_nobody_needs_is_ignored(self):
        self.sweep("ω [rad/s],G' [Pa],G'' [Pa],Temperature,Torque", lambda w: 25, lambda w: w)
        (table,) = self.proposed("s.csv")
        self.assertEqual(set(self.ranges(table)), {"angular_frequency", "storage_modulus", "loss_modulus"})
        self.assertIn("s.csv: the column 'Temperature' names no unit and is not used", self.found["notes"])
        self.assertIn("# without a unit, and not used: 'Temperature', 'Torque'", self.text)
        self.sweep("ω [rad/s],G' [Pa],G''")
        self.fail_with(2, "diagnose", "new", "s.csv", says='column \'G\'\'\' names no unit; it must be one that converts into Pa')
        self.write("e.toml", '[[measurement]]\nkind = "frequency-sweep"\nfile = "s.csv"\ncolumns = { loss_modulus = "G\'\' [kPa]" }\n')
        (table,) = self.succeed_json("diagnose", "check", "e.toml")["measurements"]
        self.assertAlmostEqual(self.ranges(table)["loss_modulus"][1], 1e3 * loss(100))

    def test_units_that_no_column_names_are_assumed_where_all_can_see_it(self):
        self.sweep("omega,Gp,Gpp")
        said = self.succeed("diagnose", "new", "s.csv", "-o", "e.toml")
        self.assertIn("assumed for 1 tables whose file names none", said)
        (table,) = self.proposed("s.csv")
        self.assertAlmostEqual(self.ranges(table)["storage_modulus"][1], storage(100))
        self.assertIn('columns = { angular_frequency = "omega [rad/s]", loss_modulus = "Gpp [Pa]", storage_modulus = "Gp [Pa]" }'
                      "    # the file names no units: CHECK these", self.text)
        self.write("s.csv", "strain,G',G''\n" + "".join(f"{k},{900 - k},{100 + k}\n" for k in range(1, 12)))
        self.fail_with(2, "diagnose", "new", "s.csv", says="column 'strain' names no unit")  # per cent or not

    def test_seven_temperatures_side_by_side(self):
        tables = self.proposed(DATA / "ttw_wide_table/ttw_70.csv")
        self.assertEqual([table["kind"] for table in tables], 7 * ["frequency-sweep"])
        self.assertEqual({table["sample"] for table in tables}, {"ttw_70"})
        self.assertEqual([table["run_order"] for table in tables], list(range(7)))
        self.assertAlmostEqual(self.ranges(tables[6])["loss_modulus"][1], 93.2)


class Sweeps(Proposals):
    """Several sweeps one below the other in one table."""

    def stepped(self, step, values, axis="ω [rad/s]", along=OMEGAS, back=False):
        text = f"{axis},{step},G' [Pa],G'' [Pa]\n"
        for number, value in enumerate(values):
            sweep = along[::-1] if back and number % 2 else along
            text += "".join(f"{place:.6g},{value},{storage(place) + 10 * number:.8g},{loss(place):.8g}\n" for place in sweep)
        self.write("s.csv", text)

    def test_at_several_gaps_are_those_of_one_sample(self):
        self.stepped("Gap [mm]", (1, 0.75, 0.5))
        tables = self.proposed("s.csv")
        self.assertEqual([(table["kind"], table["rows"], table["run_order"]) for table in tables], [("frequency-sweep", 16, k) for k in range(3)])
        self.assertEqual([self.ranges(table)["gap"][0] for table in tables], [1e-3, 0.75e-3, 0.5e-3])
        self.assertEqual({table["sample"] for table in tables}, {"s"})
        self.assertIn("rows = [17, 32]    # one of the sweeps that the table holds", self.text)

    def test_up_and_down_and_at_several_frequencies(self):
        strains = [0.01 * 1.5 ** k for k in range(12)]
        self.stepped("Frequency [Hz]", (1, 1), axis="Strain [%]", along=strains, back=True)
        self.assertEqual([(table["kind"], table["rows"]) for table in self.proposed("s.csv")], 2 * [("amplitude-sweep", 12)])
        self.stepped("Frequency [Hz]", (0.1, 1, 10), axis="Strain [%]", along=strains)
        self.assertEqual([(table["kind"], table["rows"]) for table in self.proposed("s.csv")], 3 * [("amplitude-sweep", 12)])
        self.stepped("Temperature [°C]", (20, 40), along=OMEGAS[:9])
        self.assertEqual([table["rows"] for table in self.proposed("s.csv")], [9, 9])

    def test_shuffled_rows_are_no_sweeps(self):
        order = [5, 2, 9, 0, 7, 3, 11, 1, 8, 4, 10, 6]
        self.stepped("Gap [mm]", (1,), along=[OMEGAS[k] for k in order])
        self.fail_with(2, "diagnose", "new", "s.csv", says="the rows are in the wrong order")

    def test_a_clock_orders_the_runs(self):
        for name, hour in (("b", 9), ("a", 11)):
            rows = "".join(f"{hour}:{k:02}:00,{omega:.6g},{storage(omega) + hour:.6g}\n" for k, omega in enumerate(OMEGAS))
            self.write(f"{name}.csv", "Time of Day,ω [rad/s],G' [Pa]\n" + rows)
        text = "\n".join(f'[[measurement]]\nkind = "frequency-sweep"\nfile = "{name}.csv"\nsample = "A"\n' for name in "ab")
        self.write("e.toml", text)
        self.assertNotIn("neither run_order nor start", " ".join(self.succeed_json("diagnose", "check", "e.toml")["notes"]))
        self.write("both.csv", (self.folder / "a.csv").read_text() + "\n" + (self.folder / "b.csv").read_text())
        self.assertEqual(len(self.proposed("both.csv")), 2)
        self.assertIn("# the export says when this run began", self.text)
        self.assertNotIn("run_order", self.text)

    def test_a_yielding_gel_goes_up_and_down_as_one_sample(self):
        tables = self.proposed(DATA / "restylane_rheowin/Restylane_syringe_1.txt")
        self.assertEqual({table["kind"] for table in tables}, {"amplitude-sweep"})
        self.assertEqual(len(tables), 9)  # of the tenth series there is one row
        self.assertEqual({table["sample"] for table in tables}, {"Restylane_syringe_1"})
        self.assertAlmostEqual(self.ranges(tables[0])["strain"][0], 0.0008)
        self.assertIn('\nkind = "smooth"', self.text)  # a network that does not yield would leave a broken rim as the only cause
        found = self.succeed_json("diagnose", "e.toml", "-o", "results", "--bootstrap", "99", "--threads", "1")
        self.assertEqual(found["verdict"], "no-discrepancy")

    def test_what_thins_while_it_flows_is_said_to_be_no_oil(self):
        for stress, thins in ((lambda rate: 10 + 2 * rate ** 0.5, True), (lambda rate: 2 * rate ** 0.6, True), (lambda rate: 2e-3 + 2 * rate, False)):
            self.write("f.csv", "Shear rate [1/s],Stress [Pa]\n" + "".join(f"{rate:.6g},{stress(rate):.6g}\n" for rate in OMEGAS))
            (table,) = self.proposed("f.csv")
            self.assertEqual(table["kind"], "flow-curve")
            self.assertIn('\nkind = "newtonian"', self.text)
            self.assertEqual("this sample is no oil" in self.text, thins)


class Assignment(Proposals):
    """Values that do not stand below their headings."""

    HEADINGS = ("Angular frequency [rad/s]", "G' [Pa]", "G'' [Pa]", "|G*| [Pa]", "|η*| [Pa·s]", "δ [°]")

    def rows(self):
        return [[omega, storage(omega), loss(omega), size(omega), size(omega) / omega, math.degrees(phase(omega))] for omega in OMEGAS]

    def table(self, rows, headings=HEADINGS, separator=";"):
        lines = [separator.join(headings), *(separator.join(f"{value:.8g}" for value in row) for row in rows)]
        self.write("s.csv", "\n".join(lines) + "\n")

    def test_a_lost_first_cell_is_given_back(self):
        (table,) = self.proposed(DATA / "rheocompass_variants/frequency_sweep.csv")
        found = self.ranges(table)
        self.assertEqual([found[name] for name in ("angular_frequency", "storage_modulus", "loss_modulus")], [(0.1, 100), (1000, 3300), (100, 4200)])
        self.assertFalse([cell for cell in table["left_out"] if "contradict" in cell["reason"]])

    def test_blank_lines(self):
        (table,) = self.proposed(DATA / "rheocompass_variants/cnf_10c.csv")
        self.assertEqual(self.ranges(table)["storage_modulus"], (34.285, 311.76))

    def test_shifted_columns_are_refused(self):
        self.table(self.rows())
        self.assertEqual(len(self.proposed("s.csv")), 1)
        experiment = '[[measurement]]\nkind = "frequency-sweep"\nfile = "s.csv"\n'
        for name, shifted in (("left", [row[1:] + [row[0]] for row in self.rows()]), ("right", [[k + 1, *row[:-1]] for k, row in enumerate(self.rows())])):
            with self.subTest(shift=name):
                self.table(shifted)
                self.fail_with(2, "diagnose", "new", "s.csv", says="the values do not stand below their headings")
                self.write("e.toml", experiment)
                self.fail_with(2, "diagnose", "check", "e.toml", says=("the columns 'phase', 'complex_modulus' and 'complex_viscosity' ", "contradict the others in most rows", "without = ["))

    def test_one_contradicting_column_is_left_out_and_more_by_the_user(self):
        self.table([[*row[:4], 2 * row[4], row[5]] for row in self.rows()])
        (table,) = self.proposed("s.csv")
        self.assertEqual({cell["column"] for cell in table["left_out"]}, {"complex_viscosity"})
        self.table([[*row[:3], 2 * row[3], 3 * row[4], row[5]] for row in self.rows()])
        experiment = '[[measurement]]\nkind = "frequency-sweep"\nfile = "s.csv"\n'
        self.write("e.toml", experiment)
        self.fail_with(2, "diagnose", "check", "e.toml", says='without = ["complex_modulus", "complex_viscosity"]')
        self.write("e.toml", experiment + 'without = ["complex_modulus", "complex_viscosity"]\n')
        self.assertEqual(self.succeed_json("diagnose", "check", "e.toml")["measurements"][0]["left_out"], [])


if __name__ == "__main__":
    unittest.main()
