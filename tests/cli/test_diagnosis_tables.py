# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose on structure series, coordinates, rough plates, a Newtonian oil and a cone: what stands in diagnosis.json, and bad values refused."""

import math
import random
import unittest

from diagnosis_support import PLATES, STIFFNESS, Tables


class StructureSeries(Tables):
    """Each row is predicted with the structures of its group, whatever their order."""

    COORDINATIONS = (4.3, 4.5, 4.7, 4.9, 5.1)
    GROUPS = (5, 2, 2, 4, 1, 3)  # of the files, two for the second row

    def setUp(self):
        super().setUp()
        for k, group in enumerate(self.GROUPS):
            self.structure(f"{k}.h5", k + 1, coordination=self.COORDINATIONS[group - 1])

    def experiment(self, groups, more=""):
        files = ", ".join(f'"{k}.h5"' for k in range(len(self.GROUPS)))
        return (f"[structures]\nfiles = [{files}]\n{groups}\n\n"
                f'[[measurement]]\nkind = "structure-series"\nfile = "series.csv"\n{more}')

    def test_rows_are_those_of_their_group(self):
        of_group = {}
        for k, group in enumerate(self.GROUPS):
            of_group.setdefault(group, []).append(self.modulus(f"{k}.h5"))
        means = {group: sum(moduli) / len(moduli) for group, moduli in of_group.items()}
        # The rows upside down, with the number of their structures in a column.
        rows = [(self.COORDINATIONS[group - 1], STIFFNESS / 100 * means[group] * (1 + 0.02 * (-1)**group), group)
                for group in (5, 4, 3, 2, 1)]
        self.table("series.csv", ("coordination", "storage_modulus [Pa]", "structure"), rows)
        found = self.diagnosis(self.experiment(f"groups = {list(self.GROUPS)}"))
        self.assertEqual((found["verdict"], found["observations"]), ("no-discrepancy", 5))
        stiffness = found["base"]["parameters"]["normal_stiffness"]
        self.assertTrue(stiffness["low"] < STIFFNESS < stiffness["high"])
        for k, row in enumerate(found["rows"]):
            self.assertEqual((row["row"], row["observable"]), (k + 1, "storage_modulus"))
            self.assertAlmostEqual(row["base"] / (stiffness["value"] / 100 * means[5 - k]), 1, delta=1e-6)
            self.assertGreater(row["standard_deviation"], 0.05 * row["measured"])  # the stated noise and what few structures leave
        # Two structures leave less uncertain than one: row 4 is the second group.
        self.assertLess(found["rows"][3]["standard_deviation"] / found["rows"][3]["measured"],
                        found["rows"][4]["standard_deviation"] / found["rows"][4]["measured"])

    def test_refusals(self):
        rows = [(coordination, 1e5 * coordination) for coordination in self.COORDINATIONS]
        self.table("series.csv", ("coordination [1]", "storage_modulus [Pa]"), rows)
        for groups, says in (
            ("", "a structure series needs structures.groups"),
            ("groups = [1, 2, 3]", "structures.groups has 3 numbers, but structures.files has 6 files"),
            ("groups = [0, 1, 2, 3, 4, 5]", "must be 1 or more"),
            ('groups = ["a"]', "must be a whole number or a list of them"),
            ("groups = [1, 2, 3, 4, 4, 4]", "series.csv: no structure stands for row 5, structure 5"),
        ):
            with self.subTest(groups=groups):
                self.refuse(self.experiment(groups), says)
        fraction = self.experiment("groups = [1, 2, 3, 4, 5, 5]", 'values = { structure = "2.5" }\n')
        self.refuse(fraction, "series.csv: column 'structure' is 2.5 in row 1, but must hold whole numbers")
        table = (self.folder / "series.csv").read_text().splitlines()
        numbered = [table[0] + ",structure"] + [f"{line},{'' if k == 2 else k + 1}" for k, line in enumerate(table[1:])]
        self.write("series.csv", "\n".join(numbered) + "\n")
        self.refuse(self.experiment("groups = [1, 2, 3, 4, 5, 5]"), "series.csv: column 'structure' must have a whole number in row 3")


