# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that Python writes are written as those of the program."""

import os
import subprocess
import sys
import unittest

import coagula
from support import ModuleTest

WRITER = """
import os, sys, time
import coagula
packing = coagula.Packing([[0.0, 0, 0], [1, 0, 0], [float(sys.argv[2]), 1, 0]], 0.4, box=5)
print("ready", flush=True)
sys.stdin.readline()
try:
    coagula.write(sys.argv[1], packing, overwrite=sys.argv[3] == "overwrite")
except coagula.ExistingFileError:
    sys.exit(2)
"""


class Writing(ModuleTest):
    def setUp(self):
        super().setUp()
        self.packing = coagula.Packing([[0.0, 0, 0], [1, 0, 0]], 0.4, box=5)

    def test_mode_is_kept(self):
        for name in ("a.h5", "a.csv", "a.extxyz"):
            for mode in (0o600, 0o640):
                coagula.write(name, self.packing, overwrite=True)
                os.chmod(name, mode)
                coagula.write(name, self.packing, overwrite=True)
                self.assertEqual(os.stat(name).st_mode & 0o777, mode)

    def test_links_are_kept(self):
        os.mkdir("elsewhere")
        for name in ("a.h5", "a.csv"):
            os.symlink(f"elsewhere/{name}", name)
            coagula.write(name, self.packing)
            self.assertTrue(os.path.islink(name))
            self.assertEqual(len(coagula.read(f"elsewhere/{name}", **({} if name == "a.h5" else {"box": "5m"})).packing), 2)

    def test_nothing_beside_is_touched(self):
        for name in ("x.h5.part", ".x.h5.tmp", "target"):
            with open(name, "w") as file:
                file.write("precious")
        os.symlink("target", "y.h5.part")
        coagula.write("x.h5", self.packing)
        coagula.write("y.h5", self.packing)
        with self.assertRaises(FileExistsError):
            coagula.write("x.h5", self.packing)
        for name in ("x.h5.part", ".x.h5.tmp", "target"):
            with open(name) as file:
                self.assertEqual(file.read(), "precious")
        self.assertEqual(sorted(os.listdir()), [".x.h5.tmp", "target", "x.h5", "x.h5.part", "y.h5", "y.h5.part"])

    def test_protected_file_is_not_replaced(self):
        coagula.write("a.h5", self.packing)
        os.chmod("a.h5", 0o444)
        with self.assertRaisesRegex(coagula.InputError, "a.h5: it is protected against writing"):
            coagula.write("a.h5", self.packing, overwrite=True)

    def test_all_stages_are_kept(self):
        made = self.made()
        first = coagula.characterize(made, only="coordination")
        second = coagula.characterize(made, only="overlap")
        coagula.write("a.h5", made, first, coagula.shear(made), second)
        read = coagula.read("a.h5")
        self.assertEqual(read.characterization.coordination, first.coordination)
        self.assertEqual(read.characterization.overlap.mean, second.overlap.mean)
        self.assertEqual([entry["stage"] for entry in read.history], ["generate vem", "characterize", "shear", "characterize"])
        with self.assertRaisesRegex(RuntimeError, "another packing"):
            coagula.write("b.h5", self.made(seed=2), first)
        self.assertFalse(os.path.exists("b.h5"))

    def test_two_writers(self):
        for overwrite, codes in (("new", [0, 2]), ("overwrite", [0, 0])):
            for turn in range(2):
                name = f"{overwrite}{turn}.h5"
                writers = [subprocess.Popen([sys.executable, "-c", WRITER, name, z, overwrite], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            text=True) for z in ("2", "3")]
                for writer in writers:
                    self.assertEqual(writer.stdout.readline(), "ready\n")
                for writer in writers:
                    writer.stdin.write("go\n")
                    writer.stdin.flush()
                for writer in writers:
                    writer.communicate()
                self.assertEqual(sorted(writer.returncode for writer in writers), codes)
                self.assertEqual(len(coagula.read(name).packing), 3)
        self.assertFalse([name for name in os.listdir() if name.startswith(".")])

    def test_closed_standard_error(self):
        """The file does not become what the descriptor was."""
        script = WRITER.split("print")[0] + "coagula.write(sys.argv[1], packing); assert len(coagula.read(sys.argv[1]).packing) == 3"
        for closed in ("2>&-", "<&- 2>&-"):
            done = subprocess.run(["sh", "-c", f'exec "$0" "$@" {closed}', sys.executable, "-c", script, f"{len(closed)}.h5", "2"],
                                  stdout=subprocess.PIPE)
            self.assertEqual(done.returncode, 0)
            self.assertEqual(len(coagula.read(f"{len(closed)}.h5").packing), 3)


if __name__ == "__main__":
    unittest.main()
