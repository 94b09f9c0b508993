# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed package is found by find_package(coagula COMPONENTS ...), and somebody else's program builds on it."""

import math
import os
import subprocess
import unittest
from pathlib import Path

from support import ProgramTest

CMAKE = os.environ["COAGULA_CMAKE"]
GENERATOR = os.environ["COAGULA_GENERATOR"]
BUILD = os.environ["COAGULA_BUILD"]
CONSUMER = Path(__file__).parent / "consumer"
EXAMPLE = Path(__file__).resolve().parent.parent.parent / "examples/library"


class Install(ProgramTest):
    def call(self, *words):
        done = subprocess.run(list(map(str, words)), cwd=self.folder, capture_output=True, text=True, timeout=250)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def configure(self, wanted):
        self.call(CMAKE, "-S", CONSUMER, "-B", "consumer", "-G", GENERATOR, f"-DCMAKE_PREFIX_PATH={self.folder / 'prefix'}",
                  f"-DWANTED={wanted}", "-DCMAKE_BUILD_TYPE=Debug")

    def test_consumer(self):
        self.call(CMAKE, "--install", BUILD, "--prefix", self.folder / "prefix")
        self.assertIn("coagula", self.call(self.folder / "prefix/bin/coagula", "--version"))
        for file in ("man/man1/coagula-shear.1", "bash-completion/completions/coagula", "zsh/site-functions/_coagula"):
            self.assertTrue((self.folder / "prefix/share" / file).is_file(), file)
        for component in ("common", "io", "generators", "mechanics", "diagnose", "experiment", ""):
            self.configure(component)
        self.configure("characterize;report")
        self.call(CMAKE, "--build", "consumer")
        coordination, void_fraction = map(float, self.call(self.folder / "consumer/consumer").split())
        self.assertEqual(coordination, 6)
        self.assertAlmostEqual(void_fraction, 1 - math.pi / 6, delta=1e-5)
        self.assertIn("| contact-loss |", self.call(self.folder / "consumer/causes"))
        self.call(CMAKE, "-S", EXAMPLE, "-B", "example", "-G", GENERATOR, f"-DCMAKE_PREFIX_PATH={self.folder / 'prefix'}")
        self.call(CMAKE, "--build", "example")
        self.assertRegex(self.call(self.folder / "example/modulus"), r"^G' = \d+\.\d+ MPa$")

    def test_one_component_alone(self):
        prefix = self.folder / "prefix"
        for component in ("common", "characterize"):
            self.call(CMAKE, "--install", BUILD, "--prefix", prefix, "--component", component)
        self.assertFalse((prefix / "bin").exists())
        self.configure("characterize")
        self.call(CMAKE, "--build", "consumer")


if __name__ == "__main__":
    unittest.main()