class Coordinates(Tables):
    def setUp(self):
        super().setUp()
        self.copy_of_packing()
        self.structure("other.h5", 9, 600)
        self.succeed("export", "other.h5", "--format", "csv", "-o", "other.csv")

    def experiment(self, sample='[sample]\nparticle_radius = "0.25 um"\n', file="centres.csv"):
        return sample + f'\n[structures]\nfiles = ["packing.h5"]\n\n[[measurement]]\nkind = "coordinates"\nfile = "{file}"\n'

    def centres(self, sigma_plane, sigma_axis, seed=3):
        """The particles of a structure that the diagnosis does not know, as a microscope would find them."""
        number = random.Random(seed)
        rows = []
        for line in (self.folder / "other.csv").read_text().splitlines()[1:]:
            x, y, z, _ = map(float, line.split(","))
            rows.append((x + number.gauss(0, sigma_plane), y + number.gauss(0, sigma_plane), z + number.gauss(0, sigma_axis)))
        self.table("centres.csv", ("x [m]", "y [m]", "z [m]"), rows)

    def test_neighbours_of_sharp_centres_fit(self):
        self.centres(0, 0)
        found = self.diagnosis(self.experiment())
        self.assertEqual((found["verdict"], found["observations"]), ("no-discrepancy", 26))
        self.assertEqual({row["observable"] for row in found["rows"]}, {"neighbours_plane", "neighbours_axis"})
        overlaps, contacts = found["rows"][:2]  # the four empty shells below the contact, and that from 0.95 to 1.05 diameters
        self.assertTrue(1.7 < contacts["measured"] < 3 and abs(contacts["base"] / contacts["measured"] - 1) < 0.1)
        self.assertEqual((overlaps["measured"], contacts["row"] - overlaps["row"]), (0, 4))

    def test_errors_of_localisation_are_in_the_set(self):
        self.centres(5e-8, 1.2e-7)
        found = self.diagnosis(self.experiment())
        self.assertTrue(found["detected"])
        self.assertIn("localisation-error", found["credible_set"])
        self.assertIn(found["where"][0]["observable"], ("neighbours_plane", "neighbours_axis"))
        self.assertEqual(found["where"][0]["axis"], "distance")
        sigma = found["causes"][0]["parameters"]["sigma_axis"]
        self.assertTrue(0.7 * sigma["low"] < 1.2e-7 < 1.4 * sigma["high"])
        for row in found["rows"][4:5]:
            self.assertLess(abs(row["extended"] - row["measured"]), 0.3 * abs(row["base"] - row["measured"]))

    def images(self, *errors):
        """Images of the same particles as one table; errors in the plane and along z of each."""
        rows = []
        for frame, (plane, axis) in enumerate(errors):
            self.centres(plane, axis, seed=3 + frame)
            lines = (self.folder / "centres.csv").read_text().splitlines()[1:]
            rows += [(*map(float, line.split(",")), frame) for line in lines]
        self.table("centres.csv", ("x [m]", "y [m]", "z [m]", "frame"), rows)

    def test_images_of_the_same_particles_show_errors_alone(self):
        self.images((5e-8, 1.2e-7), (5e-8, 1.2e-7))
        found = self.diagnosis(self.experiment())
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["localisation-error"]))
        self.assertGreater(found["observations"], 30)
        for name, true in (("sigma_plane", 5e-8), ("sigma_axis", 1.2e-7)):
            sigma = found["causes"][0]["parameters"][name]
            self.assertTrue(0.9 * sigma["low"] < true < 1.1 * sigma["high"] and sigma["high"] < 1.5 * sigma["low"], sigma)
        where = [failure for failure in found["where"] if failure["axis"] == "frame"]
        self.assertEqual([failure["observable"] for failure in where][:2], ["localisation_plane", "localisation_axis"])
        self.assertIn("images of the same particles scatter", where[0]["sentence"])
        page = (self.folder / "results" / "report.html").read_text()
        self.assertIn("scatter of a centre in the plane", page)

    def test_the_same_image_twice_is_refused(self):
        self.centres(0, 0)
        header, *lines = (self.folder / "centres.csv").read_text().splitlines()
        twice = [line + f",{frame}" for frame in (1, 2) for line in lines]
        self.write("twice.csv", "\n".join([header + ",image", *twice]) + "\n")
        self.refuse(self.experiment(file="twice.csv"), "twice.csv", "have the same coordinates")
        self.write("words.csv", "\n".join([header + ",image", *(line + ",first" for line in lines)]) + "\n")
        self.refuse(self.experiment(file="words.csv"), "words.csv", "column 'frame' has no number")

    def test_refusals(self):
        self.centres(0, 0)
        self.refuse(self.experiment(sample=""), "0 usable numbers", "sample.particle_radius")
        self.refuse(self.experiment('[sample]\nparticle_radius = "0 um"\n'), "particle_radius")
        lines = (self.folder / "centres.csv").read_text().splitlines()
        self.write("flat.csv", "\n".join(",".join(line.split(",")[:2]) for line in lines) + "\n")
        self.refuse(self.experiment(file="flat.csv"), "flat.csv", "no column 'z'")
        self.write("few.csv", "\n".join(lines[:4]) + "\n")
        self.refuse(self.experiment(file="few.csv"), "few.csv", "3 usable rows are too few")
        self.write("inside.csv", "\n".join(lines[:40]) + "\n")
        self.refuse(self.experiment(file="inside.csv"), "20 particles lie deep enough inside")


