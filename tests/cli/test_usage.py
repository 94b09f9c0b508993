"""Help, version and wrong usage."""

import json
import unittest
from pathlib import Path

from support import ProgramTest

VERBS = ["generate vem", "characterize", "shear", "calibrate", "fit power-law", "diagnose", "info", "import", "export"]


class Help(ProgramTest):
    def test_program_help_names_every_verb(self):
        text = self.succeed("--help")
        for verb in VERBS:
            self.assertIn(f"\n  {verb} ", text)

    def test_every_verb_explains_its_options_one_per_line(self):
        for verb in VERBS:
            text = self.succeed(*verb.split(), "--help")
            self.assertIn(f"usage: coagula {verb}", text)
            options = text.split("options:\n")[1].split("\n\n")[0].rstrip("\n").split("\n")
            for line in options:
                self.assertRegex(line, r"^  (-\w, |    )--[a-z-]+ .*\w")
            for common in ("--json", "--threads", "--quiet", "--help"):
                self.assertEqual(sum(common in line for line in options), 1, verb)

    def test_quantities_have_unit_default_and_range(self):
        line = next(line for line in self.succeed("shear", "--help").split("\n") if "--normal-stiffness" in line)
        self.assertIn("[unit N/m; default 100N/m; range 1e-12 .. 1e+15]", line)

    def test_the_manual_has_the_catalogue_of_causes(self):
        printed = self.succeed("diagnose", "--catalogue")
        manual = (Path(__file__).resolve().parents[2] / "docs" / "diagnosis.md").read_text()
        self.assertIn(printed, manual)
        causes = json.loads(self.succeed("diagnose", "--catalogue", "--json"))
        self.assertEqual(len(causes), len(printed.splitlines()) - 2)
        self.assertEqual(causes[0]["parameters"]["shear_over_normal"], {"low": 0.05, "high": 1, "unit": "1", "prior": "uniform in the logarithm"})

    def test_version(self):
        self.assertRegex(self.succeed("--version"), r"^coagula \d+\.\d+\.\d+ \(\S+\)\n$")


class WrongUsage(ProgramTest):
    def test_hint_to_help(self):
        calls = [
            ([], "verb"),
            (["fly"], "'fly'"),
            (["generate"], "generate vem"),
            (["generate", "snow"], "snow"),
            (["fit"], "fit power-law"),
            (["fit", "parabola", "a.csv"], "fit power-law"),
            (["fit", "power-law"], "TABLE.csv"),
            (["fit", "power-law", "a.csv", "b.csv"], "one TABLE.csv"),
            (["calibrate"], "FILE.h5"),
            (["shear", "a.h5", "--colour", "red"], "--colour"),
            (["shear", "a.h5", "--norm", "1"], "--norm"),  # no abbreviations
            (["shear", "a.h5", "b.h5"], "one FILE.h5"),
            (["shear"], "FILE.h5"),
            (["shear", "a.h5", "--solver", "magic"], "magic"),
            (["shear", "a.h5", "--normal-stiffness", "100m"], "--normal-stiffness"),
            (["shear", "a.h5", "--normal-stiffness", "0"], "--normal-stiffness"),
            (["shear", "a.h5", "--normal-stiffness", "nan"], "--normal-stiffness"),
            (["shear", "a.h5", "--normal-stiffness"], "--normal-stiffness"),
            (["shear", "a.h5", "--solver", "auto", "--solver", "direct"], "--solver"),
            (["characterize", "a.h5", "--only", "colour"], "'colour'"),
            (["characterize", "a.h5", "--radii", "3"], "--radii"),
            (["characterize", "a.h5", "--radii", "10.5"], "--radii"),
            (["characterize", "a.h5", "--threads", "0"], "--threads"),
            (["export", "a.h5"], "--format"),
            (["import", "a.csv"], "--output"),
        ]
        for words, part in calls:
            with self.subTest(words=words):
                self.fail_with(2, *words, says=part, may_say_nan="nan" in words)

    def test_errors_with_json_are_sentences_on_standard_error(self):
        self.fail_with(2, "info", "absent.h5", "--json", says="absent.h5")


if __name__ == "__main__":
    unittest.main()
