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
        import subprocess
        from support import PROGRAM
        return subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=stream, stderr=subprocess.PIPE, text=True, timeout=60)


if __name__ == "__main__":
    unittest.main()