class GapSeries(Tables):
    """Slip and an error of the gap, each shown by what only one of them does: rough plates, an oil."""

    GAPS = [2e-3 * 0.075**(k / 13) for k in range(14)]
    SMOOTH = '[[measurement]]\nkind = "gap-series"\nfile = "smooth.csv"\nsample = "one"\n'
    ROUGH = '[[measurement]]\nkind = "gap-series"\nfile = "rough.csv"\nsample = "two"\nrough_plates = true\n'
    OIL = '[[measurement]]\nkind = "gap-series"\nfile = "oil.csv"\nsample = "oil"\nfluid_viscosity = "1000 mPa.s"\n'

    def setUp(self):
        super().setUp()
        self.structure("known.h5", 1, 200)
        self.structure("other.h5", 2, 260)
        self.hidden = STIFFNESS / 100 * self.modulus("other.h5")

    def series(self, name, slip=0.0, gap_error=0.0, seed=1):
        """With a scatter of 2 %; the torque that the plates see, by the gap that the instrument believes in."""
        number = random.Random(seed)
        rows = []
        for gap in self.GAPS:
            seen = self.hidden * gap / (gap + gap_error)
            rows.append((gap, seen / (1 + 2 * seen * slip / gap) * (1 + number.gauss(0, 0.02))))
        self.table(name, ("gap [m]", "storage_modulus [Pa]"), rows)

    def oil(self, gap_error, frequency="1"):
        number = random.Random(8)
        lines = ["gap [m],frequency [Hz],loss_modulus [Pa]"]
        lines += [f"{gap},{frequency},{2 * math.pi * gap / (gap + gap_error) * (1 + number.gauss(0, 0.02))}" for gap in self.GAPS]
        return lines

    def experiment(self, *tables):
        return PLATES + '[structures]\nfiles = ["known.h5"]\n\n[noise]\nstated_relative = 0.02\n\n' + "".join(tables)

    def rows_of(self, found, measurement, model):
        return [row[model] for row in found["rows"] if row["measurement"] == measurement]

    def test_what_slips_at_smooth_plates_alone_is_slip(self):
        self.series("smooth.csv", slip=1.5e-10)
        self.series("rough.csv", seed=2)
        found = self.diagnosis(self.experiment(self.SMOOTH, self.ROUGH))
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["wall-slip"]))
        self.assertGreater(found["gain"]["rmse_ratio"], 2)
        slip = found["causes"][0]["parameters"]["slip_length_over_modulus"]
        self.assertTrue(slip["low"] / 1.5 < 1.5e-10 < slip["high"] * 1.5)
        smooth = self.rows_of(found, 1, "extended")
        rough = self.rows_of(found, 2, "extended")
        self.assertLess(smooth[-1], 0.8 * smooth[0])
        self.assertAlmostEqual(rough[-1] / rough[0], 1, delta=1e-9)
        # Were the same plates called smooth, slip could not explain both.
        called_smooth = self.diagnosis(self.experiment(self.SMOOTH, self.ROUGH.replace("true", "false")))
        self.assertNotEqual(called_smooth["credible_set"], ["wall-slip"])

    def test_what_an_oil_shows_too_is_the_gap(self):
        self.series("smooth.csv", gap_error=5e-5)
        self.write("oil.csv", "\n".join(self.oil(5e-5)) + "\n")
        found = self.diagnosis(self.experiment(self.SMOOTH, self.OIL))
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["gap-error"]))
        error = found["causes"][0]["parameters"]["gap_error"]
        self.assertTrue(error["low"] < 5e-5 < error["high"])
        for base in self.rows_of(found, 2, "base"):
            self.assertAlmostEqual(base, 2 * math.pi, delta=1e-6)  # angular frequency x viscosity, at every gap
        for extended, gap in zip(self.rows_of(found, 2, "extended"), self.GAPS):
            self.assertAlmostEqual(extended, 2 * math.pi * gap / (gap + error["value"]), delta=1e-4)

    def test_a_row_of_the_oil_without_a_frequency_is_not_used(self):
        self.series("smooth.csv")
        lines = self.oil(0)
        lines[3] = lines[3].replace(",1,", ",,")
        self.write("oil.csv", "\n".join(lines) + "\n")
        found = self.diagnosis(self.experiment(self.SMOOTH, self.OIL))
        self.assertEqual((found["verdict"], found["observations"]), ("no-discrepancy", 27))
        self.assertNotIn(3, [row["row"] for row in found["rows"] if row["measurement"] == 2])

    def test_refusals(self):
        self.series("smooth.csv")
        self.series("rough.csv")
        self.write("oil.csv", "\n".join(self.oil(0)) + "\n")
        for value, says in (("1", "key 'rough_plates': must be true or false"), ('"yes"', "key 'rough_plates': must be true or false")):
            with self.subTest(rough_plates=value):
                self.refuse(self.experiment(self.ROUGH.replace("true", value)), says)
        for value, says in (
            ('"50 degree"', "cone_angle is 0.8726646259971648, but must lie between 0 and pi/4 rad"),
            ("0", "cone_angle is 0, but must lie"),
            ('"1 mm"', "key 'cone_angle'"),
            ('"1 degree"', "rough.csv: a gap and a cone_angle are given, but under a cone the gap is not constant"),
        ):
            with self.subTest(cone_angle=value):
                self.refuse(self.experiment(self.ROUGH + f"cone_angle = {value}\n"), says)
        for value, says in (("0", "key 'oscillations': is 0, but must be a whole number >= 1"), ("1.5", "key 'oscillations'")):
            with self.subTest(oscillations=value):
                self.refuse(self.experiment(self.ROUGH + f"oscillations = {value}\n"), says)
        for value, says in (
            ("0", "measurement 2, key 'fluid_viscosity': must be > 0 Pa.s"),
            ('"-1 Pa.s"', "must be > 0 Pa.s"),
            ('"1 Pa"', "key 'fluid_viscosity'"),
            ("true", "key 'fluid_viscosity': must be a number"),
            ("inf", "key 'fluid_viscosity': must be finite"),
        ):
            with self.subTest(fluid_viscosity=value):
                self.refuse(self.experiment(self.SMOOTH, self.OIL.replace('"1000 mPa.s"', value)), says)
        self.write("oil.csv", "\n".join(line.replace("loss", "storage") for line in self.oil(0)) + "\n")
        self.refuse(self.experiment(self.SMOOTH, self.OIL), "oil.csv", "no column 'loss_modulus'")
        self.write("oil.csv", "\n".join(",".join(line.split(",")[::2]) for line in self.oil(0)) + "\n")
        self.refuse(self.experiment(self.SMOOTH, self.OIL), "oil.csv", "a Newtonian fluid needs 'angular_frequency' or 'frequency'")


