# SPDX-License-Identifier: GPL-3.0-or-later
"""HDF5 files with single wrong bytes: every verb ends with one sentence, in time, and changes nothing."""

import random
import resource
import tarfile
import unittest
from pathlib import Path

from support import ProgramTest, checksum

DATA = Path(__file__).resolve().parents[2] / "datasets" / "broken_files" / "broken_files.tar.xz"
LONGEST = 10  # seconds of processor time

BROWNIAN = ["generate", "brownian", "--particles", "20", "--volume-fraction", "0.2", "--radius", "0.25um", "--surface-potential", "0mV",
            "--equilibration-time", "1us", "--stop-time", "20us", "--sample-interval", "5us", "--time-step", "1us", "-o", "made.h5",
            "--force", "--checkpoint-interval", "0s", "--checkpoint"]
DEM = ["shear", "small.h5", "--method", "dem", "--boundary", "periodic", "--bond-tolerance", "0.5", "--oscillations", "2",
       "--steps-per-oscillation", "100", "--orientation", "xy", "-o", "made.h5", "--force", "--checkpoint"]
VERBS = {"info": ["info"], "char": ["characterize"], "coord": ["characterize", "--only", "coordination"], "shear": ["shear"],
         "export": ["export", "--format", "csv", "-o", "out.csv", "--force"],
         "report": ["report", "-o", "out.html", "--force"], "ck_bck": BROWNIAN, "ck_dck": DEM}
STRUCTURE_VERBS = ["info", "char", "coord", "shear", "export", "report"]


def verb_of(name):
    """The one that met the defect: its name is between the first word and the number."""
    return name.split("_", 1)[1].rsplit("_", 1)[0]


class BrokenFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("small.csv", "x [um],y [um],z [um]\n1,1,1\n2.1,1,1\n1,2.1,1\n2.1,2.1,1.2\n5,5,5\n")
        self.succeed("import", "small.csv", "--radius", "0.5um", "--box", "8um", "-o", "small.h5")

    def survive(self, path, verb):
        """The exit code: 0, 2, or 3 where the conditions of a result are damaged. The file is as it was when it was refused."""
        before = checksum(path)
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = self.run_program(*VERBS[verb], path.name)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - used.ru_utime - used.ru_stime, LONGEST)
        self.assertIn(done.returncode, (0, 2, 3), done.stderr)
        if done.returncode != 0:
            self.check_sentence(done.stderr, path.name, may_say_nan=True)
            self.assertEqual(checksum(path), before)
        return done.returncode

    def test_files_that_broke_hdf5(self):
        with tarfile.open(DATA) as archive:
            archive.extractall(self.folder)
        paths = sorted([*self.folder.glob("crash_*.h5"), *self.folder.glob("hang_*.h5")])
        self.assertEqual(len(paths), 19)
        for path in paths:
            verb = verb_of(path.name)
            with self.subTest(file=path.name):
                self.assertEqual(self.survive(path, verb), 2)
                for other in STRUCTURE_VERBS:
                    self.survive(path, other)

    def flip(self, name, verbs, times, seed):
        """Single bytes replaced at places and by values that the seed gives; how many files were refused."""
        whole = (self.folder / name).read_bytes()
        draw = random.Random(seed)
        refused = 0
        for turn in range(times):
            damaged = bytearray(whole)
            place = draw.randrange(len(whole))
            damaged[place] ^= draw.randrange(1, 256)
            path = self.folder / "damaged.h5"
            path.write_bytes(damaged)
            with self.subTest(place=place, value=damaged[place]):
                refused += self.survive(path, verbs[turn % len(verbs)]) == 2
        return refused

    def test_single_bytes_of_a_structure(self):
        self.assertGreater(self.flip("small.h5", STRUCTURE_VERBS, 75, seed=1), 10)

    def test_single_bytes_of_results(self):
        self.succeed("characterize", "small.h5")
        self.succeed("shear", "small.h5", "--bond-tolerance", "0.5")
        self.assertGreater(self.flip("small.h5", STRUCTURE_VERBS, 75, seed=2), 10)

    def test_single_bytes_of_checkpoints(self):
        for seed, (verb, words) in enumerate((("ck_bck", BROWNIAN), ("ck_dck", DEM))):
            name = verb + ".h5"
            self.succeed(*words, name)
            self.assertGreater(self.flip(name, [verb], 75, seed=3 + seed), 10)

    def test_a_value_of_a_checkpoint(self):
        import h5py
        self.succeed(*DEM, "state.h5")
        with h5py.File(self.folder / "state.h5", "r+") as file:
            file["state/position"][0] *= 1 + 1e-15
        self.fail_with(2, *DEM, "state.h5", says=["state.h5", "checksum"])


if __name__ == "__main__":
    unittest.main()
