# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs are checked before the work, written whole or not at all, and never replaced unasked."""

import csv
import io
import os
import resource
import shutil
import subprocess
import unittest

import h5py

from support import PROGRAM, SMALL, VEM, ProgramTest, checksum


def small_files_only():
    """The program may write files of at most 8 kB: as good as a full disk."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))


class Outputs(ProgramTest):
    def test_existing_output_needs_force(self):
        source = self.copy_of_packing()
        target = self.write("old.h5", "precious")
        before = checksum(target)
        for words in (VEM, ["characterize", source], ["shear", source], ["export", source, "--format", "csv"]):
            self.fail_with(3, *words, "-o", "old.h5", says=["old.h5", "--force"])
            self.assertEqual(checksum(target), before)
        self.succeed("characterize", source, "--only", "coordination", "-o", "old.h5", "--force")
        self.assertNotEqual(checksum(target), before)

    def test_output_that_cannot_be(self):
        source = self.copy_of_packing()
        (self.folder / "folder").mkdir()
        for output in ("absent/out.h5", "folder", ""):
            for words in (VEM, ["characterize", source], ["shear", source]):
                self.fail_with(2, *words, "-o", output)

    def test_wrong_output_is_noticed_before_the_work(self):
        # A packing of this size takes minutes; the time limit of the call is shorter.
        words = ["generate", "vem", "--particles", "1000000", "--volume-fraction", "0.4", "--radius", "1um"]
        self.fail_with(2, *words, "-o", "absent/out.h5", says="absent")

    def test_folder_without_permission(self):
        (self.folder / "closed").mkdir(mode=0o555)
        self.folder.chmod(0o755)
        program = shutil.copy(PROGRAM, self.folder)
        somebody = {"user": 65534} if os.geteuid() == 0 else {}  # root may write everywhere
        done = subprocess.run([program, *VEM, "-o", "closed/out.h5"], cwd=self.folder, capture_output=True, text=True, **somebody)
        self.assertEqual(done.returncode, 2)
        self.check_sentence(done.stderr, says="permission")
        self.assertEqual(os.listdir(self.folder / "closed"), [])

    def test_results_go_to_a_new_file_when_asked(self):
        source = self.copy_of_packing()
        before = checksum(source)
        self.succeed("characterize", source, "-o", "new.h5")
        self.assertEqual(checksum(source), before)
        self.assertIn("/characterization/doh/a", self.succeed_json("info", "new.h5")["results"])

    def test_export_beside_the_input(self):
        self.copy_of_packing("a.h5")
        self.succeed("export", "a.h5", "--format", "lammps")
        self.fail_with(3, "export", "a.h5", "--format", "lammps", says=["a.data", "--force"])
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.data", "a.h5"])


    def test_protected_file_is_not_replaced(self):
        source = self.copy_of_packing()
        target = self.write("old.csv", "precious")
        for path in (source, target):
            path.chmod(0o444)
            before = checksum(path)
            for words in (["characterize", "packing.h5"], ["shear", "packing.h5"]) if path == source else (
                    ["export", "packing.h5", "-o", "old.csv", "--force"], [*VEM, "-o", "old.csv", "--force"]):
                self.fail_with(2, *words, says=[path.name, "protected against writing"])
                self.assertEqual(checksum(path), before)

    def test_folders_in_which_nothing_can_be_made(self):
        """With the first signal still free to act: no loop hides it, and none is needed."""
        source = self.copy_of_packing()
        for output in ("/proc/x.h5", "/proc/self/x.h5", "/dev/fd/x.h5"):
            self.fail_with(2, "characterize", source, "-o", output, says=[output, "no file can be made"])
        (self.folder / "gone").mkdir()
        for name in ("x.h5", "./x.h5"):
            words = ["sh", "-c", 'cd gone && mkdir in && cd in && rmdir ../in && exec "$0" "$@"', PROGRAM, "characterize", str(source), "-o", name]
            done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=30)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.check_sentence(done.stderr, says=[name, "no file can be made"])


class ClosedDescriptors(ProgramTest):
    """Whoever starts the program may have closed its standard streams."""

    def run_without(self, closed, *words):
        return subprocess.run(["sh", "-c", f'exec "$0" "$@" {closed}', PROGRAM, *map(str, words)], cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=100).returncode

    def test_results_are_whole(self):
        for closed in ("2>&-", "<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
            with self.subTest(closed=closed):
                self.copy_of_packing()
                self.assertEqual(self.run_without(closed, "characterize", "packing.h5", "--only", "coordination", "--quiet"), 0)
                self.assertEqual(self.run_without(closed, "shear", "packing.h5", "--quiet"), 0)
                self.assertEqual(self.run_without(closed, "export", "packing.h5", "-o", "packing.csv", "--force", "--quiet"), 0)
                found = self.succeed_json("info", "packing.h5")["results"]
                self.assertIn("/characterization/coordination", found)
                self.assertIn("/mechanics/linear/storage_modulus/mean", found)
                self.assertEqual(len((self.folder / "packing.csv").read_text().splitlines()), 501)

    def test_what_cannot_be_printed_is_an_error(self):
        self.copy_of_packing()
        self.assertEqual(self.run_without(">&-", "info", "packing.h5"), 1)
        self.assertEqual(self.run_without(">&- 2>&-", "info", "packing.h5", "--json"), 1)


class InputsAreKept(ProgramTest):
    """An output that is an input of the call is refused, whatever its name."""

    def refuse(self, name, *words):
        path = self.folder / name
        before = path.read_bytes()
        self.fail_with(2, *words, says=["cannot write", "this call reads"])
        self.assertEqual(path.read_bytes(), before)

    def test_each_verb(self):
        self.copy_of_packing("a.h5")
        self.write("c.csv", "x [um],y [um],z [um]\n1,1,1\n2.1,1,1\n")
        self.write("m.toml", "normal_stiffness = 100\n")
        self.write("t.csv", "a,modulus [Pa]\n" + "".join(f"{0.5 + 0.05 * k},{1e5 * (0.2 + 0.05 * k) ** 1.5}\n" for k in range(8)))
        self.write("f.csv", "frequency [Hz],storage_modulus [Pa],loss_modulus [Pa]\n1,1e5,2e4\n3,1.1e5,2e4\n")
        for name, words in (("a.h5", ["report", "a.h5", "-o", "a.h5"]), ("a.h5", ["export", "a.h5", "--format", "csv", "-o", "a.h5"]),
                            ("a.h5", ["calibrate", "a.h5", "-o", "a.h5"]),
                            ("a.h5", ["plot", "a.h5", "--figure", "packing", "-o", "f.svg", "--data", "a.h5"]),
                            ("a.h5", ["shear", "a.h5", "-o", "a.h5"]), ("a.h5", ["characterize", "a.h5", "-o", "./a.h5"]),
                            ("t.csv", ["fit", "power-law", "t.csv", "-o", "t.csv"]),
                            ("c.csv", ["import", "c.csv", "--radius", "0.5um", "--open", "-o", "c.csv"]),
                            ("m.toml", ["shear", "a.h5", "--model", "m.toml", "-o", "m.toml"]),
                            ("f.csv", ["diagnose", "new", "f.csv", "-o", "f.csv"]),
                            ("a.h5", ["generate", "brownian", "--start", "a.h5", "--surface-potential", "0mV", "--stop-time", "1us", "-o", "a.h5"])):
            with self.subTest(words=words):
                self.refuse(name, *words, "--force")

    def test_other_names_of_the_file(self):
        self.copy_of_packing("a.h5")
        (self.folder / "folder").mkdir()
        (self.folder / "link.h5").symlink_to("a.h5")
        os.link(self.folder / "a.h5", self.folder / "hard.h5")
        for name in ("link.h5", "hard.h5", "folder/../a.h5", str(self.folder / "a.h5")):
            with self.subTest(name=name):
                self.refuse("a.h5", "report", "a.h5", "-o", name, "--force")
                self.refuse("a.h5", "export", name, "--format", "csv", "-o", "a.h5", "--force")

    def test_a_name_that_the_program_chooses(self):
        self.copy_of_packing("a.csv")  # a file of results, whatever its name says
        self.refuse("a.csv", "export", "a.csv", "--format", "csv", "--force")

    def test_files_in_a_folder(self):
        self.copy_of_packing("packing.h5")
        (self.folder / "tables").mkdir()
        table = "a,modulus [Pa]\n" + "".join(f"{0.5 + 0.05 * k},{1e5 * (0.2 + 0.05 * k) ** 1.5}\n" for k in range(8))
        (self.folder / "tables" / "figure1.csv").write_text(table)
        self.refuse("tables/figure1.csv", "plot", "tables", "--figure", "packing", "-o", "f.svg", "--data", "tables/figure1.csv", "--force")
        self.refuse("tables/figure1.csv", "plot", "tables", "--paper", "-o", "tables", "--force")
        sweep = "frequency [Hz],storage_modulus [Pa],loss_modulus [Pa]\n" + "".join(f"{k},{1e5 + 20 * k},{2e4 + 10 * k}\n" for k in range(1, 8))
        (self.folder / "tables" / "report.html").write_text(sweep)
        self.write("experiment.toml", '[sample]\nparticle_radius = "0.25 um"\n[structures]\nfiles = ["packing.h5"]\n'
                                      '[[measurement]]\nkind = "frequency-sweep"\nfile = "tables/report.html"\nsample = "a"\n')
        self.refuse("tables/report.html", "diagnose", "experiment.toml", "-o", "tables", "--force")

    def test_two_outputs_of_one_name(self):
        self.copy_of_packing("a.h5")
        (self.folder / "here").symlink_to(".")
        brownian = ["generate", "brownian", "--particles", "60", "--volume-fraction", "0.3", "--radius", "0.25um", "--surface-potential", "0mV",
                    "--stop-time", "1us"]
        for words in ([*brownian, "-o", "x.h5", "--checkpoint", "x.h5"], [*brownian, "-o", "./x.h5", "--checkpoint", "here/x.h5"],
                      ["shear", "a.h5", "--method", "quasistatic", "-o", "x.h5", "--checkpoint", "x.h5"],
                      ["plot", "a.h5", "--figure", "packing", "-o", "x.svg", "--data", "x.svg"]):
            with self.subTest(words=words):
                self.fail_with(2, *words, says=["cannot write", "two outputs of this call"])


class MeasuresAreKept(ProgramTest):
    """A characterization in place replaces what it measures and keeps the rest."""

    def results(self):
        return self.succeed_json("info", "measured.h5")["results"]

    def test_only_what_is_measured_is_replaced(self):
        self.copy_of_measured()
        before = self.results()
        self.succeed("characterize", "measured.h5", "--only", "coordination", "--contact-tolerance", "0.05")
        after = self.results()
        self.assertEqual(after.keys(), before.keys())
        changed = {path for path in before if before[path] != after[path]}
        self.assertIn("/characterization/contact_tolerance", changed)
        self.assertIn("/characterization/coordination", changed)
        self.assertFalse({path for path in changed if path.count("/") > 2 and "/uncertainty/" not in path}, changed)

    def test_nothing_of_the_older_measure_is_left(self):
        self.copy_of_measured()
        self.succeed("characterize", "measured.h5", "--only", "rings,overlap", "--position-noise", "5nm", "--realizations", "2")
        noisy = self.results()
        self.assertIn("/characterization/noise/shift/overlap/mean", noisy)
        self.succeed("characterize", "measured.h5", "--only", "overlap")
        after = self.results()
        gone = noisy.keys() - after.keys()
        self.assertIn("/characterization/noise/shift/overlap/mean", gone)
        self.assertTrue(all("/noise/shift" in path for path in gone), gone)

    def test_a_default_run_keeps_what_it_does_not_measure(self):
        self.copy_of_packing("measured.h5")
        self.succeed("characterize", "measured.h5", "--only", "rigidity")
        more = self.results()
        self.succeed("characterize", "measured.h5")
        after = self.results()
        self.assertLess(more.keys(), after.keys())


class ListsOfBonds(ProgramTest):
    def test_results_keep_the_bonds_they_were_found_with(self):
        self.copy_of_packing()
        linear = self.succeed_json("shear", "packing.h5")["contacts"]
        before = self.succeed_json("info", "packing.h5")
        self.assertEqual((before["bonds"], before["own_bonds"]), (linear, {}))
        self.succeed("shear", "packing.h5", "--frequency", "1Hz", "--bond-tolerance", "0.05")
        after = self.succeed_json("info", "packing.h5")
        self.assertGreater(after["bonds"], linear)
        self.assertEqual(after["own_bonds"], {"/mechanics/linear": linear})
        own = after["results"]["/mechanics/linear/connectivity/bonds"]
        self.assertEqual(own.get("shape", [len(own["value"] or [])])[0], linear)
        self.assertIn("/mechanics/linear/connectivity/branch_vectors", after["results"])
        self.assertEqual(after["results"]["/mechanics/linear/storage_modulus/mean"],
                         before["results"]["/mechanics/linear/storage_modulus/mean"])
        self.assertRegex(self.succeed("info", "packing.h5"), rf"/mechanics/linear +found with {linear} other bonds")
        # The same list once more: nothing changes its list. The linear result made anew: it has that of /connectivity again.
        self.succeed("shear", "packing.h5", "--frequency", "2Hz", "--bond-tolerance", "0.05", "--force")
        self.assertEqual(self.succeed_json("info", "packing.h5")["own_bonds"], {"/mechanics/linear": linear})
        self.succeed("shear", "packing.h5", "--bond-tolerance", "0.05", "--force")
        self.assertEqual(self.succeed_json("info", "packing.h5")["own_bonds"], {})


class Conditions(ProgramTest):
    """A shear replaces results of the same method without a word only if it is the same measurement again."""

    METHODS = {"linear": (["--bond-tolerance", "0.02"], ["--normal-stiffness", "150N/m"], ["--relax", "minimise"]),
               "frequency": (["--frequency", "1Hz"], ["--frequency", "2Hz"], ["--frequency-sweep", "1Hz:10Hz:2"]),
               "quasistatic": (["--orientation", "zx"], ["--orientation", "zx", "--steps-per-cycle", "4", "--amplitudes", "1e-4"],
                               ["--orientation", "zx", "--ramp-steps", "1", "--ramp", "1e-5"]),
               "dem": (["--orientation", "zx"], ["--orientation", "zx", "--amplitude", "0.002"], ["--orientation", "xy"])}
    QUICK = ["--boundary", "periodic", "--oscillations", "1", "--steps-per-oscillation", "100"]

    def setUp(self):
        super().setUp()
        self.succeed(*SMALL, "-o", "a.h5")

    def shear(self, method, words):
        return ["shear", "a.h5", "--quiet", *words, *([] if method == "frequency" else ["--method", method]),
                *(self.QUICK if method == "dem" else [])]

    def other_conditions_need_force(self, method):
        first, *others = self.METHODS[method]
        self.succeed(*self.shear(method, first))
        self.succeed(*self.shear(method, first))  # the same again
        before = checksum(self.folder / "a.h5")
        for words in others:
            call = self.shear(method, words)
            option = words[-2][2:].replace("-", "_")
            self.fail_with(3, *call, says=["a.h5", f"/mechanics/{method}", option, "--force", "-o"])
            self.assertEqual(checksum(self.folder / "a.h5"), before)
        self.succeed(*call, "-o", "copy.h5")
        self.assertEqual(checksum(self.folder / "a.h5"), before)
        self.succeed(*call, "--force")
        self.succeed(*call)

    def test_other_conditions_need_force_linear(self):
        self.other_conditions_need_force("linear")

    def test_other_conditions_need_force_frequency(self):
        self.other_conditions_need_force("frequency")

    def test_other_conditions_need_force_quasistatic(self):
        self.other_conditions_need_force("quasistatic")

    def test_other_conditions_need_force_dem(self):
        self.other_conditions_need_force("dem")

    def test_how_it_is_computed_is_no_condition(self):
        self.succeed(*self.shear("linear", []))
        self.succeed(*self.shear("linear", ["--solver", "direct", "--tolerance", "1e-9", "--threads", "1"]))

    def test_the_contents_of_a_model_count_and_not_its_name(self):
        for name, stiffness in (("a.toml", 120), ("b.toml", 120), ("c.toml", 130)):
            self.write(name, f'normal_stiffness = "{stiffness} N/m"\n')
        self.succeed(*self.shear("linear", ["--model", "a.toml"]))
        self.succeed(*self.shear("linear", ["--model", "b.toml"]))
        self.fail_with(3, *self.shear("linear", ["--model", "c.toml"]), says="model differs")

    def test_all_files_are_asked_before_one_is_sheared(self):
        self.succeed(*SMALL, "--seed", "2", "-o", "b.h5")
        self.succeed(*self.shear("linear", []))
        before = [checksum(self.folder / name) for name in ("a.h5", "b.h5")]
        self.fail_with(3, "shear", "b.h5", "a.h5", "--bond-tolerance", "0.02", says="a.h5 holds results")
        self.assertEqual([checksum(self.folder / name) for name in ("a.h5", "b.h5")], before)

    def test_results_without_conditions_are_not_taken_for_the_same(self):
        """Earlier versions wrote none."""
        call = self.shear("linear", [])
        self.succeed(*call)
        with h5py.File(self.folder / "a.h5", "r+") as file:
            del file["mechanics/linear/conditions"]
        self.fail_with(3, *call, says="which it does not name")
        self.succeed(*call, "--force")

    def test_info_and_json_show_them(self):
        found = self.succeed_json(*(word for word in self.shear("quasistatic", self.METHODS["quasistatic"][1]) if word != "--quiet"))
        self.assertEqual((found["conditions"]["amplitudes"], found["conditions"]["bond_tolerance"]), ("1e-04", 0.01))
        self.assertRegex(self.succeed("info", "a.h5"), r"/mechanics/quasistatic/conditions/amplitudes +1e-04 ")
        row = next(csv.DictReader(io.StringIO(self.succeed("info", "a.h5", "--csv"))))
        self.assertEqual(row["mechanics/quasistatic/conditions/amplitudes"], "1e-04")

    def test_another_spelling_is_the_same_condition(self):
        for amplitude in ("1e-4", "0.0001", "1e-2%"):
            words = ["--amplitudes", amplitude, "--steps-per-cycle", "4", "--orientation", "zx"]
            self.succeed(*self.shear("quasistatic", words))

    def test_who_comes_second_does_not_replace_the_first(self):
        """Both begin when the file has no results."""
        words = [["--amplitudes", amplitude, "--steps-per-cycle", "4", "--orientation", "zx"] for amplitude in ("1e-4", "1e-3")]
        runs = [subprocess.Popen([PROGRAM, *self.shear("quasistatic", one)], cwd=self.folder, stderr=subprocess.PIPE, text=True)
                for one in words]
        told = "".join(run.communicate()[1] for run in runs)
        self.assertEqual(sorted(run.returncode for run in runs), [0, 3], told)
        self.check_sentence(told, says=["amplitudes", "--force"])


class SeveralWriters(ProgramTest):
    def start(self, *words):
        return subprocess.Popen([PROGRAM, *map(str, words), "--quiet"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def test_both_results_are_kept(self):
        for _ in range(5):
            self.copy_of_packing()
            runs = [self.start("characterize", "packing.h5", "--only", "coordination"), self.start("shear", "packing.h5")]
            for run in runs:
                self.assertEqual(run.wait(), 0, run.stderr.read())
                run.stderr.close()
            found = self.succeed_json("info", "packing.h5")
            self.assertEqual({path.split("/")[1] for path in found["results"]}, {"characterization", "mechanics"})
            self.assertEqual(len(found["provenance"]), 3)

    def test_one_of_two_makes_the_file(self):
        words = ["generate", "vem", "--particles", "60", "--volume-fraction", "0.3", "--radius", "1um", "-o", "new.h5"]
        runs = [self.start(*words, "--seed", seed) for seed in (1, 2)]
        told = [run.communicate()[1] for run in runs]
        self.assertEqual(sorted(run.returncode for run in runs), [0, 3], told)
        self.check_sentence("".join(told), says=["new.h5", "exists already"])
        self.assertEqual(os.listdir(self.folder), ["new.h5"])

    def test_mode_is_kept(self):
        path = self.copy_of_packing()
        path.chmod(0o600)
        self.succeed("characterize", "packing.h5", "--only", "coordination")
        self.assertEqual(path.stat().st_mode & 0o777, 0o600)


class FullDisk(ProgramTest):
    def test_new_file(self):
        self.fail_with(1, *VEM, "-o", "out.h5", says="out.h5", preexec_fn=small_files_only)

    def test_results_added_to_a_file(self):
        source = self.copy_of_packing()
        before = checksum(source)
        for verb in ("characterize", "shear"):
            self.fail_with(1, verb, "packing.h5", says="packing.h5", preexec_fn=small_files_only)
            self.assertEqual(checksum(source), before)

    def test_text(self):
        self.copy_of_packing()
        self.fail_with(1, "export", "packing.h5", "--format", "extxyz", says="packing.extxyz", preexec_fn=small_files_only)

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_standard_output(self):
        self.copy_of_packing()
        with open("/dev/full", "w") as full:
            done = self.run_to(full, "info", "packing.h5", "--json")
        self.assertEqual(done.returncode, 1)
        self.check_sentence(done.stderr, "standard output")

    def run_to(self, stream, *words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=stream, stderr=subprocess.PIPE, text=True, timeout=60)


if __name__ == "__main__":
    unittest.main()
