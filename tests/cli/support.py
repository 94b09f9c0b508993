# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the program share: running it in a folder of its own and judging how it failed."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["COAGULA_PROGRAM"]
PACKING = Path(os.environ["COAGULA_PACKING"])  # 500 particles, written by the test cli.packing
MEASURED = Path(os.environ.get("COAGULA_MEASURED", PACKING))  # the same, characterized and sheared
SMALL = ["generate", "vem", "--particles", "60", "--voids", "30", "--volume-fraction", "0.4", "--radius", "0.25um"]
VEM = ["generate", "vem", "--particles", "500", "--voids", "250", "--volume-fraction", "0.4", "--radius", "0.25um"]


def checksum(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


class ProgramTest(unittest.TestCase):
    """Each test has an empty folder, which is also the working directory of the program."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="coagula-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *words, **options):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=200,
                              stdin=subprocess.DEVNULL, **options)

    def succeed(self, *words, **options):
        done = self.run_program(*words, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def succeed_json(self, *words, **options):
        def refuse(constant):
            self.fail(f"{constant} is not JSON")

        return json.loads(self.succeed(*words, "--json", **options), parse_constant=refuse)

    def fail_with(self, code, *words, says=(), may_say_nan=False, **options):
        """Expects this exit code, one sentence with the given parts on standard error, and no new file in the folder."""
        before = sorted(os.listdir(self.folder))
        done = self.run_program(*words, **options)
        self.assertEqual(done.returncode, code, f"{words}: {done.stdout} {done.stderr}")
        self.check_sentence(done.stderr, says, may_say_nan)
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(os.listdir(self.folder)), before, "the call left something behind")
        return done.stderr

    def refuse_experiment(self, says=(), may_say_nan=False):
        """Expects that a diagnosis of experiment.toml and --check end with the same sentence."""
        sentence = self.fail_with(2, "diagnose", "experiment.toml", "-o", "results", says=says, may_say_nan=may_say_nan)
        self.assertEqual(self.fail_with(2, "diagnose", "check", "experiment.toml", may_say_nan=may_say_nan), sentence)

    def check_sentence(self, text, says=(), may_say_nan=False):
        self.assertRegex(text, r"\Acoagula: \S[^\n]*\n\Z")
        self.assertNotIn("terminate called", text)
        if not may_say_nan:
            self.assertIsNone(re.search(r"\bnan\b", text, re.IGNORECASE), text)
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, text)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def copy_of_packing(self, name="packing.h5"):
        return Path(shutil.copy(PACKING, self.folder / name))

    def copy_of_measured(self, name="measured.h5"):
        return Path(shutil.copy(MEASURED, self.folder / name))