class SettledSample(Tables):
    """Layers whose volume fraction grows downwards, explained by structures of two volume fractions."""

    GAPS = [(0.4 + 3.6 / 13 * k) * 1e-3 for k in range(14)]

    def experiment(self, files):
        return (PLATES + f"[sample]\nvolume_fraction = 0.4\n\n[structures]\nfiles = {files}\n\n[noise]\nstated_relative = 0.01\n\n"
                '[[measurement]]\nkind = "gap-series"\nfile = "gaps.csv"\n')

    def test_a_gradient_of_the_volume_fraction_is_found(self):
        self.structure("dilute.h5", 1, fraction=0.35)
        self.structure("dense.h5", 2, fraction=0.45)
        exponent = math.log(self.modulus("dense.h5") / self.modulus("dilute.h5")) / math.log(0.45 / 0.35)
        number = random.Random(4)
        rows = []
        for gap in self.GAPS:
            layers = [0.4 + 0.04 * gap / 1e-3 * ((k + 0.5) / 200 - 0.5) for k in range(200)]
            apparent = 1e5 * 200 / sum((0.4 / layer)**exponent for layer in layers)
            rows.append((gap, apparent * (1 + number.gauss(0, 0.01))))
        self.table("gaps.csv", ("gap [m]", "storage_modulus [Pa]"), rows)
        found = self.diagnosis(self.experiment(["dilute.h5", "dense.h5"]))
        self.assertEqual((found["verdict"], found["credible_set"]), ("named", ["volume-fraction-gradient"]))
        difference = found["causes"][0]["parameters"]["volume_fraction_difference"]
        self.assertTrue(0.9 * difference["low"] < 0.04 < 1.1 * difference["high"])
        self.assertGreater(found["gain"]["rmse_ratio"], 2)
        # One volume fraction does not say how the modulus depends on it.
        self.write("experiment.toml", self.experiment(["dense.h5"]))
        self.fail_with(2, "diagnose", "experiment.toml", "-o", "other", "--causes", "volume-fraction-gradient",
                       says="none of the causes asked for can show in this experiment")


