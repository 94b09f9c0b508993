# SPDX-License-Identifier: GPL-3.0-or-later
"""Names and texts that mean harm: no interpreter carries them out, no reader hangs, and one sentence says what is wrong."""

import csv
import io
import os
import resource
import shutil
import signal
import subprocess
import unittest
from xml.etree import ElementTree

from support import PACKING, PROGRAM, SMALL, VEM, ProgramTest

CURVE = ["generate", "brownian", "--potential-curve", "--radius", "0.25um", "--surface-potential", "15mV"]
HOSTILE = ["|touch broken; cat >.png", "a'.png", "a\nsystem('touch broken')\n.png", "`touch broken`.png", "$(touch broken).png",
           "<touch broken;.svg"]


@unittest.skipIf(shutil.which("gnuplot") is None, "needs gnuplot")
class Pictures(ProgramTest):
    def test_a_name_is_only_a_name(self):
        for name in HOSTILE:
            with self.subTest(name=name):
                self.succeed(*CURVE, "--picture", name)
                self.assertIn(name, os.listdir(self.folder))
                self.assertNotIn("broken", os.listdir(self.folder))

    def test_a_picture_is_never_replaced_unasked_nor_half_written(self):
        old = self.write("old.svg", "precious")
        self.fail_with(3, *CURVE, "--picture", "old.svg", says=["old.svg", "--force"])
        self.assertEqual(old.read_text(), "precious")
        self.succeed(*CURVE, "--picture", "old.svg", "--force")
        self.assertIn("<svg", old.read_text())

    def test_labels_are_only_text(self):
        packing = self.copy_of_measured()
        for label in ("`touch broken`", "'\nsystem('touch broken')\n'", '"; system("touch broken"); "', "@broken{_1}^2\\n&<b>", "`5"):
            with self.subTest(label=label):
                self.succeed("plot", packing, "--figure", "contacts", "--labels", label, "--force", "-o", "a.svg")
                shown = "".join(ElementTree.parse(self.folder / "a.svg").getroot().itertext())
                self.assertIn(" ".join(label.split("\n")), shown)
                self.assertNotIn("broken", os.listdir(self.folder))

    def test_figures_take_any_name_of_a_file(self):
        for name in ["`touch broken`.h5", "a'$(touch broken).h5", 'a"b.h5']:
            with self.subTest(name=name):
                packing = self.copy_of_measured(name)
                self.succeed("plot", packing, packing, "--figure", "pore-curve", "--force", "-o", name + ".svg")
                self.assertNotIn("broken", os.listdir(self.folder))


class Terminal(ProgramTest):
    def test_control_characters_are_not_shown(self):
        name = "a\x1b]0;owned\x07\nb\u009b2J.h5"
        complaint = self.fail_with(2, "info", name)
        self.copy_of_packing(name)
        for shown in (complaint, self.succeed("info", name), self.succeed("characterize", name, "--only", "overlap")):
            self.assertNotRegex(shown, "[\x00-\x09\x0b-\x1f\x7f-\x9f]")


class Spreadsheets(ProgramTest):
    def test_a_name_is_no_formula(self):
        names = ['=HYPERLINK("http:)', "+1+1.h5", "-2*3", "@SUM(1)", "\t=1", "plain.h5"]
        for name in names:
            self.copy_of_packing(name)
        printed = self.succeed("info", "--csv", *("./" + name for name in names))
        self.assertNotIn("'", printed)  # nothing begins with one of the characters
        os.mkdir(self.folder / "-1")
        self.copy_of_packing("-1/a.h5")
        rows = list(csv.reader(io.StringIO(self.succeed("info", "--csv", "--", *names, "-1/a.h5"))))
        self.assertEqual([row[0] for row in rows[1:]], ["'" + name for name in names[:5]] + ["plain.h5", "'-1/a.h5"])


