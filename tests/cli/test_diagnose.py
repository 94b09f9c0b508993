# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose check: what an experiment file says, what the data checks find, and every bad input refused by one sentence."""

import math
import unittest

from support import ProgramTest

HEAD = "strain [%],storage modulus [Pa],loss modulus [Pa],stress [Pa]\n"


def sweep(rows=8, scale=1.0, wobble=0.0):
    """An amplitude sweep in a CSV file; scale and wobble make replicates of it."""
    lines = []
    for i in range(rows):
        strain = 0.001 * 10 ** (i / 2)
        storage = scale * 500 / (1 + strain) * (1 + wobble * math.sin(5 * i * scale))
        loss = 50 * scale
        lines.append(f"{strain:.6g},{storage:.6g},{loss:.6g},{math.hypot(storage, loss) * strain / 100:.6g}\n")
    return HEAD + "".join(lines)


def experiment(*measurements, before=""):
    return before + "".join(f"[[measurement]]\n{text}\n" for text in measurements)


SWEEP = 'kind = "amplitude-sweep"\nfile = "sweep.csv"'


class Check(ProgramTest):
    def found(self, text):
        return self.succeed_json("diagnose", "check", self.write("experiment.toml", text))

    def test_reads_converts_and_reports(self):
        self.write("sweep.csv", sweep())
        found = self.found(experiment(SWEEP + '\nsample = "A"\nvalues = { frequency = "1 Hz" }', before='title = "gel"\n'))
        self.assertEqual(found["title"], "gel")
        (table,) = found["measurements"]
        self.assertEqual((table["kind"], table["sample"], table["rows"], table["left_out"]), ("amplitude-sweep", "A", 8, []))
        columns = {column["name"]: column for column in table["columns"]}
        self.assertAlmostEqual(columns["strain"]["min"], 1e-5)
        self.assertAlmostEqual(columns["angular_frequency"]["max"], 2 * math.pi)
        self.assertFalse(found["noise"][0]["rows_estimated"])
        self.assertIn("no replicates", found["noise"][0]["statement"])
        self.assertIn("amplitude-sweep", self.succeed("diagnose", "check", "experiment.toml"))

    def test_a_slipped_separator_is_listed_and_left_out(self):
        lines = sweep().splitlines()
        cells = lines[4].split(",")
        cells[3] = str(float(cells[3]) * 10)
        lines[4] = ",".join(cells)
        self.write("sweep.csv", "\n".join(lines) + "\n")
        (table,) = self.found(experiment(SWEEP))["measurements"]
        self.assertIn(("stress", 4), {(cell["column"], cell["row"]) for cell in table["left_out"]})
        self.assertEqual({cell["row"] for cell in table["left_out"]}, {4})
        self.assertIn("|G*| x strain = stress", table["left_out"][0]["reason"])

    def test_replicates_give_the_noise(self):
        parts = []
        for number, scale in enumerate((1.0, 1.1, 0.7)):
            self.write(f"{number}.csv", sweep(12, scale, 0.02))
            parts.append(f'kind = "amplitude-sweep"\nfile = "{number}.csv"\nsample = "batch {number}"')
        noise = self.found(experiment(*parts))["noise"][0]
        self.assertEqual((noise["observable"], noise["tables"], noise["samples"]), ("complex_modulus", 3, 3))
        self.assertTrue(noise["rows_estimated"] and noise["sample_estimated"])
        self.assertTrue(noise["sample"]["low"] < 0.21 < noise["sample"]["high"])  # scatter of 1, 1.1, 0.7 about their mean
        effects = noise["sample_effects"]
        self.assertAlmostEqual((1 + effects["batch 2"]) / (1 + effects["batch 0"]), 0.7, delta=0.03)

    def test_a_plate_that_is_inherited_counts_like_one_that_is_stated(self):
        """Tables are replicates only where everything that acts is equal."""
        for name, scale in (("a", 1.0), ("b", 1.1), ("c", 0.9)):
            self.write(f"{name}.csv", sweep(12, scale, 0.02))
        plates = '[instrument]\ngeometry = "plate-plate"\nplate_radius = "25 mm"\ngap = "1 mm"\n'
        tables = [f'kind = "amplitude-sweep"\nfile = "{name}.csv"\n' for name in "abc"]

        def pooled(*stated, before=plates):
            texts = [table + (f'values = {{ {value} }}' if value else "") for table, value in zip(tables, stated)]
            noise = self.found(experiment(*texts, before=before))["noise"]
            return sorted(each["tables"] for each in noise if each["observable"] == "complex_modulus")

        self.assertEqual(pooled("", "", ""), [3])
        self.assertEqual(pooled("", 'plate_radius = "25 mm"', 'plate_radius = "12.5 mm"'), [1, 2])
        self.assertEqual(pooled("", 'gap = "1 mm"', 'gap = "0.5 mm"'), [1, 2])
        self.assertEqual(pooled('gap = "0.5 mm"', 'gap = "0.5 mm"', ""), [1, 2])
        self.assertEqual(pooled("", 'gap = "1 mm"', 'gap = "1 mm"', before=""), [1, 2])  # nobody says the gap of the first

    def test_times_of_runs(self):
        """When runs took place: start, pause, pre-shear and clock; what nobody says is said to be unknown."""
        rows = "".join(f"{10 * k},{100 + k}\n" for k in range(1, 7))
        self.write("first.csv", "time [s],storage modulus [Pa]\n" + rows)
        self.write("second.csv", "time [s],storage modulus [Pa]\n" + "".join(f"{400 + 10 * k},{99 + k}\n" for k in range(1, 7)))
        run = lambda name, words: f'kind = "time-sweep"\nfile = "{name}.csv"\nsample = "A"\n{words}'
        notes = lambda *texts: self.found(experiment(*[run(name, text) for name, text in zip(("first", "second"), texts)]))["notes"]
        unknown = [note for note in notes("", "") if "ageing cannot be told from noise" in note]
        self.assertEqual(len(unknown), 2)
        self.assertIn("as those of one clock", " ".join(notes("", "run_order = 1")))
        dated = ('start = 2022-11-14T16:32:00', 'start = "2022-11-14 16:45"\nclock = "run"')
        for second in (dated[1], 'run_order = 1\npause = "10 min"\npreshear = "2 min"\nclock = "run"'):
            self.assertNotIn("clock", " ".join(notes(dated[0], second)))
        for text, says in (("pause = -1", "'pause': must be >= 0 s"), ("preshear = 1e300", "at most a year"), ('clock = "mine"', "neither run nor sample"),
                           ('start = "1 min"\npause = "1 min"', "leave one of them out"), ("start = 2022-11-14", "time of day"),
                           ('run_order = 1\npause = "1 min"', "run on"), ('start = "2022-11-13 16:32"\nrun_order = 1', "a year apart")):
            self.write("experiment.toml", experiment(run("first", "start = 0"), run("second", text)))
            self.refuse_experiment(says)

    def test_replicates_that_agree_in_groups_are_noted(self):
        """Two instruments, of which one sees the modulus rise along the frequency."""
        tables = []
        for name, slope, instrument in (("a", 0, "DHR"), ("b", 0, "DHR"), ("c", 0.2, "MCR"), ("d", 0.2, "MCR")):
            sizes = [1e3 * (1 + slope * (k / 11 - 0.5)) * (1 + 0.01 * math.sin(7 * k * k + 3 * ord(name))) for k in range(12)]
            self.write(f"{name}.csv", "ω [rad/s],G' [Pa],G'' [Pa]\n" + "".join(f"{10 ** (k / 6):.6g},{size:.6g},{0.1 * size:.6g}\n" for k, size in enumerate(sizes)))
            tables.append(f'kind = "frequency-sweep"\nfile = "{name}.csv"\ninstrument = "{instrument}"\n')
        self.assertIn("tables from the instruments 'DHR' and 'MCR' differ by", " ".join(self.found(experiment(*tables))["notes"]))
        self.assertNotIn("differ by", " ".join(self.found(experiment(*tables[:2]))["notes"]))

    def test_rows_are_in_the_order_of_their_clock(self):
        rows = "".join(f"10:{59 - k:02}:00,{k + 1},{100 + k}\n" for k in range(8))
        self.write("clock.csv", "Time of Day,ω [rad/s],G' [Pa]\n" + rows)
        (table,) = self.found(experiment('kind = "frequency-sweep"\nfile = "clock.csv"'))["measurements"]
        time = {column["name"]: column for column in table["columns"]}["time"]
        self.assertEqual((time["min"], time["max"]), (60, 480))

    def test_columns_by_heading_and_standard_errors(self):
        self.write("s.csv", "a,modulus [MPa],error [MPa]\n" + "".join(f"{0.37 + 0.05 * i},{1 + 0.1 * i},0.1\n" for i in range(6)))
        found = self.found(experiment('kind = "structure-series"\nfile = "s.csv"\n'
                                      'columns = { heterogeneity = "a", storage_modulus = "modulus" }\n'
                                      'standard_errors = { storage_modulus = "error [MPa]" }'))
        columns = {column["name"]: column for column in found["measurements"][0]["columns"]}
        self.assertAlmostEqual(columns["storage_modulus"]["max"], 1.5e6)
        self.assertTrue(columns["storage_modulus"]["standard_errors"])
        self.assertAlmostEqual(columns["heterogeneity"]["min"], 0.37)

    def test_names_of_quantities_are_headings(self):
        names = ("coordination", "structure", "storage_modulus [Pa]", "loss_modulus [Pa]", "phase [rad]", "deflection [mrad]",
                 "plate_radius [mm]", "rattler_fraction [1]")
        rows = "".join(f"{4 + 0.1 * i},{i},{1e6 + 1e5 * i},{1e6 + 1e5 * i},{math.pi / 4},2,{12.5 + i},0.1\n" for i in range(1, 6))
        self.write("s.csv", ",".join(names) + "\n" + rows)
        (table,) = self.found(experiment('kind = "structure-series"\nfile = "s.csv"'))["measurements"]
        self.assertEqual({column["name"] for column in table["columns"]}, {name.split(" ")[0] for name in names})
        self.assertEqual(table["left_out"], [])

    def test_rows_columns_and_clock_are_chosen(self):
        self.write("sweep.csv", sweep(9))
        chosen = '\nrows = [2, 9]\nwithout = ["stress", "loss_modulus"]\ntime_per_row = "3 s"'
        (table,) = self.found(experiment(SWEEP + chosen))["measurements"]
        columns = {column["name"]: column for column in table["columns"]}
        self.assertEqual((table["rows"], sorted(columns)), (8, ["storage_modulus", "strain", "time"]))
        self.assertEqual((columns["time"]["min"], columns["time"]["max"]), (6, 27))
        lines = "".join(f"{10 + 5 * k},{100 + k},{10 + k % 3}\n" for k in range(30))
        self.write("sweep.csv", "time [s],storage modulus [Pa],loss modulus [Pa]\n" + lines.replace("\n40,", "\n40,x", 1))
        (table,) = self.found(experiment('kind = "time-sweep"\nfile = "sweep.csv"\nrows = [1, 30, 3]\ntime_zero = "10 s"'))["measurements"]
        columns = {column["name"]: column for column in table["columns"]}
        self.assertEqual((table["rows"], columns["time"]["min"], columns["time"]["max"]), (10, 0, 135))
        self.assertEqual([(cell["column"], cell["row"]) for cell in table["left_out"]], [("storage_modulus", 3)])

    def test_columns_to_do_without_may_be_derived(self):
        """What torque and raw phase give counts, too: `without` takes the columns that remain."""
        rows = "".join(f"{k + 1},1e-4,{1e-3 / (k + 1)},{20 + k},{100 + k},{30 + k}\n" for k in range(6))
        self.write("raw.csv", "ω [rad/s],torque [N.m],deflection [rad],raw phase [deg],G' [Pa],G'' [Pa]\n" + rows)
        plates = '[instrument]\ngeometry = "plate-plate"\nplate_radius = "20 mm"\ngap = "1 mm"\n'

        def columns(*keys):
            text = "\n".join(('kind = "frequency-sweep"', 'file = "raw.csv"', 'moduli = "raw"', *keys))
            (table,) = self.found(experiment(text, before=plates))["measurements"]
            return {column["name"] for column in table["columns"]}

        self.assertLessEqual({"strain", "storage_modulus", "loss_modulus"}, columns())
        self.assertNotIn("strain", columns('without = "strain"'))
        self.assertIn("storage_modulus", columns('without = "strain"'))
        self.assertNotIn("loss_modulus", columns('without = ["loss_modulus", "strain"]'))
        self.write("experiment.toml", experiment('kind = "frequency-sweep"\nfile = "raw.csv"\nwithout = "viscosity"', before=plates))
        self.fail_with(2, "diagnose", "check", "experiment.toml", says="no column 'viscosity' to do without")

    def test_what_the_stress_was_set_for_is_said(self):
        sizes = [100 + 10 * k for k in range(8)]
        text = 'kind = "frequency-sweep"\nfile = "s.csv"\n'
        self.write("s.csv", "ω [rad/s],strain [1],stress [Pa],G' [Pa]\n" + "".join(f"{k + 1},{5 / size:.9g},5,{size}\n" for k, size in enumerate(sizes)))
        self.assertIn("the stress is taken for what was set", " ".join(self.found(experiment(text))["notes"]))
        self.assertNotIn("what was set", " ".join(self.found(experiment(text + 'control = "strain"'))["notes"]))
        self.write("experiment.toml", experiment(text + 'control = "torque"'))
        self.fail_with(2, "diagnose", "check", "experiment.toml", says="'torque' is neither stress nor strain")

    def test_trios_steps_are_chosen_by_section_and_result(self):
        rows = "".join(f"{10 ** (0.5 * i)}\t{100 + i}\t{10}\n" for i in range(6))
        self.write("t.txt", "Filename\tx\n[step]\nConditioning\nTime\tTemperature\ns\t°C\n1\t20\n\n"
                            f"[step]\nFrequency sweep\nAngular frequency\tStorage modulus\tLoss modulus\nrad/s\tkPa\tPa\n{rows}")
        keys = 'kind = "frequency-sweep"\nfile = "t.txt"\n'
        for choice in ("section = 2", 'result = "Frequency sweep"'):
            (table,) = self.found(experiment(keys + choice))["measurements"]
            self.assertEqual(table["rows"], 6)
            self.assertAlmostEqual({c["name"]: c for c in table["columns"]}["storage_modulus"]["max"], 105e3)
        self.write("experiment.toml", experiment(keys))
        self.fail_with(2, "diagnose", "check", "experiment.toml", says="several sections fit")