class Cone(Tables):
    """A sweep under a cone in place of the upper plate."""

    SWEEP = '[structures]\nfiles = ["k.h5"]\n\n[[measurement]]\nkind = "amplitude-sweep"\nfile = "sweep.csv"\ncone_angle = "1 degree"\n'

    def setUp(self):
        super().setUp()
        self.structure("k.h5", 1)
        number = random.Random(5)
        self.table("sweep.csv", ("strain [1]", "storage_modulus [Pa]"), [(1e-4 * k, 2e5 * (1 + number.gauss(0, 0.02))) for k in range(1, 9)])

    def test_has_no_strain_field(self):
        self.write("experiment.toml", PLATES + self.SWEEP)
        self.fail_with(2, "diagnose", "experiment.toml", "-o", "results", "--causes", "plate-strain-field",
                       says=("none of the causes asked for can show in this experiment",))
        self.assertEqual(self.diagnosis(PLATES + self.SWEEP)["verdict"], "no-discrepancy")

    def test_takes_the_place_of_a_plate(self):
        for instrument in ("", '[instrument]\ngeometry = "cone-plate"\ncone_angle = "1 degree"\n\n'):
            with self.subTest(instrument=instrument):
                self.refuse(instrument + self.SWEEP, "sweep.csv: cone_angle is that of a cone in place of a plate", "not plate-plate")


