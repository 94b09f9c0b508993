# SPDX-License-Identifier: GPL-3.0-or-later
"""The same command with the same seed gives the same bytes in every data set, /provenance aside, for any number of threads."""

import os
import subprocess
import unittest

import h5py

from support import PROGRAM, ProgramTest, VEM


def data_sets(path):
    """Raw bytes, type and attributes by path."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance"):
            value = item[()]
            found[name] = (item.dtype, item.shape, value if isinstance(value, bytes) else value.tobytes(),
                           {key: str(attribute) for key, attribute in item.attrs.items()})

    with h5py.File(path) as file:
        file.visititems(visit)
    return found


def free_of_openmp():
    """The environment without what the tests set."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("OMP_", "GOMP_"))}


class SameBytes(ProgramTest):
    def make(self, name, threads, seed=1):
        common = ["--threads", threads, "--quiet"]
        self.succeed(*VEM, "--seed", seed, "-o", name, *common)
        self.succeed("characterize", name, "--samples", 20000, *common)
        self.succeed("shear", name, *common)
        return data_sets(self.folder / name)

    def test_one_and_two_threads(self):
        one = self.make("one.h5", 1)
        two = self.make("two.h5", 2)
        self.assertGreater(len(one), 60)
        self.assertIn("mechanics/linear/elastic_tensor", one)
        self.assertEqual(one.keys(), two.keys())
        for name in one:
            self.assertEqual(one[name], two[name], name)

    def test_another_seed_gives_another_packing(self):
        one = self.make("one.h5", 2, seed=1)
        other = self.make("other.h5", 2, seed=2)
        self.assertNotEqual(one["particles/trajectory/position/value"], other["particles/trajectory/position/value"])

    def test_repeating_a_stage_replaces_its_results(self):
        self.make("a.h5", 2)
        first = data_sets(self.folder / "a.h5")
        self.succeed("characterize", "a.h5", "--samples", 20000)
        self.succeed("shear", "a.h5")
        self.assertEqual(first, data_sets(self.folder / "a.h5"))
        self.assertEqual(len(self.succeed_json("info", "a.h5")["provenance"]), 5)

    def test_no_library_takes_more_threads(self):
        """Left alone, CHOLMOD's loops take four."""
        self.succeed(*VEM, "-o", "made.h5", "--quiet")
        running = subprocess.Popen([PROGRAM, "shear", "made.h5", "--threads", "1", "--quiet"], cwd=self.folder, env=free_of_openmp(),
                                   stdin=subprocess.DEVNULL)
        most = 0
        while running.poll() is None:
            try:
                most = max(most, len(os.listdir(f"/proc/{running.pid}/task")))
            except OSError:
                break
        self.assertEqual(running.wait(), 0)
        self.assertIn(most, (1, 2))  # and one that OpenBLAS keeps

    def test_no_library_complains_of_a_wrong_number_of_threads(self):
        for count in ("0", "00", "-1", "99999999999999999999999", "two", ""):
            self.fail_with(2, *VEM, "--threads", count, "-o", "none.h5", says="--threads", env=free_of_openmp())


if __name__ == "__main__":
    unittest.main()
