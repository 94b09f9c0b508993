"""Outputs are checked before the work, written whole or not at all, and never replaced unasked."""

import os
import resource
import shutil
import subprocess
import unittest

from support import PROGRAM, VEM, ProgramTest, checksum


def small_files_only():
    """The program may write files of at most 8 kB: as good as a full disk."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))


class Outputs(ProgramTest):
    def test_existing_output_needs_force(self):
        source = self.copy_of_packing()
        target = self.write("old.h5", "precious")
        before = checksum(target)
        for words in (VEM, ["characterize", source], ["shear", source], ["export", source, "--format", "csv"]):
            self.fail_with(2, *words, "-o", "old.h5", says=["old.h5", "--force"])
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
        self.fail_with(2, "export", "a.h5", "--format", "lammps", says=["a.data", "--force"])
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.data", "a.h5"])


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
        self.succeed("shear", "packing.h5", "--frequency", "2Hz", "--bond-tolerance", "0.05")
        self.assertEqual(self.succeed_json("info", "packing.h5")["own_bonds"], {"/mechanics/linear": linear})
        self.succeed("shear", "packing.h5", "--bond-tolerance", "0.05")
        self.assertEqual(self.succeed_json("info", "packing.h5")["own_bonds"], {})


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
        self.assertEqual(sorted(run.returncode for run in runs), [0, 2], told)
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
