# SPDX-License-Identifier: GPL-3.0-or-later
"""Help, version and wrong usage."""

import json
import unittest

from support import ProgramTest, VEM

VERBS = ["generate vem", "characterize", "shear", "calibrate", "fit power-law", "diagnose", "diagnose new", "diagnose check", "diagnose plan",
         "diagnose catalogue", "dataset plan", "dataset run", "dataset table", "dataset verify", "dataset join", "dataset workflow", "plot",
         "report", "info", "import", "export", "completion", "man"]


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

    def test_the_catalogue_of_causes_is_one_table_and_list(self):
        printed = self.succeed("diagnose", "catalogue")
        self.assertTrue(printed.startswith("| cause | what it changes | how it shows | parameters and their range |\n|---|---|---|---|\n"))
        causes = json.loads(self.succeed("diagnose", "catalogue", "--json"))
        self.assertEqual(len(causes), len(printed.splitlines()) - 2)
        self.assertEqual(causes[0]["parameters"]["shear_over_normal"], {"low": 0.05, "high": 1, "unit": "1", "prior": "uniform in the logarithm"})

    def test_version(self):
        self.assertRegex(self.succeed("--version"), r"^coagula \d+\.\d+\.\d+ \(\S+\)\n$")
        self.assertEqual(self.succeed("-V"), self.succeed("--version"))


class Writing(ProgramTest):
    """Numbers as people write them."""

    CURVE = ["generate", "brownian", "--potential-curve", "--radius", "0.25um", "--surface-potential", "15mV"]

    def test_whole_numbers_with_an_exponent(self):
        wanted = self.succeed_json(*VEM, "-o", "a.h5")
        words = ["5e2" if word == "500" else "2.5e2" if word == "250" else word for word in VEM]
        self.assertEqual(self.succeed_json(*words, "-o", "b.h5")["coordination"], wanted["coordination"])
        for wrong in ("1.5", "1e-1", "1e300", "1e", "e6", "1e6x", "1e3 um"):
            self.fail_with(2, "characterize", "a.h5", "--radii", wrong, says="is not a whole number")

    def test_blank_between_number_and_unit(self):
        wanted = self.succeed_json(*self.CURVE, "--ionic-strength", "10")
        for words in (["10mM"], ["10 mM"], ["10", "mM"], ["0.01", "mol/l"], ["1e-2", "M"]):
            self.assertEqual(self.succeed_json(*self.CURVE, "--ionic-strength", *words), wanted)
        self.fail_with(2, *self.CURVE, "--ionic-strength", "10", "mV", says="takes no argument")

    def test_a_file_is_no_unit(self):
        self.copy_of_packing("m")
        self.succeed("shear", "--bond-tolerance", "0.01", "m", "-o", "b.h5")
        self.succeed("shear", "--normal-stiffness", "100", "N/m", "m", "-o", "c.h5")
        self.fail_with(2, "shear", "--normal-stiffness", "100", "N/s", "m", says="N/s does not exist")


class OldNames(ProgramTest):
    """What had another name in an earlier version works under both, and the old one is said to be old."""

    def both(self, old, new, note):
        done = self.run_program(*old)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_sentence(done.stderr, note)
        again = self.run_program(*new)
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertEqual(done.stdout, again.stdout)

    def test_of_an_option(self):
        words = ["characterize", self.copy_of_packing(), "--only", "coordination", "--position-noise", "1nm", "--json"]
        note = "--noise-replicas is called --realizations now; the old name works until version 2"
        done = [self.run_program(*words, name, "2", "-o", f"{name}.h5") for name in ("--noise-replicas", "--realizations")]
        self.assertEqual([each.returncode for each in done], [0, 0], done)
        self.check_sentence(done[0].stderr, note)
        self.assertEqual(done[1].stderr, "")
        noises = [json.loads(each.stdout)["noise"] for each in done]
        self.assertEqual(*noises)

    def test_with_an_equals_sign(self):
        done = self.run_program("generate", "brownian", "--tangential-stiffness=1", "--friction", "2km")
        self.assertIn("friction", done.stderr)
        self.assertNotIn("no option", done.stderr)

    def test_with_a_unit_of_its_own(self):
        done = self.run_program("generate", "brownian", "--tangential-stiffness", "1", "mN/m", "--friction", "2km")
        self.assertIn("friction", done.stderr)
        self.assertNotIn("argument", done.stderr)

    def test_old_and_new_name_together(self):
        self.fail_with(2, "characterize", self.copy_of_packing(), "--position-noise", "1nm", "--noise-replicas", "2", "--realizations", "3",
                       says="--noise-replicas is the old name of --realizations: give one of them")

    def test_of_a_verb(self):
        self.both(["diagnose", "--catalogue"], ["diagnose", "catalogue"],
                  "'diagnose --catalogue' is called 'diagnose catalogue' now; the old spelling works until version 2")

    def test_a_call_that_fails_says_one_sentence(self):
        self.fail_with(2, "diagnose", "absent.toml", "--check", says="absent.toml")
        self.fail_with(2, "characterize", "absent.h5", "--position-noise", "1nm", "--noise-replicas", "2", says="absent.h5")

    def test_help_shows_the_new_names_only(self):
        text = self.succeed("shear", "--help")
        self.assertIn("--reverse", text)
        self.assertNotIn("--down", text)

    def test_in_a_sweep(self):
        self.write("sweep.toml", """[[generate]]
verb = "vem"
particles = 60
volume-fraction = 0.4
radius = "0.25um"
[shear]
method = "quasistatic"
amplitudes = "1e-5"
orientation = "zx"
down = [true, false]
""")
        self.assertEqual(self.succeed_json("dataset", "plan", "sweep.toml")["structures"], 2)
        with (self.folder / "sweep.toml").open("a") as sweep:
            sweep.write("reverse = true\n")
        self.fail_with(2, "dataset", "plan", "sweep.toml", says=["sweep.toml", "reverse", "down is the old name of reverse"])


