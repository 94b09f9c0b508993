# SPDX-License-Identifier: GPL-3.0-or-later
"""What a test may take is measured in turns of a loop: more is reported, and fails behind a gate only."""

import os
import subprocess
import unittest

PROGRAM = os.environ["COAGULA_PROCESSOR_TIME"]
BUSY = ["/usr/bin/python3", "-c", "sum(range(10_000_000))"]


class Limit(unittest.TestCase):
    def run_limited(self, command, limit, **more):
        environment = {name: value for name, value in os.environ.items() if name != "COAGULA_PROCESSOR_GATE"}
        return subprocess.run([PROGRAM, *command], env={**environment, "COAGULA_PROCESSOR_LIMIT": limit, **more}, capture_output=True,
                              text=True)

    def test_more_is_reported(self):
        done = self.run_limited(BUSY, "1")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"^processor time: \d\.\d\d s, \d+ turns of the loop where its tier allows 1\n$")

    def test_more_fails_behind_the_gate(self):
        done = self.run_limited(BUSY, "1", COAGULA_PROCESSOR_GATE="1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("make the test smaller", done.stderr)

    def test_less_passes(self):
        for limit in ("250", "0"):
            done = self.run_limited(BUSY, limit, COAGULA_PROCESSOR_GATE="1")
            self.assertEqual(done.returncode, 0)
            self.assertRegex(done.stderr, r"^processor time: \d\.\d\d s\n$")

    def test_a_failure_keeps_its_status(self):
        for limit in ("1", "250"):
            done = self.run_limited(["/usr/bin/python3", "-c", "sum(range(10_000_000)); exit(7)"], limit, COAGULA_PROCESSOR_GATE="1")
            self.assertEqual(done.returncode, 7)


if __name__ == "__main__":
    unittest.main()