class MissingData(ProgramTest):
    def test_the_units_database(self):
        self.copy_of_packing("a.h5")
        missing = {**os.environ, "UDUNITS2_XML_PATH": "/nowhere"}
        self.write("a.csv", "x [nm],y [nm],z [nm]\n1,2,3\n")
        for words in (["info", "a.h5"], ["import", "a.csv", "--radius", "1nm", "--box", "9nm", "-o", "b.h5"],
                      ["calibrate", "a.h5", "--measured", "1MPa"], ["shear", "a.h5", "--normal-stiffness", "1N/m"]):
            self.fail_with(1, *words, says="the units database of UDUNITS-2 cannot be read", env=missing)


class Limits(ProgramTest):
    """Little address space, few threads: a sentence or a result, and never a program that does not end."""

    def limited(self, megabytes, *words):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))

        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=60, preexec_fn=limit,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "8"})

    def test_linear_algebra_without_room(self):
        self.copy_of_packing("a.h5")
        for megabytes in (200, 300, 450):
            for words in (["shear", "a.h5", "--threads", "1"], ["shear", "a.h5", "--solver", "iterative"],
                          ["shear", "a.h5", "--frequency", "1Hz"], ["characterize", "a.h5", "--only", "rigidity"]):
                done = self.limited(megabytes, *words, "-o", f"{megabytes}.h5", "--force")
                self.assertIn(done.returncode, (0, 1), done.stderr)
                if done.returncode == 1:
                    self.check_sentence(done.stderr)

    def test_more_threads_than_there_can_be(self):
        self.succeed(*SMALL, "--threads", "4096", "-o", "a.h5")
        done = self.limited(1000, *SMALL, "--threads", "4096", "-o", "b.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.limited(1000, "shear", "b.h5", "--threads", "16")
        self.assertEqual(done.returncode, 0, done.stderr)


class Names(ProgramTest):
    def test_names_that_are_no_utf8(self):
        for words in (["info", b"\xff.h5", "--json"], ["characterize", b"\xff.h5"], [*VEM, "--json", "-o", b"\xe9.h5"]):
            with self.subTest(words=words):
                done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, timeout=60)
                self.assertEqual(done.returncode, 2)
                self.check_sentence(done.stderr.decode(), "not UTF-8")
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_name_that_is_too_long_is_noticed_before_the_work(self):
        words = ["generate", "vem", "--particles", "1000000", "--volume-fraction", "0.4", "--radius", "1um"]
        for length in (235, 260):
            self.fail_with(2, *words, "-o", "a" * length + ".h5", says="bytes")
            self.fail_with(2, "info", "a" * length + ".h5", says="a" * length)
        self.write("e.toml", '[[measurement]]\nkind = "amplitude-sweep"\nfile = "e.csv"\n')
        self.write("e.csv", "strain [1],storage modulus [Pa]\n1e-5,500\n1e-4,490\n1e-3,470\n1e-2,400\n1e-1,300\n")
        self.fail_with(2, "diagnose", "e.toml", "-o", "a" * 300, says="too long")
        self.succeed(*SMALL, "-o", "a" * 234 + ".h5")

    def test_what_is_no_regular_file_is_not_waited_for(self):
        os.mkfifo(self.folder / "pipe")
        radius = ["--radius", "1um", "-o", "out.h5"]
        for words in (["info", "pipe"], ["characterize", "pipe"], ["shear", "pipe"], ["export", "pipe", "--format", "csv"],
                      ["import", "pipe", "--format", "csv", *radius], ["import", "pipe", "--format", "extxyz", *radius],
                      ["import", "pipe", "--format", "lammps", *radius], ["fit", "power-law", "pipe"],
                      ["diagnose", "pipe", "--check"], ["shear", PACKING, "--model", "pipe", "-o", "out.h5"],
                      ["calibrate", "pipe"], [*VEM[:-2], "-o", "out.h5", "--size-distribution", "pipe"],
                      [*CURVE[:-2], "--potential-table", "pipe"],
                      ["generate", "brownian", "--start", "pipe", "--surface-potential", "0", "--stop-time", "1us", "-o", "out.h5"]):
            with self.subTest(words=words):
                done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=10)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.check_sentence(done.stderr, "not a regular file")
                self.assertEqual(os.listdir(self.folder), ["pipe"])


