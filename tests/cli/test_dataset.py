# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula dataset: runs that are killed and go on, sets that are used."""

import hashlib
import os
import random
import resource
import shutil
import signal
import subprocess
import time
import unittest

from support import PROGRAM, ProgramTest

try:
    import h5py
except ImportError:
    h5py = None

SWEEP = """title = "small"
authors = ["A. Nobody", "B. Somebody"]
licence = "CC0-1.0"

[[generate]]
verb = "vem"
particles = 60
voids = [10, 30]
volume-fraction = 0.4
radius = "0.25um"
replicates = 3

[characterize]
only = "coordination,doh"

[shear]
shear-stiffness = [10, 50]
"""
ROWS = 12


def values(path):
    """All data sets of a file by their paths, as bytes."""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = item[()].tobytes() if hasattr(item[()], "tobytes") else item[()]

    with h5py.File(path) as file:
        file.visititems(take)
    return found


def checksum(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@unittest.skipIf(h5py is None, "needs python3-h5py")
class Runs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.sweep = self.write("sweep.toml", SWEEP)

    def run_set(self, name="set.h5", *words, sweep="sweep.toml"):
        return self.succeed_json("dataset", "run", sweep, "-o", name, *words)

    def test_index(self):
        found = self.run_set()
        self.assertEqual((found["structures"], found["computed"], found["failed"]), (ROWS, ROWS, 0))
        with h5py.File(self.folder / "set.h5") as file:
            index = file["index"]
            self.assertEqual({len(column) for column in index.values()}, {ROWS})
            self.assertEqual([name for name in index if "unit" not in index[name].attrs or "description" not in index[name].attrs], [])
            self.assertEqual(sorted(set(index["voids"])), [10, 30])
            self.assertEqual(sorted(set(index["seed"])), [1, 2, 3])
            self.assertEqual(sorted(set(index["shear-stiffness"])), [10, 50])
            self.assertEqual(index["shear-stiffness"].attrs["unit"], b"N/m")
            self.assertNotIn("target-coordination", index)  # does not vary
            self.assertEqual(set(index["status"][()]), {b"done"})
            self.assertEqual(sorted(file["structures"]), sorted(name.decode() for name in index["id"][()]))
            self.assertEqual(file.attrs["title"], b"small")
            self.assertEqual(file.attrs["authors"], b"A. Nobody, B. Somebody")
            self.assertEqual(file["sweep"][()].decode(), SWEEP)
            for row, name in enumerate(index["id"][()]):
                structure = file["structures"][name.decode()]
                self.assertEqual(structure["mechanics/linear/storage_modulus/mean"][()], index["storage_modulus.mean"][row])
                self.assertEqual(structure["characterization/doh/a"][()], index["doh.a"][row])
                self.assertEqual(structure["characterization/uncertainty/doh/a"][()] if "uncertainty/doh/a" in structure["characterization"] else None,
                                 index["doh.a.stderr"][row] if "doh.a.stderr" in index else None)
        self.assertFalse((self.folder / "set.h5.parts").exists())

    def test_structures_of_one_trajectory_are_those_of_runs_of_their_own(self):
        """Several ends of one run, in any order and beside another axis, also where some are there already."""
        head = ('[[generate]]\nverb = "brownian"\nparticles = 60\nvolume-fraction = 0.3\nradius = "0.25um"\nequilibration-time = "0.1ms"\n'
                'surface-potential = "0mV"\nreplicates = 2\n')
        together = head + "stop-coordination = [2.5, 1.5, 2]\n[characterize]\nonly = \"coordination,doh\"\n"
        self.write("together.toml", together)
        self.run_set("together.h5", sweep="together.toml")
        expected = {}
        for stop in (1.5, 2, 2.5):
            self.write("alone.toml", together.replace("[2.5, 1.5, 2]", str(stop)))
            self.run_set("alone.h5", "--force", sweep="alone.toml")
            with h5py.File(self.folder / "alone.h5") as file:
                expected.update(zip(file["index/id"][()], file["index/sha256"][()]))
        with h5py.File(self.folder / "together.h5") as file:
            self.assertEqual(dict(zip(file["index/id"][()], file["index/sha256"][()])), expected)
            self.assertEqual(list(file["index/stop-coordination"]), [2.5, 2.5, 1.5, 1.5, 2, 2])
        self.write("some.toml", together.replace("[2.5, 1.5, 2]", "2"))
        self.run_set("some.h5", sweep="some.toml")
        self.write("some.toml", together)
        self.assertEqual(self.run_set("some.h5", sweep="some.toml")["computed"], 4)
        self.assertEqual(self.succeed_json("dataset", "verify", "some.h5")["structures"], 6)

    def test_structure_is_that_of_the_verbs(self):
        self.run_set()
        self.succeed("generate", "vem", "--particles", 60, "--voids", 30, "--volume-fraction", 0.4, "--radius", "0.25um", "--seed", 2, "-o", "a.h5")
        self.succeed("characterize", "a.h5", "--only", "coordination,doh")
        self.succeed("shear", "a.h5", "--shear-stiffness", 50)
        single = {name: value for name, value in values(self.folder / "a.h5").items() if not name.startswith("provenance")}
        with h5py.File(self.folder / "set.h5") as file:
            index = file["index"]
            row = next(k for k in range(ROWS) if (index["voids"][k], index["seed"][k], index["shear-stiffness"][k]) == (30, 2, 50))
            prefix = f"structures/{index['id'][row].decode()}/"
        in_set = {name[len(prefix):]: value for name, value in values(self.folder / "set.h5").items()
                  if name.startswith(prefix) and not name.startswith(prefix + "provenance")}
        self.assertEqual(single, in_set)

    def test_bytes_do_not_depend_on_jobs(self):
        for jobs in (1, 2, 5):
            self.run_set(f"{jobs}.h5", "--jobs", jobs)
        self.assertEqual(len({checksum(self.folder / f"{jobs}.h5") for jobs in (1, 2, 5)}), 1)

    def test_killed_runs_go_on(self):
        self.run_set("whole.h5")
        rng = random.Random(1)
        for _ in range(20):
            call = subprocess.Popen([PROGRAM, "dataset", "run", "sweep.toml", "-o", "set.h5", "--jobs", "2", "--quiet"], cwd=self.folder,
                                    start_new_session=True)
            time.sleep(rng.uniform(0.0, 0.4))
            os.killpg(call.pid, signal.SIGKILL)
            call.wait()
        found = self.run_set("set.h5")
        self.assertEqual(found["failed"], 0)
        self.assertEqual(values(self.folder / "set.h5"), values(self.folder / "whole.h5"))
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if not name.startswith(".")), ["set.h5", "sweep.toml", "whole.h5"])

    def test_full_disk_loses_nothing(self):
        self.run_set("whole.h5")
        size = (self.folder / "whole.h5").stat().st_size
        self.assertGreater(size, 2**20, "the set is built in steps of a megabyte")
        for room in (size // 2, size - 1):
            done = subprocess.run([PROGRAM, "dataset", "run", "sweep.toml", "-o", "set.h5", "--quiet"], cwd=self.folder, text=True,
                                  capture_output=True, preexec_fn=lambda room=room: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room)))
            self.assertEqual((done.returncode, done.stderr), (1, "coagula: cannot write set.h5: File too large\n"))
            self.assertEqual(sorted(os.listdir(self.folder)), ["set.h5.parts", "sweep.toml", "whole.h5"])
        self.assertEqual(self.run_set()["computed"], 0)
        self.assertEqual(checksum(self.folder / "set.h5"), checksum(self.folder / "whole.h5"))

    def test_ids_stay_in_later_versions(self):
        """Options that a sweep does not give have no part in them, so that a new one does not make all structures anew."""
        self.run_set("set.h5")
        with h5py.File(self.folder / "set.h5") as file:
            self.assertEqual([name.decode() for name in file["index/id"][:2]], ["e21ac4074d533334", "a260fae2647e78d7"])

    def test_what_killed_runs_leave_behind_goes(self):
        parts = self.folder / "set.h5.parts"
        parts.mkdir()
        for name in (".0123.json.lock", ".0123.h5.lock", ".0123.h5.a1b2c3.tmp"):
            (parts / name).write_text("")
        self.run_set()
        self.assertFalse(parts.exists())
        parts.mkdir()
        (parts / "notes.txt").write_text("not ours")
        self.run_set()
        self.assertEqual(os.listdir(parts), ["notes.txt"])

    def test_finished_structures_are_kept(self):
        self.run_set()
        before = (self.folder / "set.h5").read_bytes()
        self.assertEqual(self.run_set()["computed"], 0)
        self.assertEqual((self.folder / "set.h5").read_bytes(), before)

    def test_deleted_structure_alone_is_computed_again(self):
        self.run_set()
        before = values(self.folder / "set.h5")
        with h5py.File(self.folder / "set.h5", "r+") as file:
            del file["structures"][sorted(file["structures"])[3]]
        self.fail_with(2, "dataset", "verify", "set.h5", says=["set.h5", "is missing"])
        self.assertEqual(self.run_set()["computed"], 1)
        self.assertEqual(values(self.folder / "set.h5"), before)

    def test_added_values_alone_are_computed(self):
        self.run_set()
        self.write("sweep.toml", SWEEP.replace("[10, 30]", "[10, 20, 30]"))
        self.assertEqual(self.run_set()["computed"], 6)
        self.run_set("whole.h5")
        self.assertEqual(values(self.folder / "set.h5"), values(self.folder / "whole.h5"))

    def test_fewer_values_need_force(self):
        self.run_set()
        self.write("sweep.toml", SWEEP.replace("[10, 30]", "30"))
        self.fail_with(2, "dataset", "run", "sweep.toml", "-o", "set.h5", says=["set.h5", "6 structures", "--force"])
        self.assertEqual(self.run_set("set.h5", "--force")["computed"], 0)

    def test_failures_are_recorded(self):
        self.write("sweep.toml", SWEEP.replace("voids = [10, 30]", "voids = [10, 30]\ntarget-coordination = [4.69, 0.5]"))
        found = self.run_set()
        self.assertEqual((found["structures"], found["failed"]), (2 * ROWS, ROWS))
        with h5py.File(self.folder / "set.h5") as file:
            failed = [k for k, status in enumerate(file["index/status"][()]) if status == b"failed"]
            self.assertEqual(len(failed), ROWS)
            self.assertTrue(all(file["index/message"][k] for k in failed))
            self.assertEqual(len(file["structures"]), ROWS)
        self.assertEqual(self.run_set()["computed"], 0)
        self.assertEqual(self.run_set("set.h5", "--retry-failed")["computed"], ROWS)

    def test_without_structures(self):
        self.run_set("set.h5", "--no-structures")
        self.run_set("whole.h5")
        with h5py.File(self.folder / "set.h5") as file, h5py.File(self.folder / "whole.h5") as whole:
            self.assertEqual(len(file["structures"]), 0)
            self.assertEqual(list(file["index/storage_modulus.mean"]), list(whole["index/storage_modulus.mean"]))
        self.succeed("dataset", "verify", "set.h5")

    def test_particles_alone(self):
        """structures = "particles": the table of a whole set, a fraction of its size, and files that the verbs take."""
        self.run_set("whole.h5")
        self.write("particles.toml", 'structures = "particles"\n' + SWEEP)
        self.succeed("dataset", "run", "particles.toml", "-o", "set.h5")
        whole, alone = self.folder / "whole.h5", self.folder / "set.h5"
        self.assertLess(alone.stat().st_size, 0.7 * whole.stat().st_size)
        with h5py.File(whole) as one, h5py.File(alone) as other:
            for name in ("doh.a", "storage_modulus.mean"):
                self.assertEqual(one["index"][name][:].tolist(), other["index"][name][:].tolist())
            for group in other["structures"].values():
                self.assertNotIn("characterization", group)
                self.assertNotIn("mechanics", group)
        self.succeed("dataset", "verify", "set.h5")
        self.assertEqual(self.succeed_json("dataset", "run", "particles.toml", "-o", "set.h5")["computed"], 0)
        self.fail_with(2, "dataset", "run", "particles.toml", "-o", "whole.h5", says=["whole.h5", "--force"])

    def test_structures_of_an_unknown_kind(self):
        self.write("sweep.toml", 'structures = "particle"\n' + SWEEP)
        self.fail_with(2, "dataset", "run", "sweep.toml", "-o", "set.h5", says=["sweep.toml", "'structures'", "did you mean 'particles'?"])

    def test_designs(self):
        varied = SWEEP.replace("voids = [10, 30]", "voids = { from = 5, to = 60, scale = 'log' }").replace("replicates = 3\n", "") \
                      .replace("0.4", "{ from = 0.3, to = 0.5 }").replace("[10, 50]", "10")
        for kind in ("latin-hypercube", "sobol"):
            with self.subTest(kind=kind):
                self.write("design.toml", varied + f"[design]\nkind = '{kind}'\nsamples = 8\n")
                self.run_set(f"{kind}.h5", sweep="design.toml")
                with h5py.File(self.folder / f"{kind}.h5") as file:
                    fractions = file["index/volume-fraction"][()]
                    layers = sorted(int((value - 0.3) / 0.2 * 8) for value in fractions)
                    if kind == "sobol":
                        self.assertEqual(sum(layer < 4 for layer in layers), 4)
                    else:
                        self.assertEqual(layers, list(range(8)))  # one point in each layer
                    self.assertEqual(file["index/voids"].dtype.kind, "i")

    def test_table(self):
        self.run_set()
        lines = self.succeed("dataset", "table", "set.h5").splitlines()
        self.assertEqual(len(lines), 1 + ROWS)
        self.assertIn("storage_modulus.mean [Pa]", lines[0])
        self.succeed("dataset", "table", "set.h5", "-o", "table.csv")
        self.assertEqual((self.folder / "table.csv").read_text().splitlines(), lines)

    def test_verify(self):
        self.run_set()
        self.assertEqual(self.succeed_json("dataset", "verify", "set.h5", "--sample", 2)["computed_again"], 2)
        with h5py.File(self.folder / "set.h5", "r+") as file:
            next(iter(file["structures"].values()))["characterization/doh/a"][...] = 1
        self.fail_with(2, "dataset", "verify", "set.h5", says=["set.h5", "checksum"])

    def test_chunks_join_to_the_whole(self):
        self.run_set("whole.h5")
        for number in (1, 2, 3):
            self.run_set(f"part{number}.h5", "--chunk", f"{number}/3")
        self.fail_with(2, "dataset", "join", "part1.h5", "part2.h5", "-o", "set.h5", says="lack")
        self.succeed("dataset", "join", "part1.h5", "part2.h5", "part3.h5", "-o", "set.h5")
        self.assertEqual(values(self.folder / "set.h5"), values(self.folder / "whole.h5"))

    def test_plan(self):
        found = self.succeed_json("dataset", "plan", "sweep.toml", "--jobs", 2)
        self.assertEqual((found["structures"], found["generated"], found["jobs"]), (ROWS, 6, 2))
        self.assertGreater(found["seconds"], 0)
        self.assertGreater(found["bytes"], 1e4)
        self.assertEqual(os.listdir(self.folder), ["sweep.toml"])

    def test_plan_where_some_structures_cannot_be_made(self):
        sweep = ('[[generate]]\nverb = "vem"\nparticles = 100\nvolume-fraction = 0.2\nradius = "1um"\n'
                 'voids = [{}]\ntarget-coordination = 4.5\nreplicates = 2\n')
        self.write("some.toml", sweep.format("10, 500"))
        self.write("none.toml", sweep.format("500"))
        found = self.succeed_json("dataset", "plan", "some.toml")
        self.assertEqual(found["structures"], 4)
        self.assertGreater(found["bytes"], 1e4)
        self.assertIn("2 of 4 structures", found["notes"][0])
        self.assertIn("--voids 500", found["notes"][0])
        self.assertEqual(self.succeed_json("dataset", "run", "some.toml", "-o", "some.h5")["failed"], 2)
        self.fail_with(2, "dataset", "plan", "none.toml", says="cannot reach a coordination of 4.5")

    def test_plan_runs_a_trajectory_once(self):
        sweep = ('[[generate]]\nverb = "brownian"\nparticles = 100\nvolume-fraction = 0.4\nradius = "0.25um"\n'
                 'surface-potential = "0mV"\nsample-interval = "0.02ms"\nstop-coordination = [{}]\n')
        self.write("one.toml", sweep.format("4"))
        self.write("ten.toml", sweep.format(", ".join(str(3 + 0.1 * k) for k in range(11))))
        one, eleven = (self.succeed_json("dataset", "plan", name, "--jobs", 1)["seconds"] for name in ("one.toml", "ten.toml"))
        self.assertLess(eleven, 4 * one)  # they only lie on it

    def test_a_set_is_no_structure(self):
        self.run_set("set.h5")
        for verb in ("info", "characterize", "shear"):
            self.fail_with(2, verb, "set.h5", says=["set.h5", "is a data set of many structures", "dataset table"])

    def test_foreign_files(self):
        self.copy_of_packing("set.h5")
        self.fail_with(2, "dataset", "run", "sweep.toml", "-o", "set.h5", says=["set.h5", "no data set"])
        self.fail_with(2, "dataset", "table", "set.h5", says=["set.h5", "no data set"])
        self.fail_with(2, "dataset", "run", "sweep.toml", "-o", "sweep.toml", says="sweep.toml")

    @unittest.skipIf(shutil.which("snakemake") is None, "snakemake is not installed (Debian: snakemake)")
    def test_workflow(self):
        self.run_set("whole.h5")
        self.succeed("dataset", "workflow", "sweep.toml", "-o", "flow", "--chunks", 3)
        environment = {**os.environ, "PATH": os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"], "HOME": str(self.folder)}
        done = subprocess.run(["snakemake", "--cores", "2", "--quiet"], cwd=self.folder / "flow", env=environment, capture_output=True,
                              text=True, timeout=250)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(values(self.folder / "flow" / "set.h5"), values(self.folder / "whole.h5"))


if __name__ == "__main__":
    unittest.main()