class WrongUsage(ProgramTest):
    def test_hint_to_help(self):
        calls = [
            ([], "verb"),
            (["fly"], "'fly'"),
            (["shaer", "a.h5"], "did you mean 'shear'?"),
            (["Info", "a.h5"], "did you mean 'info'?"),
            (["generate", "vme"], "did you mean 'generate vem'?"),
            (["genrate", "vem"], "did you mean 'generate vem'?"),
            (["fit", "powerlaw", "a.csv"], "fit power-law"),
            (["shear", "a.h5", "--normal-stifness", "1"], "did you mean '--normal-stiffness'?"),
            (["shear", "a.h5", "--bond_tolerance", "1"], "did you mean '--bond-tolerance'?"),
            (["shear", "a.h5", "--solver", "drect"], "did you mean 'direct'?"),
            (["characterize", "a.h5", "--only", "overlapp"], "did you mean 'overlap'?"),
            (["generate"], "generate vem"),
            (["generate", "snow"], "snow"),
            (["fit"], "fit power-law"),
            (["fit", "parabola", "a.csv"], "fit power-law"),
            (["fit", "power-law"], "TABLE.csv"),
            (["fit", "power-law", "a.csv", "b.csv"], "one TABLE.csv"),
            (["calibrate"], "FILE.h5"),
            (["shear", "a.h5", "--colour", "red"], "--colour"),
            (["shear", "a.h5", "--norm", "1"], "'--norm'; did you mean '--normal-stiffness'?"),  # no abbreviations
            (["characterize", "a.h5", "b.h5"], "one FILE.h5"),
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

    def test_options_that_nobody_reads(self):
        """Each call lacks what would make the program read the option; the sentence names it."""
        self.copy_of_packing("a.h5")
        self.write("model.toml", 'normal_stiffness = "50 N/m"\n')
        self.write("sizes.csv", "radius [um],fraction\n1,1\n2,1\n")
        shear, brownian = ["shear", "a.h5"], ["generate", "brownian", "-o", "b.h5", "--stop-time", "1us", "--surface-potential", "15mV"]
        suspension = [*brownian, "--particles", "50", "--volume-fraction", "0.2", "--radius", "100nm"]
        calls = [
            ([*shear, "--damping", "0.5"], "--damping is read only with --method dem"),
            ([*shear, "--method", "quasistatic", "--amplitude", "0.01"], "--amplitude is read only with --method dem"),
            ([*shear, "--orientation", "xy"], "--orientation is read only with --method quasistatic or dem"),
            ([*shear, "--checkpoint", "c.h5"], "--checkpoint is read only with --method quasistatic or dem"),
            ([*shear, "--amplitudes", "1e-4"], "--amplitudes is read only with --method quasistatic"),
            ([*shear, "--method", "quasistatic", "--reverse"], "--reverse is read only with --amplitudes"),
            ([*shear, "--method", "quasistatic", "--ramp-steps", "7"], "--ramp-steps is read only with --ramp"),
            ([*shear, "--method", "quasistatic", "--ramp", "0.1", "--frequency", "1Hz"], "only with --amplitudes"),
            ([*shear, "--method", "quasistatic", "--amplitudes", "1e-4", "--frequency", "1Hz,2Hz"], "at one frequency"),
            ([*shear, "--method", "dem", "--solver", "direct"], "--solver is read only with --method linear"),
            ([*shear, "--frequency", "1Hz", "--solver", "direct"], "--solver is not read with --frequency"),
            ([*shear, "--solver", "iterative", "--memory-limit", "1GB"], "--memory-limit is read only with --solver auto"),
            ([*shear, "--solver", "direct", "--modulus-tolerance", "1e-6"], "only with --solver auto or iterative"),
            ([*shear, "--model", "model.toml", "--normal-stiffness", "70N/m"], "in one of the two places"),
            (["calibrate", "a.h5", "--boundary", "periodic"], "--boundary is read only with --method dem"),
            (["characterize", "a.h5", "--realizations", "3"], "--realizations is read only with --position-noise"),
            (["characterize", "a.h5", "--voxels-per-radius", "2"], "--voxels-per-radius is read by the measure transport"),
            (["characterize", "a.h5", "--only", "overlap", "--chord-lines", "9"], "--chord-lines is read by the measure chord_lengths"),
            (["characterize", "a.h5", "a.h5", "--compare", "--largest-ring", "5"], "--largest-ring is read by the measure rings"),
            (["generate", "vem", "-o", "b.h5", "--volume-fraction", "0.4", "--radius", "1um", "--size-distribution", "sizes.csv"],
             "--radius is not read with --size-distribution"),
            ([*brownian, "--start", "a.h5", "--particles", "9"], "--particles is not read with --start"),
            ([*brownian, "--start", "a.h5", "--equilibration-time", "1us"], "--equilibration-time is not read with --start"),
            ([*suspension, "--friction", "0.5"], "--friction is read only with --contact-shear-stiffness"),
            ([*suspension, "--density-difference", "100"], "--density-difference is read only with --gravity"),
            ([*suspension, "--plateau-time", "1us"], "--plateau-time is read only with --stop-plateau coordination or mean-gap"),
            ([*suspension, "--checkpoint-interval", "1s"], "--checkpoint-interval is read only with --checkpoint"),
            ([*suspension, "--picture", "p.svg"], "--picture is read only with --potential-curve"),
            ([*suspension, "--potential-curve"], "is not read with --potential-curve"),
            (["plot", "a.h5", "--figure", "packing", "-o", "p.svg", "--format", "png"], "--format is read only with --paper"),
            (["plot", "a.h5", "--figure", "packing", "-o", "p.svg", "--resolution", "100"], "--resolution is read for a PNG only"),
            (["diagnose", "e.toml", "--new", "--significance", "0.1"], "--significance is not read with --new"),
            (["diagnose", "plan", "e.toml", "--bootstrap", "999"], "--bootstrap is at most 199 in a plan"),
            (["diagnose", "e.toml", "--check", "--seed", "2"], "--seed is not read with --check"),
            (["diagnose", "--catalogue", "--causes", "ageing"], "--causes is not read with --catalogue"),
        ]
        for words, part in calls:
            with self.subTest(words=words):
                self.fail_with(2, *words, says=part)

    def test_options_beside_what_reads_them(self):
        self.copy_of_packing("a.h5")
        self.write("model.toml", 'normal_stiffness = "50 N/m"\n')
        for words in (["shear", "a.h5", "--solver", "iterative", "--modulus-tolerance", "1e-3", "-o", "b.h5"],
                      ["shear", "a.h5", "--frequency", "1Hz", "--tolerance", "1e-6", "-o", "c.h5"],
                      ["shear", "a.h5", "--model", "model.toml", "--normal-stiffness", "50N/m", "-o", "d.h5"],
                      ["characterize", "a.h5", "--only", "rings", "--largest-ring", "5", "-o", "e.h5"],
                      ["characterize", "a.h5", "--only", "overlap", "--samples", "1000", "-o", "f.h5"]):
            self.succeed(*words)

    def test_misspelt_keys(self):
        self.copy_of_packing("a.h5")
        self.write("model.toml", "normal_stifness = 1\n")
        self.fail_with(2, "shear", "a.h5", "--model", "model.toml", says="did you mean 'normal_stiffness'?")
        for text, says in (("[sampel]\n", "did you mean 'sample'?"), ('[sample]\nparticle_radus = "1um"\n', "did you mean 'particle_radius'?"),
                           ('[[measurment]]\nkind = "amplitude-sweep"\n', "did you mean 'measurement'?")):
            self.write("experiment.toml", text)
            self.fail_with(2, "diagnose", "check", "experiment.toml", says=says)

    def test_errors_with_json_are_sentences_on_standard_error(self):
        self.fail_with(2, "info", "absent.h5", "--json", says="absent.h5")


if __name__ == "__main__":
    unittest.main()
