# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula generate brownian from outside: options, files, restart, refusals."""

import os
import pty
import signal
import subprocess
import time
import unittest

import h5py

from support import PACKING, PROGRAM, ProgramTest, checksum
from test_determinism import data_sets

SUSPENSION = ["generate", "brownian", "--particles", "300", "--volume-fraction", "0.4", "--radius", "0.25um",
              "--equilibration-time", "0.3ms"]
RUN = [*SUSPENSION, "--surface-potential", "0mV", "--stop-time", "0.3ms"]


class Potential(ProgramTest):
    CURVE = ["generate", "brownian", "--potential-curve", "--radius", "0.25um"]

    def test_barrier_and_secondary_minimum(self):
        found = self.succeed_json(*self.CURVE, "--surface-potential", "15mV")
        self.assertAlmostEqual(found["barrier_height_kT"], 5.65, delta=0.02)
        self.assertAlmostEqual(found["secondary_minimum"]["energy_kT"], -1.8, delta=0.05)
        self.assertEqual(len(found["curve"]["gap"]), len(found["curve"]["energy_kT"]))
        self.assertIsNone(self.succeed_json(*self.CURVE, "--surface-potential", "11.5mV")["barrier"])

    def test_ionic_strength_is_a_debye_length(self):
        by_strength = self.succeed_json(*self.CURVE, "--surface-potential", "15mV", "--ionic-strength", "0.93mol/m3")
        self.assertAlmostEqual(by_strength["barrier_height_kT"], 5.65, delta=0.3)
        self.fail_with(2, *self.CURVE, "--surface-potential", "15mV", "--ionic-strength", "1mol/m3", "--debye-length", "10nm",
                       says="both set the Debye length")

    def test_picture(self):
        self.succeed(*self.CURVE, "--surface-potential", "15mV", "--picture", "curve.svg")
        self.assertIn("<svg", (self.folder / "curve.svg").read_text())
        self.fail_with(2, *self.CURVE, "--surface-potential", "15mV", "--picture", "curve.jpg", says=".svg, .png or .pdf")