class Waveforms(Tables):
    """An amplitude sweep with the waveforms of its rows: moduli that say nothing, harmonics that do."""

    STRAINS = [1e-4 * 1.5**k for k in range(8)]
    SWEEP = ('[structures]\nfiles = ["k.h5"]\n\n[noise]\nstated_relative = 0.02\nstated_sample = 0.01\n\n'
             '[[measurement]]\nkind = "amplitude-sweep"\nfile = "sweep.csv"\nsample = "A"\nvalues = { angular_frequency = "6 rad/s" }\n\n')
    WAVEFORM = '[[measurement]]\nkind = "waveform"\nfile = "{}.csv"\nsample = "A"\nvalues = {{ angular_frequency = "6 rad/s" }}\n\n'

    def setUp(self):
        super().setUp()
        self.structure("k.h5", 1)
        number = random.Random(7)
        self.table("sweep.csv", ("strain [1]", "storage_modulus [Pa]"), [(strain, 2e5 * (1 + number.gauss(0, 0.02))) for strain in self.STRAINS])

    def waveforms(self, third):
        """Elastic third harmonics of that part of the first."""
        number = random.Random(8)
        for k, strain in enumerate(self.STRAINS):
            phases = [2 * math.pi * (j + 1) / 256 for j in range(256)]
            self.table(f"wave{k}.csv", ("time [s]", "strain [1]", "stress [Pa]"),
                       [(phase / 6, strain * math.sin(phase), 2e5 * strain * (math.sin(phase) + third * math.sin(3 * phase) + number.gauss(0, 0.01)))
                        for phase in phases])
        return self.SWEEP + "".join(self.WAVEFORM.format(f"wave{k}") for k in range(len(self.STRAINS)))

    def rows(self, found, observable):
        return [row for row in found["rows"] if row["observable"] == observable]

    def test_straight_waveforms_say_nothing_more(self):
        found = self.diagnosis(self.waveforms(0))
        self.assertEqual(found["verdict"], "no-discrepancy")
        for observable in ("storage_modulus", "third_harmonic_storage", "third_harmonic_loss"):
            self.assertEqual(len(self.rows(found, observable)), len(self.STRAINS))  # each oscillation once
        self.assertEqual({row["base"] for row in self.rows(found, "third_harmonic_storage")}, {0})
        page = (self.folder / "results" / "report.html").read_text()
        self.assertIn("harmonics, sample", page)
        self.assertIn("Third harmonic of the stress", page)

    def test_a_third_harmonic_is_found_and_described(self):
        found = self.diagnosis(self.waveforms(-0.08))
        self.assertTrue(found["detected"])
        self.assertTrue(any("the elastic part of the third harmonic lies below the base model all along strain" in one["sentence"] for one in found["where"]))
        for row in self.rows(found, "third_harmonic_storage"):
            self.assertAlmostEqual(row["measured"], -0.08, delta=0.005)
            self.assertAlmostEqual(row["standard_deviation"], math.hypot(0.002, 0.25 * 0.08), delta=0.001)

    def test_a_table_of_harmonics_is_read(self):
        self.table("harmonics.csv", ("strain [1]", "third_harmonic_storage [1]", "third_harmonic_loss [1]"),
                   [(strain, 0.001 * (-1)**k, 0.0) for k, strain in enumerate(self.STRAINS)])
        found = self.diagnosis(self.SWEEP + '[[measurement]]\nkind = "harmonics"\nfile = "harmonics.csv"\nsample = "A"\n')
        self.assertEqual(found["verdict"], "no-discrepancy")
        self.assertEqual([row["measured"] for row in self.rows(found, "third_harmonic_storage")], [0.001 * (-1)**k for k in range(8)])

    def test_refusals(self):
        text = self.waveforms(0)
        short = (self.folder / "wave3.csv").read_text().splitlines()[:120]
        self.write("wave3.csv", "\n".join(short) + "\n")
        self.refuse(text, "wave3.csv", "the waveform has no harmonics", "nine tenths of a period")
        self.write("experiment.toml", text.replace(', sample = "A"', "").replace('"waveform"', '"harmonics"'))
        self.refuse_experiment(["wave0.csv", "third_harmonic_storage"])


if __name__ == "__main__":
    unittest.main()
