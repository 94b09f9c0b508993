# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors are Python exceptions with the sentence of the program."""

import re
import unittest
from pathlib import Path

import coagula
from support import VEM, ModuleTest, options


class Sentences(ModuleTest):
    def test_values(self):
        for change in ({"radius": "1s"}, {"particles": 2}, {"volume_fraction": 0.7}, {"radius": 0.25}, {"size_distribution": "normal:x"},
                       {"target_coordination": "nan"}):
            given = {**VEM, **change}
            done = self.run_program("generate", "vem", *options(given), "-o", "a.h5")
            self.assertEqual(done.returncode, 2)
            with self.assertRaises(coagula.InputError) as raised:
                coagula.generate_vem(**given)
            said = done.stderr.replace("coagula generate vem needs", "generate_vem() needs")
            said = said.replace("'coagula generate vem --help'", "help(coagula.generate_vem)")
            for name in given:
                said = said.replace("--" + name.replace("_", "-"), name)
            self.assertEqual(f"coagula: {raised.exception}\n", said)
            self.assertNotIn("--", str(raised.exception))
            self.assertIsInstance(raised.exception, ValueError)

    def test_arguments_are_named_as_python_names_them(self):
        made = self.made(particles=100, voids=50)
        for call, says in (
                (lambda: coagula.shear(made, normal_stiffness="1s"), "^normal_stiffness: .*see help\\(coagula.shear\\)"),
                (lambda: coagula.shear(made, amplitudes=[1e-3], ramp=0.01, method="quasistatic"), "^amplitudes and ramp exclude"),
                (lambda: coagula.shear(made, method="dem", frequency=[1, 2]), "^method='dem' runs at one frequency"),
                (lambda: coagula.shear(made, orientation="xx", method="quasistatic"), "^orientation: 'xx' "),
                (lambda: coagula.calibrate([made], from_=100, to="10N/m"), "^from_ is 100 N/m and to 10 N/m"),
                (lambda: coagula.characterize(made, only="--samples"), "^only: '--samples' is not one of"),
                (lambda: coagula.generate_brownian(particles=30), "^generate_brownian\\(\\) needs [a-z_]+"),
                (lambda: coagula.compare_heterogeneity(made, made, radii="x"), "see help\\(coagula.compare_heterogeneity\\)"),
                (lambda: coagula.characterize(made, threads=0), "^threads: '0' is out of range")):
            with self.assertRaisesRegex(coagula.InputError, says):
                call()
        Path("centres.csv").write_text("x,y,z\n1,1,1\n3,1,1\n")
        with self.assertRaisesRegex(coagula.InputError, "give length_unit|give radius"):
            coagula.read("centres.csv")
        coagula.write("a.h5", made)
        with self.assertRaisesRegex(coagula.ExistingFileError, "a.h5 exists already; give overwrite=True"):
            coagula.write("a.h5", made)
        for name in coagula.__all__:
            about = re.sub(r"`[^`]*`", "", getattr(coagula, name).__doc__)  # commands of the program apart
            self.assertNotRegex(about, r"--[a-z]", name)

    def test_old_names_of_arguments(self):
        made = self.made(particles=100, voids=50)
        call = {"method": "quasistatic", "amplitudes": [1e-6], "orientation": "zx"}
        with self.assertWarnsRegex(FutureWarning, "^down is called reverse now") as warned:
            old = coagula.shear(made, down=True, **call)
        self.assertEqual(Path(warned.filename).name, "test_errors.py")
        self.assertEqual(list(old.amplitude), list(coagula.shear(made, reverse=True, **call).amplitude))
        self.assertEqual(len(old.amplitude), 2)
        with self.assertRaisesRegex(TypeError, "down is the old name of reverse"):
            coagula.shear(made, down=True, reverse=True, **call)

    def test_tolerance_of_contacts(self):
        made = self.made(particles=100, voids=50)
        self.assertEqual(len(coagula.find_contacts(made, 0.01)), len(made.bonds))
        for tolerance in (100, 1e300, -0.5, float("nan"), float("inf")):
            with self.assertRaisesRegex(coagula.InputError, "^tolerance is .*must be 0 .. 1"):
                coagula.find_contacts(made, tolerance)

    def test_radii_beside_what_they_replace(self):
        radii = [1e-7] * 100
        for given, says in (({"particles": 60}, "particles is 60, but 100 radii are given"), ({"radius": "1um"}, "radius is not read"),
                            ({"size_distribution": "normal:0.1"}, "size_distribution is not read")):
            with self.assertRaisesRegex(coagula.InputError, says):
                coagula.generate_vem(radii=radii, volume_fraction=0.4, **given)
            with self.assertRaisesRegex(coagula.InputError, says):
                coagula.generate_brownian(radii=radii, volume_fraction=0.2, surface_potential="15mV", stop_time="1us", **given)
        self.assertEqual(len(coagula.generate_vem(radii=radii, particles=100, volume_fraction=0.3).packing), 100)

    def test_start_beside_what_it_replaces(self):
        made = self.made(particles=100, voids=50)
        for given in ({"particles": 100}, {"volume_fraction": 0.4}, {"equilibration_time": 1e-6}):
            with self.assertRaisesRegex(coagula.InputError, "is not read where the run goes on from a packing"):
                coagula.generate_brownian(start=made, surface_potential="15mV", stop_time="1us", **given)

    def test_model(self):
        made = self.made(particles=100, voids=50)
        with self.assertRaisesRegex(coagula.InputError, "model has normal_viscosity, a loss that acts at a frequency only"):
            coagula.shear(made, model={"normal_viscosity": "1e-6 N.s/m"})
        with self.assertRaisesRegex(coagula.InputError, "^model.*stiffnes"):
            coagula.shear(made, model={"normal_stiffnes": 1})

    def test_unknown_names_and_types(self):
        with self.assertRaisesRegex(TypeError, "generate_vem\\(\\) has no argument 'partcles'; did you mean 'particles'"):
            coagula.generate_vem(partcles=3)
        with self.assertRaises(TypeError):
            coagula.shear("packing.h5")
        with self.assertRaises(TypeError):
            coagula.generate_vem(**{**VEM, "radius": object()})
        with self.assertRaises(TypeError):
            coagula.generate_brownian(heterogeneity=1)

    def test_arrays(self):
        for positions, radii, says in (([[0, 0]], 1, "shape"), ([[0.0, 0, 0]], [1, 2], "radii"), ([[0.0, 0, 0], [0, 0, float("nan")]], 1, "finite"),
                                       ([[0.0, 0, 0], [1, 1, 1]], -1, "radius"), ([[0.0, 0, 0], [0, 0, 0]], 1, "centre")):
            with self.assertRaisesRegex(coagula.InputError, says):
                coagula.Packing(positions, radii, box=3)
        with self.assertRaises(coagula.InputError):
            coagula.Packing([[5.0, 1, 1]], 1, box=3)  # outside
        with self.assertRaises(coagula.InputError):
            coagula.fit_degree_of_heterogeneity([0, 1], [1, 0], 1)

    def test_files(self):
        with self.assertRaises(FileNotFoundError) as raised:
            coagula.read("none.h5")
        self.assertIsInstance(raised.exception, coagula.InputError)
        self.assertEqual(f"coagula: {raised.exception}\n", self.run_program("info", "none.h5").stderr)
        self.assertEqual(raised.exception.filename, "none.h5")
        with self.assertRaises(FileNotFoundError):
            coagula.read("none.xyz")
        (self.folder / "bad.h5").write_bytes(b"no file of HDF5")
        with self.assertRaises(coagula.InputError) as raised:
            coagula.read("bad.h5")
        self.assertNotIsInstance(raised.exception, OSError)
        self.assertEqual(f"coagula: {raised.exception}\n", self.run_program("info", "bad.h5").stderr)
        made = self.made(particles=100, voids=50)
        coagula.write("a.h5", made)
        with self.assertRaises(FileExistsError):
            coagula.write("a.h5", made)
        coagula.write("a.h5", made, overwrite=True)
        with self.assertRaises(coagula.InputError):
            coagula.write("none/a.h5", made)
        with self.assertRaises(coagula.InputError):
            coagula.write("a.doc", made)

    def test_diagnosis(self):
        (self.folder / "experiment.toml").write_text("title = 1\n")
        with self.assertRaises(coagula.InputError) as raised:
            coagula.diagnose("experiment.toml")
        done = self.run_program("diagnose", "experiment.toml", "-o", "folder")
        self.assertEqual(f"coagula: {raised.exception}\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