class Nesting(ProgramTest):
    def test_toml(self):
        dotted = "a" + ".a" * 50000 + " = 1\n"
        for text in (dotted, f"[{dotted[:-5]}]\n", "a = " + "[" * 50000 + "]" * 50000 + "\n",
                     "a = " + "{a = " * 50000 + "1" + "}" * 50000 + "\n", "a = " + "{a.a.a = [" * 5000 + "\n"):
            self.write("deep.toml", "# [[[[ '''\ntitle = \"a.b.c [\"\n" + text)
            self.fail_with(2, "shear", PACKING, "--model", "deep.toml", "-o", "out.h5", says=["deep.toml, line 3", "nested deeper"])
            self.fail_with(2, "diagnose", "check", "deep.toml", says=["deep.toml, line 3", "nested deeper"])

    def test_texts_and_numbers_are_no_levels(self):
        self.write("flat.toml", "normal_stiffness = '100.0 N/m' # " + "[" * 100 + "\nfriction = 0.5 # '''\n" +
                   "shear_stiffness = \"\"\"" + "10.0 N/m" + "\"\"\"\n" + "# .\n" * 100)
        self.succeed("shear", PACKING, "--model", "flat.toml", "-o", "out.h5")

    def test_json_of_the_provenance(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("needs python3-h5py")
        for options in ("[" * 200000 + "]" * 200000, "[" * 200000, '{"a": ' * 200000 + "1" + "}" * 200000):
            self.copy_of_packing()
            with h5py.File(self.folder / "packing.h5", "r+") as file:
                (entry,) = file["provenance"].values()
                del entry["options"]
                entry["options"] = options
            self.fail_with(2, "info", "packing.h5", "--json", says=["packing.h5", "nested deeper"])


class StandardOutput(ProgramTest):
    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_a_full_disk_is_an_error(self):
        self.copy_of_packing()
        for words in (["--help"], ["--version"], ["shear", "--help"], ["info", "packing.h5"], ["info", "packing.h5", "--json"],
                      [*SMALL, "-o", "out.h5"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, words)
            self.check_sentence(done.stderr, "standard output cannot be written")


class PowerLaw(ProgramTest):
    def refuse(self, rows, says):
        self.write("table.csv", "a,modulus [Pa]\n" + rows)
        done = subprocess.run([PROGRAM, "fit", "power-law", "table.csv"], cwd=self.folder, capture_output=True, text=True, timeout=10)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.check_sentence(done.stderr, ["table.csv", says])

    def test_values_beyond_all_bounds_are_refused_at_once(self):
        self.refuse("0.3,1\n0.4,2\n0.5,3\n1e23,4\n", "degree of heterogeneity of structure 4 is 1e+23")
        self.refuse("0.3,1\n0.4,2\n0.5,3\n1e308,4\n", "degree of heterogeneity of structure 4 is 1e+308")
        self.refuse("0.3,1e308\n0.4,1e308\n0.5,1.5e308\n0.6,1.6e308\n", "modulus of structure 1 is 1e+308")
        self.refuse("0.3,1e-320\n0.4,2\n0.5,3\n0.6,4\n", "modulus of structure 1")
        self.refuse("0.3,1\n0.30000000000000004,2\n500000,3\n0.6,4\n", "the same within rounding")

    def test_wide_tables_are_fitted(self):
        self.write("table.csv", "a,modulus [Pa]\n-1e6,1e-60\n0.3,2\n0.4,3\n1e6,1e60\n")
        self.succeed("fit", "power-law", "table.csv", "--json")

    def test_a_long_fit_can_be_stopped(self):
        rows = "".join(f"{0.3 + 1e-4 * k},{1 + k * k}\n" for k in range(3000))
        self.write("table.csv", "a,modulus [Pa]\n" + rows)
        process = subprocess.Popen([PROGRAM, "fit", "power-law", "table.csv", "--points", "10000"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(timeout=2)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=20)
        self.assertEqual((process.returncode, output), (1, ""), errors)
        self.check_sentence(errors, "interrupted")


if __name__ == "__main__":
    unittest.main()
