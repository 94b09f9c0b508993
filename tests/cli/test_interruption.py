# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C: a sentence, exit code 1, nothing left behind; a second one ends at once."""

import fcntl
import os
import select
import signal
import struct
import subprocess
import time
import unittest

from support import PROGRAM, ProgramTest, checksum

LONG_RUN = ["generate", "vem", "--particles", "100000", "--volume-fraction", "0.4", "--radius", "1um", "--seed", "1", "-o", "out.h5"]


class Interruption(ProgramTest):
    def start(self, *words):
        process = subprocess.Popen([PROGRAM, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        time.sleep(1.5)
        self.assertIsNone(process.poll(), "the run was over before it could be interrupted")
        return process

    def interrupt(self, process, number=signal.SIGINT):
        process.send_signal(number)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, errors)
        self.assertEqual(output, "")
        self.check_sentence(errors, "interrupted")

    def test_generation(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.interrupt(self.start(*LONG_RUN), number)
            self.assertEqual(os.listdir(self.folder), [])

    def test_older_output_is_untouched(self):
        old = self.write("out.h5", "precious")
        before = checksum(old)
        self.interrupt(self.start(*LONG_RUN, "--force"))
        self.assertEqual(checksum(old), before)
        self.assertEqual(os.listdir(self.folder), ["out.h5"])

    def test_characterization_leaves_its_input_alone(self):
        source = self.copy_of_packing()
        before = checksum(source)
        self.interrupt(self.start("characterize", "packing.h5", "--radii", "100000"))
        self.assertEqual(checksum(source), before)
        self.assertEqual(os.listdir(self.folder), ["packing.h5"])

    def test_second_signal_ends_at_once(self):
        process = self.start(*LONG_RUN)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=10)
        self.assertIn(process.returncode, (-signal.SIGINT, -signal.SIGTERM, 1))
        self.assertEqual(os.listdir(self.folder), [])

    def test_who_waits_for_another_writer_answers(self):
        self.copy_of_packing()
        for number in (signal.SIGTERM, signal.SIGINT):
            with open(self.folder / ".packing.csv.lock", "w") as held:  # the program waits for this lock
                fcntl.fcntl(held, fcntl.F_OFD_SETLK, struct.pack("hhqqi", fcntl.F_WRLCK, os.SEEK_SET, 0, 0, 0))
                self.interrupt(self.start("export", "packing.h5", "--format", "csv"), number)
                self.assertFalse((self.folder / "packing.csv").exists())

    def blocked(self):
        """A call that waits in a write, and the end of the pipe that nobody reads."""
        reading, writing = os.pipe()
        self.addCleanup(os.close, reading)
        fcntl.fcntl(writing, fcntl.F_SETPIPE_SZ, 4096)
        process = subprocess.Popen([PROGRAM, "man", "shear"], stdout=writing, stderr=subprocess.PIPE, text=True)
        os.close(writing)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(process.stderr.close)
        self.assertTrue(select.select([reading], [], [], 60)[0], "nothing was written")
        return process

    def test_what_does_not_answer_ends_within_two_seconds(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.blocked()
            begun = time.monotonic()
            process.send_signal(number)
            self.assertEqual(process.wait(10), 1)
            self.assertLess(time.monotonic() - begun, 2)
            self.check_sentence(process.stderr.read(), "interrupted: what was not complete is not written")

    def test_measures_look_at_the_request(self):
        source = self.copy_of_packing()
        before = checksum(source)
        process = self.start("characterize", "packing.h5", "--only", "chord_lengths", "--chord-lines", "20000000")
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=10)[1]
        self.assertEqual((process.returncode, errors), (1, "coagula: interrupted: nothing was written\n"))
        self.assertEqual(checksum(source), before)

    def test_second_signal_ends_what_does_not_answer(self):
        for first, second in ((signal.SIGTERM, signal.SIGINT), (signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGTERM)):
            process = self.blocked()
            process.send_signal(first)
            time.sleep(0.2)
            self.assertIsNone(process.poll())
            process.send_signal(second)
            self.assertEqual(process.wait(10), -second)


if __name__ == "__main__":
    unittest.main()
