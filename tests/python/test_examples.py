# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked examples from Python: every number is that of the program, bit for bit, and so is every data set of the files.

Files hold positions in nm, so a packing that was read differs from that in memory by one rounding: both sides start from the file."""

import math
import unittest

import h5py
import numpy as np

import coagula
from support import DATASETS, VEM, ModuleTest, options

LOSSES = {"normal_springpot_stiffness": 12, "normal_springpot_time": "0.159 s", "normal_springpot_exponent": 0.08,
          "shear_springpot_stiffness": 1.2, "shear_springpot_time": 0.159, "shear_springpot_exponent": 0.08,
          "solvent_viscosity": "1 mPa.s"}
SUSPENSION = {"particles": 100, "volume_fraction": 0.3, "radius": "0.25um", "surface_potential": "10mV", "stop_time": "0.2ms",
              "snapshots": "0.1ms", "seed": 2}


def datasets_of(path):
    """Values and attributes of all data sets, the history apart."""
    found = {}

    def keep(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance"):
            found[name] = (item[()], item.attrs.get("unit"), item.attrs.get("description"))

    with h5py.File(path) as file:
        file.visititems(keep)
    return found


class Examples(ModuleTest):
    def assert_equal_files(self, one, other):
        first, second = datasets_of(one), datasets_of(other)
        self.assertEqual(first.keys(), second.keys())
        for name, (value, *words) in first.items():
            np.testing.assert_array_equal(value, second[name][0], name)
            self.assertEqual([str(word) for word in words], [str(word) for word in second[name][1:]], name)

    def test_generate_characterize_shear(self):
        generated = self.program("generate", "vem", *options(VEM), "-o", "a.h5")
        characterized = self.program("characterize", "a.h5")
        sheared = self.program("shear", "a.h5", "--normal-stiffness", "80N/m")
        made = coagula.generate_vem(**VEM)
        read = coagula.read("a.h5")
        measured = coagula.characterize(read)
        response = coagula.shear(read, normal_stiffness="80N/m")
        self.assert_same(generated, made)
        self.assert_same(characterized, measured)
        self.assert_same(sheared, response)
        coagula.write("b.h5", made, measured, response)
        self.assert_equal_files("a.h5", "b.h5")
        self.assertAlmostEqual(coagula.characterize(made).doh.a, measured.doh.a, delta=1e-8)
        read = coagula.read("a.h5")
        self.assert_same(characterized, read.characterization)
        self.assert_same(sheared, read.mechanics.linear)
        self.assertEqual([entry["stage"] for entry in read.history], ["generate vem", "characterize", "shear"])

    def test_import_of_a_measured_packing(self):
        # The centres of a pile of ball bearings, a sphere of them from its middle, in units of the radius.
        pile = np.loadtxt(DATASETS / "finney_pack" / "finney.csv", delimiter=",", skiprows=1, usecols=(1, 2, 3))
        inside = pile[np.linalg.norm(pile - pile.mean(axis=0), axis=1) < 14]
        np.savetxt("pile.csv", inside, delimiter=",", header="x,y,z", comments="")
        imported = self.program("import", "pile.csv", "--length-unit", "1mm", "--radius", "1mm", "--open", "-o", "pile.h5")
        measured = self.program("characterize", "pile.h5", "--contact-tolerance", "0.02", "--only", "coordination,overlap,pores,doh")
        sheared = self.program("shear", "pile.h5", "--bond-tolerance", "0.02")
        pile = coagula.read("pile.csv", length_unit="1mm", radius="1mm", open=True)
        self.assertEqual(imported["particles"], len(pile.packing))
        coagula.write("again.h5", pile)
        np.testing.assert_array_equal(coagula.read("again.h5").packing.positions, coagula.read("pile.h5").packing.positions)
        pile = coagula.read("pile.h5")
        # Not every measure: of an open packing the last digits of the error of pair_correlation/contact_peak change from call to call.
        names = ["coordination", "overlap", "pores", "doh"]
        self.assert_same(measured, coagula.characterize(pile, contact_tolerance=0.02, only=names))
        self.assert_same(sheared, coagula.shear(pile, bond_tolerance=0.02))
        # The same from an array: a free surface where no box is given.
        packing = coagula.Packing(1e-3 * np.loadtxt("pile.csv", delimiter=",", skiprows=1), 1e-3)
        self.assertFalse(packing.periodic)
        self.assertAlmostEqual(coagula.characterize(packing, contact_tolerance=0.02).coordination, measured["coordination"], delta=1e-9)

    def test_frequency_sweep(self):
        lines = [f'{name} = "{value}"' if isinstance(value, str) else f"{name} = {value!r}" for name, value in LOSSES.items()]
        (self.folder / "model.toml").write_text("\n".join(lines) + "\n")
        coagula.write("a.h5", self.made())
        made = coagula.read("a.h5")
        said = self.program("shear", "a.h5", "--frequency-sweep", "0.1Hz:1kHz:5", "--model", "model.toml")
        for model in (LOSSES, "model.toml"):
            swept = coagula.shear(made, frequency_sweep="0.1Hz:1kHz:5", model=model)
            self.assert_same(said, swept)
        one = coagula.shear(made, frequency=[swept.frequency[1]], model=LOSSES)
        self.assertAlmostEqual(one.storage_modulus.mean, swept.storage_modulus.mean[1], delta=1e-6 * one.storage_modulus.mean)

    def test_brownian_run(self):
        said = self.program("generate", "brownian", *options(SUSPENSION), "-o", "a.h5")
        run = coagula.generate_brownian(**SUSPENSION)
        said_of_structure = {name: said.pop(name) for name in ("particles", "volume_fraction", "seed")}
        self.assert_same(said, run)
        self.assertEqual(said_of_structure["volume_fraction"], run.packing.volume_fraction)
        self.assertEqual(len(run.frames), 1)
        self.assertAlmostEqual(run.frames[0][0], 1e-4, delta=1e-5)
        self.assertEqual(run.frames[0][1].shape, (100, 3))
        coagula.write("b.h5", run)
        self.assert_equal_files("a.h5", "b.h5")
        # Going on from there.
        again = {**SUSPENSION, "start": coagula.read("b.h5"), "stop_time": 1e-5, "snapshots": None}
        for name in ("particles", "volume_fraction", "radius"):
            del again[name]
        self.program("generate", "brownian", "--start", "b.h5", "--surface-potential", "10mV", "--stop-time", "1e-5", "--seed", "2",
                     "-o", "c.h5")
        coagula.write("d.h5", coagula.generate_brownian(**again))
        self.assert_equal_files("c.h5", "d.h5")

    def test_diagnosis(self):
        coagula.write("structure.h5", self.made(particles=150, voids=75))
        other = self.made(particles=150, voids=75, seed=9)
        swept = coagula.shear(other, frequency_sweep="0.1Hz:100Hz:12", model=LOSSES)
        with open("sweep.csv", "w", encoding="utf-8") as file:
            file.write("frequency [Hz],storage_modulus [Pa],loss_modulus [Pa]\n")
            for k, frequency in enumerate(swept.frequency):
                error = 1 + 0.02 * math.sin(2.4 * k)
                file.write(f"{frequency},{error * swept.storage_modulus.mean[k]},{swept.loss_modulus.mean[k] / error}\n")
        with open("experiment.toml", "w", encoding="utf-8") as file:
            file.write('title = "losses"\n[sample]\nparticle_radius = "0.25 um"\n[structures]\nfiles = ["structure.h5"]\n'
                       '[[measurement]]\nkind = "frequency-sweep"\nfile = "sweep.csv"\nsample = "one"\n')
        few = {"bootstrap": 99, "causes": "contact-loss"}
        said = self.program("diagnose", "experiment.toml", "-o", "folder", *options(few))
        found = coagula.diagnose("experiment.toml", **few)
        self.assert_same(said, found)
        self.assertTrue(found.detected)
        self.assertEqual(found.causes[0].name, "contact-loss")
        kept = coagula.diagnose("experiment.toml", output="kept", **few)
        self.assertEqual(kept.p_value, found.p_value)
        self.assertTrue((self.folder / "kept" / "report.html").exists())


class OtherMethods(ModuleTest):
    def test_quasistatic(self):
        coagula.write("a.h5", self.made(particles=100, voids=50))
        made = coagula.read("a.h5")
        said = self.program("shear", "a.h5", "--method", "quasistatic", "--amplitudes", "1e-4,1e-3", "--steps-per-cycle", "8",
                            "--orientation", "zx")
        found = coagula.shear(made, method="quasistatic", amplitudes=[1e-4, 1e-3], steps_per_cycle=8, orientation="zx")
        self.assert_same(said, found)

    def test_dem(self):
        coagula.write("a.h5", self.made(particles=100, voids=50))
        made = coagula.read("a.h5")
        said = self.program("shear", "a.h5", "--method", "dem", "--oscillations", "1", "--steps-per-oscillation", "1000", "--orientation",
                            "zx")
        found = coagula.shear(made, method="dem", oscillations=1, steps_per_oscillation=1000, orientation=["zx"])
        self.assert_same(said, found)

    def test_calibration(self):
        for name, voids in (("a.h5", 100), ("b.h5", 50)):
            coagula.write(name, self.made(voids=voids))
        structures = [coagula.read(name) for name in ("a.h5", "b.h5")]
        said = self.program("calibrate", "a.h5", "b.h5", "--from", "60N/m", "--steps", "3", "--measured", "1MPa,1.2MPa")
        found = coagula.calibrate(structures, from_="60N/m", steps=3, measured=["1MPa", 1.2e6])
        for structure in said["structures"]:
            del structure["file"]
        self.assert_same(said, found)

    def test_power_law(self):
        a, modulus = [0.42, 0.44, 0.47, 0.51, 0.55], [5e5, 7.3e5, 1.02e6, 1.5e6, 1.97e6]
        with open("moduli.csv", "w", encoding="utf-8") as file:
            file.write("a,modulus [Pa]\n" + "".join(f"{x!r},{y!r}\n" for x, y in zip(a, modulus)))
        self.assert_same(self.program("fit", "power-law", "moduli.csv"), coagula.fit_power_law(a, modulus))

    def test_fit_of_a_curve(self):
        measured = coagula.characterize(self.made(), only=["doh", "pores"])
        fit = coagula.fit_degree_of_heterogeneity(measured.pore_curve.radius, measured.pore_curve.exclusion_probability, "0.25um")
        self.assertAlmostEqual(fit.a, measured.doh.a, delta=1e-9)

    def test_comparison(self):
        for name, seed in (("one.h5", 1), ("other.h5", 2)):
            coagula.write(name, self.made(seed=seed))
        one, other = coagula.read("one.h5"), coagula.read("other.h5")
        printed = self.program("characterize", "one.h5", "other.h5", "--compare", "--seed", "3")
        found = coagula.compare_heterogeneity(one, other, names=("one.h5", "other.h5"), seed=3)
        self.assert_same(printed, found)
        self.assertIn(found.agreement, ("all", "some", "none", "disagree"))
        with self.assertRaisesRegex(coagula.InputError, "names must be two texts"):
            coagula.compare_heterogeneity(one, other, names=("one.h5",))

    def test_each_measure_alone(self):
        made = self.made()
        for measure in ("coordination", "overlap", "doh"):
            self.assertIn(measure, coagula.characterize(made, only=measure))


if __name__ == "__main__":
    unittest.main()