class Runs(ProgramTest):
    def test_later_stages_take_the_output(self):
        made = self.succeed_json(*RUN, "--snapshots", "0.1ms,0.2ms", "-o", "b.h5")
        self.assertGreater(made["coordination"], 0.5)
        self.assertEqual(made["time_step"]["reason"], "the motion of free particles")
        self.assertEqual(len(made["series"]["time"]), len(made["series"]["largest_cluster"]))
        found = self.succeed_json("characterize", "b.h5")
        self.assertAlmostEqual(found["coordination"], made["coordination"])
        self.succeed_json("shear", "b.h5")
        with h5py.File(self.folder / "b.h5") as file:
            self.assertEqual(file["particles/trajectory/position/value"].shape, (3, 300, 3))
            self.assertEqual(file["particles/trajectory/box/edges/value"].shape, (3, 3, 3))
            self.assertLess(abs(file["particles/trajectory/position/time"][1] - 2e-4), 2e-6)

    def test_threads_give_the_same_bytes(self):
        for threads in (1, 2):
            self.succeed("generate", "brownian", "--particles", "4100", "--volume-fraction", "0.4", "--radius", "0.25um",
                         "--equilibration-time", "0.02ms", "--surface-potential", "0", "--stop-time", "0.05ms",
                         "--threads", threads, "-o", f"{threads}.h5")
        one, two = (data_sets(self.folder / f"{threads}.h5") for threads in (1, 2))
        self.assertEqual(one.keys(), two.keys())
        for name in one:
            self.assertEqual(one[name], two[name], name)

    def test_rough_contacts_levels_and_heterogeneity(self):
        rough = ["--contact-shear-stiffness", "6mN/m", "--friction", "0.3", "--rolling-stiffness", "3mN/m", "--rolling-friction", "0.1"]
        made = self.succeed_json(*SUSPENSION, *rough, "--surface-potential", "0", "--stop-plateau", "coordination", "--plateau-time",
                                 "0.3ms", "--plateau-change", "0.1", "--stop-time", "20ms", "--snapshots", "0.2ms",
                                 "--heterogeneity", "-o", "b.h5")
        self.assertEqual(made["ended_by"], "plateau")
        self.assertEqual(made["series"]["percolating_axes"][-1], 3)
        self.assertGreater(made["series"]["rolling_energy"][-1], 0)
        found = self.succeed_json("characterize", "b.h5")
        self.assertEqual(len(made["heterogeneity"]["a"]), 3)
        self.assertAlmostEqual(made["heterogeneity"]["a"][-1], found["doh"]["a"])
        self.assertEqual(made["heterogeneity"]["coordination"][-1], made["coordination"])
        self.assertLess(made["heterogeneity"]["a"][0], made["heterogeneity"]["a"][-1])

    def test_weight_and_hydrodynamics(self):
        words = [*SUSPENSION, "--surface-potential", "50mV", "--stop-time", "0.3ms"]
        plain = self.succeed_json(*words, "-o", "plain.h5")
        made = self.succeed_json(*words, "--hydrodynamics", "mean-field", "--gravity", "9.81m/s2", "--density-difference",
                                 "2690kg/m3", "-o", "b.h5")
        self.assertAlmostEqual(plain["diffusion_time"] / made["diffusion_time"], (1 - 1.56 * 0.4) * (1 - 0.27 * 0.4))
        self.assertLess(made["volume_fraction"], 0.38)
        self.succeed_json("characterize", "b.h5")

    def test_goes_on_from_a_packing_of_another_generator(self):
        made = self.succeed_json("generate", "brownian", "--start", PACKING, "--surface-potential", "0", "--stop-time", "10us",
                                 "-o", "b.h5")
        self.assertEqual(made["particles"], 500)
        self.assertGreater(made["coordination"], 3.5)

    def test_potential_from_a_table(self):
        self.write("table.csv", "gap [nm],energy [J]\n" + "".join(f"{gap},{-2e-20 * 2.718 ** (-gap / 20)}\n" for gap in range(1, 200, 3)))
        made = self.succeed_json(*SUSPENSION, "--potential-table", "table.csv", "--stop-time", "0.05ms", "-o", "b.h5")
        self.assertLess(made["potential"]["contact_energy"], -3)


