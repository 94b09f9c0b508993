# SPDX-License-Identifier: GPL-3.0-or-later
"""The linear response by PETSc: what is refused, how its failures are told, and that it is the builtin one on any number of processes."""

import os
import shutil
import unittest
from pathlib import Path

import h5py
import numpy

from support import PROGRAM, ProgramTest

BY_PETSC = ["--engine", "petsc"]
SOLVER = Path(PROGRAM).with_name("coagula-petsc")
# Open MPI asks for these where the tests run as root, or on fewer processors than processes.
MPI = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMP_THREAD_LIMIT": "1"}


def needs_petsc(test):
    return unittest.skipUnless(SOLVER.exists() and shutil.which("mpirun"),
                               "coagula was built without PETSc (Debian: apt-get install libpetsc-real-dev openmpi-bin)")(test)


class PetscTest(ProgramTest):
    def packing(self, *words):
        self.succeed("generate", "vem", "--particles", "1000", "--voids", "500", "--volume-fraction", "0.4", "--radius", "0.25um", "--seed", "3",
                     "--quiet", "-o", "p.h5", *words)


class Refusals(PetscTest):
    def test_what_petsc_does_not_solve(self):
        self.packing()
        self.fail_with(2, "shear", "p.h5", *BY_PETSC, "--method", "dem", says="--engine petsc computes by --method linear only")
        self.fail_with(2, "shear", "p.h5", *BY_PETSC, "--frequency", "1Hz", says="--frequency is not read with --engine petsc")
        self.fail_with(2, "shear", "p.h5", *BY_PETSC, "--solver", "direct", says="--solver is not read with --engine petsc")

    def test_a_program_that_is_missing_or_fails(self):
        self.packing()
        before = (self.folder / "p.h5").read_bytes()
        self.fail_with(2, "shear", "p.h5", *BY_PETSC, "--engine-command", "mpirun-of-nobody -n 2 coagula-petsc",
                       says=["there is no program mpirun-of-nobody", "libpetsc-real-dev"])
        for commands, says in (("exit 0", "the solver left no complete solution"),
                               ("echo There are not enough slots; exit 1", "PETSc failed: There are not enough slots"),
                               ("echo ERROR: too close >&2; exit 1", "PETSc failed: ERROR: too close")):
            self.write("solver", f"#!/bin/sh\n{commands}\n").chmod(0o755)
            self.fail_with(1, "shear", "p.h5", *BY_PETSC, "--engine-command", "./solver", says=says)
        self.assertEqual((self.folder / "p.h5").read_bytes(), before)


    def test_a_coagula_that_mpirun_has_started_twice(self):
        self.packing()
        for variable in ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"):
            self.fail_with(2, "shear", "p.h5", *BY_PETSC, says=["was started 2 times at once", variable], env={**os.environ, variable: "2"})


@needs_petsc
class Response(PetscTest):
    def moduli(self, *words, processes=0):
        engine = [*BY_PETSC, "--engine-command", f"mpirun -n {processes} coagula-petsc"] if processes else ["--solver", "direct"]
        found = self.succeed_json("shear", "p.h5", *words, *engine, "-o", f"{processes}.h5", "--force", env=MPI)
        self.assertEqual(found["solver"], "petsc" if processes else "direct")
        return numpy.array(found["elastic_tensor"])

    def compare(self, *words):
        exact = self.moduli(*words)
        for processes in (1, 2, 4):
            found = self.moduli(*words, "--modulus-tolerance", "1e-7", processes=processes)
            self.assertLess(numpy.abs(found - exact).max(), 1e-6 * numpy.abs(exact).max(), f"{processes} processes")
        return exact

    def test_is_the_builtin_one_on_any_number_of_processes(self):
        self.packing()
        self.compare()
        with h5py.File(self.folder / "0.h5") as exact, h5py.File(self.folder / "4.h5") as found:
            # Not the motions: what has no stiffness may lie anywhere.
            for name in ("xy/bonds/normal_force", "yz/bonds/shear_force"):
                forces, others = (file[f"mechanics/linear/load_structure/{name}"][:] for file in (exact, found))
                self.assertLess(numpy.linalg.norm(others - forces), 0.005 * numpy.linalg.norm(forces))

    def test_bending_and_spheres_of_unlike_size(self):
        self.packing("--size-distribution", "lognormal:0.3")
        self.write("model.toml", "normal_stiffness = 100\nshear_stiffness = 1\nbending_stiffness = 1e-13\ntwisting_stiffness = 1e-13\n")
        self.compare("--model", "model.toml")

    def test_a_sample_with_a_free_surface(self):
        self.packing()
        self.succeed("export", "p.h5", "--format", "csv", "-o", "p.csv")
        self.succeed("import", "p.csv", "--open", "-o", "p.h5", "--force")
        self.compare()

    def test_the_file_names_the_engine(self):
        self.packing()
        self.moduli(processes=2)
        self.assertRegex(self.succeed("info", "2.h5"), r"PETSc 3\.\d+\.\d+, 2 processes")


if __name__ == "__main__":
    unittest.main()
