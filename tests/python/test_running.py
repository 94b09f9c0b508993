# SPDX-License-Identifier: GPL-3.0-or-later
"""Long calls: they tell how far they have come, can be stopped, leave the interpreter to other threads, and files stay readable."""

import multiprocessing
import signal
import subprocess
import sys
import threading
import time
import unittest

import h5py
import numpy as np

import coagula
from support import ModuleTest

LONG = {"particles": 100000, "volume_fraction": 0.4, "radius": "1um"}


class Progress(ModuleTest):
    def test_callback(self):
        told = []
        self.made(progress=lambda stage, fraction, remark: told.append((stage, fraction, remark)))
        self.assertTrue(told)
        self.assertTrue(all(isinstance(stage, str) and 0 <= fraction <= 1 and isinstance(remark, str) for stage, fraction, remark in told))

    def test_what_it_raises_stops_the_call(self):
        class Enough(Exception):
            pass

        def stop(stage, fraction, remark):
            raise Enough(stage)

        begun = time.monotonic()
        with self.assertRaises(Enough):
            coagula.generate_vem(**LONG, progress=stop)
        self.assertLess(time.monotonic() - begun, 60)

    def test_threads(self):
        one, two = (self.made(particles=100, voids=50, threads=threads).packing.positions for threads in (1, 2))
        np.testing.assert_array_equal(one, two)
        with self.assertRaisesRegex(coagula.InputError, "threads: '0' is out of range"):
            self.made(threads=0)


class Interruption(ModuleTest):
    def test_signal(self):
        code = ("import sys, coagula\nprint('ready', flush=True)\n"
                "try:\n    coagula.generate_vem(particles=100000, volume_fraction=0.4, radius='1um')\n"
                "except KeyboardInterrupt:\n    print('interrupted')\n    sys.exit(7)\n")
        child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        self.addCleanup(child.stdout.close)
        self.addCleanup(child.kill)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.stdout.readline(), "interrupted\n")
        self.assertEqual(child.wait(30), 7)


def coordination_of(seed):
    return coagula.generate_vem(particles=200, voids=100, volume_fraction=0.4, radius="1um", seed=seed, threads=2).coordination


class Forks(ModuleTest):
    def test_a_forked_child_of_a_process_that_has_calculated(self):
        alone = [coordination_of(seed) for seed in (1, 2, 3)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map_async(coordination_of, (1, 2, 3)).get(timeout=60), alone)
        self.assertEqual(coordination_of(1), alone[0])  # the parent goes on

    def test_a_child_forked_from_another_thread(self):
        coordination_of(1)
        ended = []

        def fork():
            child = multiprocessing.get_context("fork").Process(target=coordination_of, args=(1,))
            child.start()
            child.join(60)
            ended.append(child.exitcode)
            child.kill()

        thread = threading.Thread(target=fork)
        thread.start()
        thread.join()
        self.assertEqual(ended, [0])


class Threads(ModuleTest):
    def test_more_than_there_are_processors(self):
        np.testing.assert_array_equal(*(self.made(particles=60, voids=30, threads=threads).packing.positions for threads in (1, 4096)))

    def test_another_thread_goes_on(self):
        """While the call runs, a thread of Python counts; with the lock of the interpreter held it could not."""
        counts = []
        over = threading.Event()

        def count():
            while not over.is_set():
                counts.append(time.monotonic())
                time.sleep(0.001)

        def stop(stage, fraction, remark):
            if len(counts) > 50:
                raise StopIteration

        thread = threading.Thread(target=count)
        thread.start()
        begun = time.monotonic()
        with self.assertRaises(StopIteration):
            coagula.generate_vem(**LONG, progress=stop)
        ended = time.monotonic()
        over.set()
        thread.join()
        self.assertGreater(sum(begun < moment < ended for moment in counts), 20)

    def test_calls_at_the_same_time(self):
        alone = [self.made(particles=100, voids=50, seed=seed).packing.positions for seed in range(4)]
        together = [None] * 4

        def make(seed):
            together[seed] = self.made(particles=100, voids=50, seed=seed).packing.positions

        threads = [threading.Thread(target=make, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one, other in zip(alone, together):
            np.testing.assert_array_equal(one, other)

    def test_files_from_many_threads(self):
        """Files are read in a child process, which must not inherit the lock of libhdf5 while h5py holds it in another thread."""
        made = self.made(particles=100, voids=50)
        coagula.write("shared.h5", made)
        wrong = []

        def work(number):
            try:
                for k in range(5):
                    name = f"{number}_{k}.h5"
                    coagula.write(name, made)
                    np.testing.assert_array_equal(coagula.read(name).bonds.ends, made.bonds.ends)
                    with h5py.File("shared.h5") as file:
                        self.assertEqual(file["particles/trajectory/position/value"].shape[1:], (100, 3))
            except Exception as error:
                wrong.append(error)

        threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    unittest.main()