class Restart(ProgramTest):
    LONG = [*SUSPENSION, "--surface-potential", "12mV", "--stop-time", "3ms", "--contact-shear-stiffness", "6mN/m", "--friction", "0.3",
            "--rolling-stiffness", "3mN/m"]

    def test_killed_runs_go_on_to_the_same_bytes(self):
        self.check_killed_runs(self.LONG)

    def test_killed_runs_in_a_flow_go_on_to_the_same_bytes(self):
        self.check_killed_runs([*self.LONG, "--shear-rate", "300Hz"])

    def check_killed_runs(self, run):
        self.succeed(*run, "-o", "whole.h5")
        words = [*run, "--checkpoint", "state.h5", "--checkpoint-interval", "0.05s", "-o", "pieces.h5"]
        for signal_number in (signal.SIGKILL, signal.SIGTERM):
            before = checksum(self.folder / "state.h5") if (self.folder / "state.h5").exists() else ""
            program = subprocess.Popen([PROGRAM, *words], cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
            for _ in range(600):
                time.sleep(0.05)
                if (self.folder / "state.h5").exists() and checksum(self.folder / "state.h5") != before:
                    break
            program.send_signal(signal_number)
            _, complaint = program.communicate()
            self.assertNotEqual(program.returncode, 0, "the run was over before it could be stopped")
            if signal_number == signal.SIGTERM:
                self.check_sentence(complaint, "interrupted: the state of the run is in state.h5")
        self.assertFalse((self.folder / "pieces.h5").exists())
        self.succeed(*words)
        whole, pieces = data_sets(self.folder / "whole.h5"), data_sets(self.folder / "pieces.h5")
        self.assertEqual(whole.keys(), pieces.keys())
        for name in whole:
            self.assertEqual(whole[name], pieces[name], name)
        os.remove(self.folder / "pieces.h5")
        self.fail_with(2, *words, "--seed", "2", says="other options")

    def test_a_checkpoint_goes_on_to_another_stop_time(self):
        """With the samples as they began: the bytes are those of a run to the later time with the sample interval of the first."""
        short = [*SUSPENSION, "--surface-potential", "12mV", "--checkpoint", "state.h5", "--checkpoint-interval", "0.01s"]
        self.succeed(*short, "--stop-time", "0.4ms", "-o", "short.h5")
        self.succeed(*short, "--stop-time", "0.8ms", "-o", "longer.h5")
        self.fail_with(2, *short, "--stop-time", "0.1us", "-o", "x.h5", says=["the checkpoint is at", "after the stop time of"])
        self.succeed(*short[:-4], "--stop-time", "0.8ms", "--sample-interval", "2us", "-o", "whole.h5")
        longer, whole = data_sets(self.folder / "longer.h5"), data_sets(self.folder / "whole.h5")
        self.assertEqual(longer.keys(), whole.keys())
        for name in whole:
            self.assertEqual(longer[name], whole[name], name)

    def test_a_checkpoint_belongs_to_one_run_at_a_time(self):
        words = [*SUSPENSION, "--surface-potential", "12mV", "--stop-time", "1s", "--checkpoint", "state.h5", "--checkpoint-interval", "0s"]
        first = subprocess.Popen([PROGRAM, *words, "-o", "first.h5"], cwd=self.folder, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.addCleanup(first.kill)
        while not (self.folder / "state.h5").exists():
            self.assertIsNone(first.poll())
            time.sleep(0.02)
        for other in ([], ["--seed", "2"]):
            said = self.run_program(*words, *other, "-o", "second.h5")
            self.assertEqual(said.returncode, 2, said.stderr)
            self.check_sentence(said.stderr, says="another run is using the checkpoint state.h5: wait for its end")
        first.send_signal(signal.SIGKILL)
        first.wait()
        self.check_sentence(self.run_program(*words, "--seed", "2", "-o", "second.h5").stderr, says="other options")
        self.assertEqual([path.name for path in self.folder.glob(".*")], [])

    @unittest.skipIf(os.geteuid() != 0, "only root may give links away")
    def test_a_link_that_another_user_puts_in_place_of_the_checkpoint(self):
        victim = self.write("victim", "precious")
        shared = self.folder / "shared"
        shared.mkdir()
        shared.chmod(0o1777)
        words = [*SUSPENSION, "--surface-potential", "12mV", "--stop-time", "1s", "--checkpoint", "shared/state.h5", "--checkpoint-interval", "1.5s"]
        run = subprocess.Popen([PROGRAM, *words, "-o", "x.h5"], cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        self.addCleanup(run.kill)
        while not (shared / ".state.h5.run").exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        time.sleep(0.5)  # until it has seen that there is no checkpoint yet
        os.symlink(victim, shared / "state.h5")
        os.chown(shared / "state.h5", 65534, 65534, follow_symlinks=False)
        _, complaint = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 2)
        self.check_sentence(complaint, says=["shared/state.h5", "symbolic link of another user"])
        self.assertEqual(victim.read_text(), "precious")
        self.assertEqual(os.listdir(shared), ["state.h5"])

    def test_full_disk_keeps_the_last_checkpoint(self):
        words = [*self.LONG, "--checkpoint", "state.h5", "--checkpoint-interval", "0s", "-o", "b.h5"]
        self.write("state.h5", "no checkpoint")
        self.fail_with(2, *words, says="state.h5")
        os.remove(self.folder / "state.h5")
        limit = f"ulimit -f 8; exec {PROGRAM} " + " ".join(words)
        done = subprocess.run(["bash", "-c", limit], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.check_sentence(done.stderr, says="state.h5")
        self.assertEqual(os.listdir(self.folder), [])
        # A good checkpoint outlives the disk that fills up behind it, and the run goes on from it.
        program = subprocess.Popen([PROGRAM, *words], cwd=self.folder, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        while not (self.folder / "state.h5").exists() and program.poll() is None:
            time.sleep(0.02)
        program.send_signal(signal.SIGTERM)
        program.wait()
        before = checksum(self.folder / "state.h5")
        done = subprocess.run(["bash", "-c", limit], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.check_sentence(done.stderr, says="state.h5")
        self.assertEqual(os.listdir(self.folder), ["state.h5"])
        self.assertEqual(checksum(self.folder / "state.h5"), before)
        self.succeed(*words)
        # A damaged one is refused and kept.
        whole = (self.folder / "state.h5").read_bytes()
        (self.folder / "state.h5").write_bytes(whole[:len(whole) // 2])
        self.fail_with(2, *words, "--force", says="state.h5")
        self.assertEqual((self.folder / "state.h5").read_bytes(), whole[:len(whole) // 2])

    def test_overlapping_start(self):
        self.write("points.csv", "x,y,z\n" + "".join(f"{x},{y},{z}\n" for x in (1, 4, 7) for y in (1, 4, 7) for z in (1, 2.8, 6)))
        self.succeed("import", "points.csv", "--radius", "0.25um", "--length-unit", "0.25um", "--box", "2.25um", "-o", "points.h5")
        self.fail_with(2, "generate", "brownian", "--start", "points.h5", "--surface-potential", "0", "--stop-time", "1us", "-o",
                       "b.h5", says="overlap by")
        self.assertFalse((self.folder / "b.h5").exists())


class OnATerminal(ProgramTest):
    def test_progress_names_the_time_left(self):
        terminal, other = pty.openpty()
        program = subprocess.Popen([PROGRAM, *SUSPENSION, "--surface-potential", "12mV", "--stop-time", "1s", "-o", "b.h5"],
                                   cwd=self.folder, stderr=other, stdout=subprocess.DEVNULL)
        os.close(other)
        seen = ""
        until = time.monotonic() + 100
        while " left  coordination" not in seen and time.monotonic() < until:
            seen += os.read(terminal, 4096).decode()
        program.kill()
        program.wait()
        os.close(terminal)
        self.assertRegex(seen, r"Brownian dynamics \[[#.]+\] +\d+ %  \d+ (s|min) left  coordination")


class Refusals(ProgramTest):
    def test_sentences(self):
        for more, says in ((["--debye-length", "-1nm"], "--debye-length"),
                           (["--contact-stiffness", "0"], "--contact-stiffness"),
                           (["--integrator", "euler", "--time-step", "1us"], "stable up to"),
                           (["--volume-fraction", "0.7"], "--volume-fraction"),
                           (["--equilibrium-gap", "90nm"], "contact"),
                           (["--friction", "0.3"], "--contact-shear-stiffness"),
                           (["--gravity", "9.81m/s2"], "density difference"),
                           (["--stop-plateau", "energy"], "--stop-plateau"),
                           (["--yukawa-energy", "1e-20J"], "--yukawa-length"),
                           (["--potential-table", "absent.csv"], "absent.csv"),
                           (["--snapshots", "1nm"], "1nm")):
            words = [word for word in RUN]
            if more[0] == "--potential-table":
                words = [*SUSPENSION, "--stop-time", "1ms"]
            if more[0] in words:
                words[words.index(more[0]) + 1] = more[1]
                more = []
            with self.subTest(says=says):
                self.fail_with(2, *words, *more, "-o", "b.h5", says=says)
        for rows, says in (("1,0\n2,0\n", "at least four gaps"),
                           ("1,0\n2,0\n5,0\n4,0\n", "row 4 of the tabulated law"),
                           ("1,0\n2,1e200\n5,0\n9,0\n", "line 3: energy is 1e+200 J, but must be"),
                           ("1,0\n2\n5,0\n9,0\n", "line 3")):
            self.write("table.csv", "gap [nm],energy [J]\n" + rows)
            self.fail_with(2, *SUSPENSION, "--stop-time", "1ms", "--potential-table", "table.csv", "-o", "b.h5", says=["table.csv", says])
        self.fail_with(2, *SUSPENSION, "--stop-time", "1ms", "-o", "b.h5", says="--surface-potential")
        self.fail_with(2, *SUSPENSION, "--surface-potential", "0", "-o", "b.h5", says="--stop-time")
        self.fail_with(2, *RUN, says="--output")


if __name__ == "__main__":
    unittest.main()