class BadInput(ProgramTest):
    def refuse(self, text, *says, data=None):
        self.write("sweep.csv", sweep() if data is None else data)
        self.write("experiment.toml", text)
        self.refuse_experiment(says, may_say_nan=True)

    def refuse_data(self, data, *says):
        self.refuse(experiment(SWEEP), *says, data=data)

    def test_data(self):
        self.refuse_data("strain [%],loss modulus [Pa]\n1,2\n", "sweep.csv", "no column 'storage_modulus'")
        self.refuse_data("storage modulus [Pa]\n1\n", "no column 'strain'")
        self.refuse_data(HEAD.replace("modulus [Pa]", "modulus [m]") + "1,2,3,4\n", "'storage modulus'", "another dimension")
        self.refuse_data(HEAD.replace("strain [%]", "strain") + "1,2,3,4\n", "'strain' names no unit")
        self.refuse_data(sweep(3), "3 usable rows are too few")
        self.refuse_data(HEAD + "".join(f"{i},500,50,{i * 5.0249}\n" for i in range(1, 9)), "'storage_modulus' is 500 Pa in every row")
        self.refuse_data(HEAD + "".join(f"{i},nan,50,1\n" for i in range(1, 9)), "'storage_modulus' has no readable number")
        head, *rows = sweep(12).splitlines(keepends=True)
        self.refuse_data(head + "".join(rows[6:] + rows[:6]), "the rows are in the wrong order")
        self.refuse_data(sweep().replace("strain [%]", "strain [1]"), "by a factor of 100", "units")
        self.refuse_data("", "sweep.csv", "no header")
        twice = HEAD.replace("loss modulus", "storage modulus")
        self.refuse_data(twice + "".join(f"{i},500,{50 + i},1\n" for i in range(1, 9)), "two columns have the heading 'storage modulus' and differ")

    def test_copies_and_plans_are_no_measurements(self):
        self.refuse(experiment(SWEEP, SWEEP + '\nsample = "B"'), "sweep.csv, sample 'B': the same numbers as in sweep.csv, sample 'measurement 1'")
        self.refuse(experiment('kind = "time-sweep"\nplanned = { from = "1 s", to = "9 s", points = 9 }'), "measurement 1 (planned)", "--power")

    def test_a_copy_with_fewer_digits_is_no_replicate(self):
        head, *rows = sweep(9, 1.0, 0.01).splitlines()
        cells = [[float(cell) for cell in row.split(",")] for row in rows]
        for digits in ("{:.3e}", "{:.2e}"):
            copy = "\n".join(",".join([f"{row[0]:.6g}", *(digits.format(cell) for cell in row[1:])]) for row in cells)
            self.write("copy.csv", f"{head}\n{copy}\n")
            other = 'kind = "amplitude-sweep"\nfile = "copy.csv"\nsample = "B"'
            self.refuse(experiment(SWEEP, other), "copy.csv, sample 'B': the same numbers as in sweep.csv, sample 'measurement 1', but for their rounding",
                        data=sweep(9, 1.0, 0.01))
        self.write("sweep.csv", sweep(9, 1.0, 0.01))
        other = "\n".join(",".join(f"{cell:.4g}" for cell in (row[0], 1.004 * row[1], 1.004 * row[2], 1.004 * row[3])) for row in cells)
        self.write("copy.csv", f"{head}\n{other}\n")
        self.write("experiment.toml", experiment(SWEEP, 'kind = "amplitude-sweep"\nfile = "copy.csv"\nsample = "B"'))
        self.assertEqual(len(self.succeed_json("diagnose", "check", "experiment.toml")["measurements"]), 2)

    def test_what_no_amplitude_and_no_modulus_can_be(self):
        text = "frequency [Hz],strain [1],storage modulus [Pa]\n" + "".join(f"{k},{(-1) ** k},{'1e300' if k == 4 else 500 + k}\n" for k in range(1, 9))
        self.write("sweep.csv", text)
        self.write("experiment.toml", experiment(SWEEP.replace("amplitude", "frequency")))
        (table,) = self.succeed_json("diagnose", "check", "experiment.toml")["measurements"]
        cells = {(cell["column"], cell["row"]) for cell in table["left_out"]}
        self.assertEqual(cells, {("storage_modulus", 4), *(("strain", row) for row in (1, 3, 5, 7))})

    def test_columns_that_say_the_same_twice(self):
        twice = "strain [%],storage modulus [Pa],storage modulus [Pa]\n" + "".join(f"{i},{500 + i},{500 + i}\n" for i in range(1, 9))
        self.write("sweep.csv", twice)
        self.write("experiment.toml", experiment(SWEEP))
        self.assertEqual(self.succeed_json("diagnose", "check", "experiment.toml")["measurements"][0]["rows"], 8)

    def test_lines_may_end_by_carriage_returns_alone(self):
        self.write("sweep.csv", sweep().replace("\n", "\r"))
        self.write("experiment.toml", experiment(SWEEP))
        self.assertEqual(self.succeed_json("diagnose", "check", "experiment.toml")["measurements"][0]["rows"], 8)

    def test_waveforms(self):
        wave = [f"{k / 64},{0.01 * math.sin(2 * math.pi * k / 64)},{10 * math.sin(2 * math.pi * k / 64 + 0.1)}" for k in range(64)]
        for rows, values in ((wave, ""), (wave[:32], '\nvalues = { frequency = "1 Hz" }')):
            text = experiment('kind = "waveform"\nfile = "sweep.csv"' + values)
            self.refuse(text, "sweep.csv: the waveform has no harmonics", data="time [s],strain [1],stress [Pa]\n" + "\n".join(rows) + "\n")

    def test_frames_are_counted(self):
        rows = "".join(f"{k},{k % 3},{k % 5},{1 + k % 2 / 2}\n" for k in range(20))
        self.refuse(experiment('kind = "coordinates"\nfile = "sweep.csv"'), "column 'frame' is 1.5 in row 2, but must hold whole numbers",
                    data="x [um],y [um],z [um],frame\n" + rows)

    def test_metadata(self):
        for before, says in (
            ('[instrument]\ngap = "0 mm"\n', "instrument.gap is 0"),
            ('[instrument]\ngap = "1 Pa"\n', "key 'gap'"),
            ('[instrument]\ngeometry = "egg"\n', "'egg' is not one of"),
            ('[instrument]\ngeometry = "plate-plate"\ncone_angle = "1 degree"\n', "cone_angle"),
            ('[instrument]\ninner_radius = "13 mm"\n', "instrument.inner_radius and instrument.outer_radius go together"),
            ('[instrument]\nplate_radius = "12.5mm"\ngap = "2cm"\n', "must be below plate_radius"),
            ("[sample]\nvolume_fraction = 40\n", "volume_fraction"),
            ('[sample]\nparticle_radius = "-1um"\n', "particle_radius"),
            ("[sample]\ncolour = 3\n", "key 'colour'"),
            ("colour = 3\n", "key 'colour'"),
            ('[structures]\nfiles = ["absent.h5"]\n', "absent.h5 does not exist"),
            ('[structures]\ngenerator = "snow"\n', "'snow'"),
            ('[structures]\ngenerator = "vem"\nseeds = [3, 4, 3]\n', "holds 3 twice"),
            ("[noise]\nstated_relative = 5\n", "stated_relative"),
            ("sample = 3\n", "must be a table"),
        ):
            with self.subTest(before=before):
                self.refuse(experiment(SWEEP, before=before), "experiment.toml", says)

    def test_measurements(self):
        for text, says in (
            ("", "there is no measurement"),
            ('[[measurment]]\nkind = "amplitude-sweep"\n', "key 'measurment': there is no such key"),
            (experiment('file = "sweep.csv"'), "the key 'kind' is missing"),
            (experiment('kind = "amplitude-sweep"'), "the key 'file' is missing"),
            (experiment('kind = "swing"\nfile = "sweep.csv"'), "'swing' is not one of frequency-sweep, amplitude-sweep"),
            (experiment('kind = "amplitude-sweep"\nfile = "absent.csv"'), "absent.csv does not exist"),
            (experiment(SWEEP + "\nsection = 7"), "no section fits"),
            (experiment(SWEEP + "\npoints = [1]"), "only a waveform has points"),
            (experiment(SWEEP + '\ncolumns = { storage_modulus = "E" }'), "there is no column 'E'"),
            (experiment(SWEEP + '\ncolumns = { stiffness = "E" }'), "'stiffness' is not a quantity"),
            (experiment(SWEEP + '\nvalues = { angular_frequency = "0 rad/s" }'), "must be > 0"),
            (experiment(SWEEP + '\nvalues = { stress = "3 Pa" }'), "has a column of it"),
            (experiment(SWEEP + "\nmood = 1"), "key 'mood'"),
            (experiment(SWEEP + "\nrows = [3, 1]"), "first not after last"),
            (experiment(SWEEP + "\nrows = [30, 40]"), "none of its 8 rows"),
            (experiment(SWEEP + "\nrows = [1, 9]"), "rows up to 9 are chosen, but it has 8"),
            (experiment(SWEEP + '\nwithout = "torque"'), "no column 'torque'"),
            (experiment(SWEEP + '\ntime_per_row = "0 s"'), "must be > 0 s"),
            (experiment(SWEEP + '\ntime_zero = "1 s"'), "has no times"),
            ("[[measurement]\n", "not TOML"),
        ):
            with self.subTest(text=text):
                self.refuse(text, says)

    def test_files(self):
        self.fail_with(2, "diagnose", "check", "absent.toml", says="absent.toml")
        self.fail_with(2, "diagnose", "check", self.folder, says="cannot be read")
        self.write("experiment.toml", experiment(SWEEP))
        self.fail_with(2, "diagnose", "experiment.toml", says="'diagnose check'")

    def test_options_that_would_not_be_heeded(self):
        self.write("experiment.toml", experiment(SWEEP))
        for words, says in (
            (("--check", "--power"), "--check is not read with --power"),
            (("--check", "-o", "out"), "--output is not read with --check"),
            (("--check", "--causes", "ageing"), "--causes is not read with --check"),
            (("-o", "out", "--diagnoses", "1"), "--diagnoses is read only with --power"),
        ):
            with self.subTest(words=words):
                self.fail_with(2, "diagnose", "experiment.toml", *words, says=says)
                self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
