# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports of real instruments, from coagula diagnose new to diagnose check: what is taken over, chosen, left out and said."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

from support import ProgramTest

DATA = Path(os.environ["COAGULA_DATASETS"])
ROOT = Path(__file__).resolve().parent.parent.parent
LINSEED = DATA / "rheodata_toolkit/anton_paar/gwens_data/Steady State Viscosity Curve-35C.csv"
GELS = DATA / "deforest_hydrogels"
JSON = DATA / "trios_lims_json/tadatakit/dataset.json"
XML = "rheodata_toolkit/anton_paar/gwens_data/Steady State Viscosity Curve-LO80C_xml.xml"
JAPANESE = DATA / "rheoplus_japanese/datafile.csv"


class NewExperiment(ProgramTest):
    def accepted(self, *exports):
        """The kinds of an experiment that is made of exports and accepted as it stands."""
        self.succeed("diagnose", "new", *exports, "-o", "e.toml")
        return [table["kind"] for table in self.succeed_json("diagnose", "check", "e.toml")["measurements"]]

    def test_rheoplus(self):
        kinds = self.accepted(GELS / "TXT_N2.csv", GELS / "PXP_N1.csv")
        self.assertEqual(kinds[:4], ["time-sweep", "frequency-sweep", "time-sweep", "amplitude-sweep"])
        self.assertEqual(len(kinds), 23)

    def test_trios(self):
        self.assertEqual(self.accepted(DATA / "trios_lims_json/multi_technique.txt"), ["amplitude-sweep", "frequency-sweep"])
        text = (self.folder / "e.toml").read_text()
        self.assertIn("# table 3, 'Flow ramp - 3', 223 rows, is not used: flow-curve, but the rows are in the wrong order", text)

    def test_twenty_temperatures(self):
        self.assertEqual(self.accepted(DATA / "trios_lims_json/frequency_sweep_tts.txt"), 20 * ["frequency-sweep"])

    def test_rheowin_with_blanks_in_its_name(self):
        self.assertEqual(self.accepted(DATA / "haake_rheowin_pt/Ur5-2 conjunto   20.45.21 2018-02-28.txt"), ["frequency-sweep", "flow-curve"])

    def test_rheocompass_in_german(self):
        self.assertEqual(self.accepted(DATA / "cement_laos/SAOS_0.55_250.csv", DATA / "cement_laos/LAOS_0.55_250_3.csv"),
                         ["time-sweep", "amplitude-sweep"])

    def test_old_workbook(self):
        kinds = self.accepted(DATA / "rheofit_flow/trios_xls/10sle1s_85castoroil-3.xls")
        self.assertEqual(kinds, ["amplitude-sweep", "flow-curve"])
        taken = {value["name"]: value for value in self.succeed_json("diagnose", "check", "e.toml")["taken_over"]}
        self.assertEqual((taken["inner_radius"]["value"], taken["inner_radius"]["unit"]), (0.014, "m"))
        self.assertEqual({value["fate"] for value in taken.values()}, {"taken over"})

    def test_what_cannot_be_diagnosed_is_refused(self):
        self.write("rates.csv", "time [s],shear rate [1/s]\n" + "".join(f"{k},{10 * k}\n" for k in range(1, 9)))
        for options in ((), ("--json",), ("-o", "e.toml")):
            self.fail_with(2, "diagnose", "new", "rates.csv", *options, says=("rates.csv: the table cannot be diagnosed as it is: table 1: a flow curve or steps",
                                                                          "there is no storage modulus"))
        self.fail_with(2, "diagnose", "new", "rates.csv", DATA / "drilling_suspensions/RheogramSet.txt", "-o", "e.toml",
                       says=("none of the 386 tables can be diagnosed as it is", "table 1 of ", "; ..."))
        self.succeed("diagnose", "new", "rates.csv", JAPANESE, "-o", "e.toml")  # one that can be used is enough
        self.fail_with(3, "diagnose", "new", JAPANESE, "-o", "e.toml", says="e.toml")  # is there already

    def test_flow_curves_are_of_an_oil(self):
        self.assertEqual(self.accepted(LINSEED), 12 * ["flow-curve"])
        self.assertIn('\nkind = "newtonian"', (self.folder / "e.toml").read_text())

    def test_prints_without_a_file_to_write(self):
        printed = self.succeed("diagnose", "new", JAPANESE)
        self.write("e.toml", printed)
        self.assertEqual(len(self.succeed_json("diagnose", "check", "e.toml")["measurements"]), 25)

    def test_names_that_toml_must_quote(self):
        for name in ('a "b" c.csv', "back\\slash.csv", "tab\tand\nline.csv", "a\x7fb\x1b.csv", "\x85 c.csv"):
            self.write(name, "ω [rad/s],G' (Pa),mine [m]\n" + "".join(f"{w},{100 + w},1\n" for w in range(1, 8)))
            self.succeed("diagnose", "new", name, "-o", "e.toml", "--force")
            (table,) = self.succeed_json("diagnose", "check", "e.toml")["measurements"]
            self.assertEqual((table["kind"], table["not_understood"]), ("frequency-sweep", ["'mine [m]'"]))
            self.assertEqual(table["sample"], name[:-len(".csv")])
            self.assertNotRegex((self.folder / "e.toml").read_text(), "[\x00-\x09\x0b-\x1f\x7f-\x9f]")

    def test_the_page_shows_what_the_program_reads(self):
        done = subprocess.run([sys.executable, ROOT / "scripts/update-instrument-exports", "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_bad_input(self):
        self.fail_with(2, "diagnose", "new", says="coagula diagnose new needs EXPORT")
        self.fail_with(2, "diagnose", "new", "absent.csv", says="absent.csv")
        self.fail_with(2, "diagnose", "new", DATA / XML, says="which is not read: export the measurement as text")
        self.fail_with(2, "diagnose", "--new", "--check", JSON, says="--check is not read with --new")
        self.fail_with(2, "diagnose", JSON, JSON, says="takes one EXPERIMENT.toml")


class Selection(ProgramTest):
    def check(self, text):
        self.write("e.toml", f"[[measurement]]\n{text}\n")
        return self.succeed_json("diagnose", "check", "e.toml")["measurements"]

    def refuse(self, text, *says):
        self.write("e.toml", f"[[measurement]]\n{text}\n")
        self.fail_with(2, "diagnose", "check", "e.toml", says=says)

    def test_sections_of_one_name_by_number_range_and_test(self):
        series = f'kind = "frequency-sweep"\nfile = "{JAPANESE}"\n'
        (table,) = self.check(series + "table = 7")
        self.assertTrue(table["label"].endswith("datafile.csv, table 7"))
        tables = self.check(series + 'table = [2, 13]\nsample = "polymer"')
        self.assertEqual([table["run_order"] for table in tables], list(range(12)))
        self.assertEqual({table["sample"] for table in tables}, {"polymer"})
        (table,) = self.check(series + 'result = "2022_1114_freq 1 to 100_temp 70 to 160 step 10 9"')
        self.assertTrue(table["label"].endswith(", table 2"))
        self.refuse(series + "section = 1", "several sections fit", "table = [first, last]", "2: section 1 of '2022_1114_freq", "; ...")
        self.refuse(series + "table = 26", "no section fits")
        self.refuse(series + "table = [3, 2]", "must be a number from 1, or [first, last]")
        curves = f'kind = "frequency-sweep"\nfile = "{LINSEED}"\ntest = "Steady State Viscosity Curve-75C"'
        self.refuse(curves, "Curve-35C.csv, table 2: there is no column 'angular_frequency'")

    def test_columns_of_a_file_without_headings(self):
        self.write("d.csv", "".join(f"{w};fine;{100 + w}\n" for w in range(1, 8)))
        sweep = 'kind = "frequency-sweep"\nfile = "d.csv"\n'
        (table,) = self.check(sweep + 'columns = ["ω [rad/s]", "", "G\' [kPa]"]')
        self.assertEqual([(c["name"], c["max"]) for c in table["columns"]], [("storage_modulus", 107e3), ("angular_frequency", 7)])
        self.refuse(sweep, 'd.csv: there are no headings; name its 3 columns in the experiment file, columns = ["strain [%]"')
        self.refuse(sweep + 'columns = ["ω [rad/s]", "G\' [Pa]"]', "there are 3 columns, but 'columns' names 2")
        self.refuse(f'kind = "frequency-sweep"\nfile = "{JAPANESE}"\ntable = 1\ncolumns = ["ω [rad/s]"]', "has headings")

    def test_a_heading_that_is_not_understood_comes_with_the_line_to_add(self):
        self.write("u.csv", "Schwingung [rad/s],G' [Pa]\n" + "".join(f"{w},{100 + w}\n" for w in range(1, 8)))
        sweep = 'kind = "frequency-sweep"\nfile = "u.csv"\n'
        self.refuse(sweep, "no column 'angular_frequency'", "; not understood are the columns 'Schwingung [rad/s]'",
                    'columns = { angular_frequency = "Schwingung [rad/s]" }')
        (table,) = self.check(sweep + 'columns = { angular_frequency = "Schwingung [rad/s]" }')
        self.assertEqual((table["rows"], table["not_understood"]), (7, []))


class Metadata(ProgramTest):
    def taken(self, text):
        self.write("e.toml", text)
        return {value["name"]: value for value in self.succeed_json("diagnose", "check", "e.toml")["taken_over"]}

    MEASUREMENT = f'[[measurement]]\nkind = "frequency-sweep"\nfile = "{JAPANESE}"\ntable = 1\n'

    def test_is_taken_over_shown_and_overridden(self):
        taken = self.taken(self.MEASUREMENT)
        self.assertEqual({name: value["value"] for name, value in taken.items()},
                         {"geometry": "plate-plate", "plate_radius": 0.004, "temperature": 433.15})
        self.assertEqual(taken["plate_radius"]["source"], f"{JAPANESE}: 測定治具 PP08-SN23708; [d=0.1 mm]")
        self.assertIn("4 mm, from", self.succeed("diagnose", "check", "e.toml"))
        taken = self.taken('[sample]\ntemperature = "20 degC"\n[instrument]\nplate_radius = "5 mm"\n' + self.MEASUREMENT)
        self.assertEqual(taken["plate_radius"]["fate"], "not taken over: [instrument] gives it")
        self.assertEqual(taken["geometry"]["fate"], "taken over")
        self.assertNotIn("temperature", taken)
        taken = self.taken('[instrument]\ngap = "4.5 mm"\n' + self.MEASUREMENT)  # wider than the radius of the plate
        self.assertIn("not taken over: instrument.gap is 0.0045 m, but must be below plate_radius", taken["plate_radius"]["fate"])

    def test_of_exports_that_differ_counts_for_their_tables(self):
        rows = "".join(f"{w}\t{100 + w}\n" for w in range(1, 8))
        for number, (diameter, inertia) in enumerate(((25, 1), (40, 2))):
            self.write(f"{number}.txt", f"[Geometry]\nDiameter\t{diameter} mm\nGeometry Inertia\t{inertia} µN.m.s²\n[step]\nA\n"
                                        f"Angular frequency\tStorage modulus\nrad/s\tPa\n{rows.replace('101', str(101 + number))}")
        self.write("e.toml", "".join(f'[[measurement]]\nkind = "frequency-sweep"\nfile = "{n}.txt"\n' for n in (0, 1)))
        found = self.succeed_json("diagnose", "check", "e.toml")
        radii = [{c["name"]: c["max"] for c in table["columns"]}["plate_radius"] for table in found["measurements"]]
        self.assertEqual(radii, [0.0125, 0.02])
        fates = {(value["name"], value["fate"]) for value in found["taken_over"]}
        self.assertEqual(fates, {("plate_radius", "taken over for its tables"),
                                 ("tool_inertia", "not taken over: the exports differ; say it in [instrument]")})

    def test_empty_cells_and_flags_are_counted(self):
        self.write("e.toml", f'[[measurement]]\nkind = "amplitude-sweep"\nfile = "{GELS / "TXT_N2.csv"}"\ntable = 4\n')
        (table,) = self.succeed_json("diagnose", "check", "e.toml")["measurements"]
        self.assertGreater(table["flags"]["ME-"], 0)
        reasons = {cell["reason"] for cell in table["left_out"]}
        self.assertIn("stands for a negative value, as the flag ME- or MV- says", reasons)
        said = self.succeed("diagnose", "check", "e.toml")
        self.assertRegex(said, r"  flags +ME- in \d+ rows")


if __name__ == "__main__":
    unittest.main()
