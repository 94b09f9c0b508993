# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures: what they show is what the file holds, and what they cannot show they say."""

import csv
import json
import os
import re
import shutil
import signal
import unittest
from xml.etree import ElementTree

import h5py

import support
from support import SMALL, ProgramTest

MEASURES = ["pore-curve", "contacts", "pair-correlation", "structure-factor", "neighbour-distances", "bond-angles", "bond-order", "rings",
            "local-redundancy", "voronoi", "density-fluctuations", "void-chords", "solid-chords", "surface", "mean-curvature",
            "euler-characteristic"]
FIGURES = [*MEASURES, "bond-forces", "frequency", "amplitude", "stress-strain", "compression", "oscillations", "modulus-stiffness",
           "modulus-heterogeneity", "critical-value", "heterogeneity-coordination", "modulus-volume-fraction", "packing", "rheometer",
           "overview"]


@unittest.skipIf(shutil.which("gnuplot") is None, "needs gnuplot")
class Plot(ProgramTest):
    def series_of(self, structure, name):
        """A small structure of another seed, characterized and sheared."""
        self.succeed(*SMALL, "--seed", structure, "-o", name)
        self.succeed("characterize", name, "--only", "doh")
        self.succeed("shear", name)
        return name

    def texts_of(self, picture):
        root = ElementTree.parse(self.folder / picture).getroot()
        return ["".join(element.itertext()).strip() for element in root.iter("{http://www.w3.org/2000/svg}text")]

    def marks_in(self, picture):
        """Numbers of point symbols, those of the legend included."""
        text = (self.folder / picture).read_text()
        return len(re.findall(r"<use xlink:href='#gpPt\d+' transform='translate", text))

    def test_the_help_lists_every_figure(self):
        text = self.succeed("plot", "--help")
        for name in FIGURES:
            self.assertIn("\n  " + name + " ", text)

    def test_a_curve_is_that_of_the_file(self):
        path = self.copy_of_measured("a.h5")
        found = self.succeed_json("plot", path, "--figure", "pore-curve", "-o", "a.svg", "--data", "a.csv")
        results = json.loads(self.succeed("info", path, "--json"))["results"]
        radius = results["/characterization/pore_curve/radius"]["value"]
        probability = results["/characterization/pore_curve/exclusion_probability"]["value"]
        r0 = results["/characterization/mean_radius"]["value"]
        self.assertEqual([series["points"] for series in found["series"]], [len(radius), len(radius)])
        with open(self.folder / "a.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * len(radius))
        for row, r, p in zip(rows, radius, probability):
            self.assertAlmostEqual(float(row["x"]), r / r0, places=12)
            self.assertAlmostEqual(float(row["y"]), p, places=12)
        texts = self.texts_of("a.svg")
        self.assertIn("pore radius r / r0", texts)
        self.assertTrue(any(text.startswith("exact, a = ") for text in texts), texts)

    def draw_measures(self, figures):
        path = self.copy_of_packing()
        self.succeed("characterize", path, "--only", "all", "--most-voxels", "10000")
        for figure in figures:
            found = self.succeed_json("plot", path, "--figure", figure, "-o", figure + ".svg", "--data", figure + ".csv")
            self.assertGreaterEqual(found["series"][0]["points"], 5, figure)
            texts = self.texts_of(figure + ".svg")
            self.assertFalse(any("m-" in text for text in texts), texts)

    def test_every_second_measure_has_its_figure(self):
        self.draw_measures(MEASURES[::2])

    def test_the_other_measures_have_their_figures(self):
        self.draw_measures(MEASURES[1::2])

    def test_files_of_one_name_are_told_apart(self):
        for folder in ("dense", "loose"):
            (self.folder / folder).mkdir()
            self.copy_of_measured(f"{folder}/gel.h5")
        found = self.succeed_json("plot", "dense/gel.h5", "loose/gel.h5", "--figure", "pore-curve", "-o", "a.svg")
        names = {series["name"].split(",")[0] for series in found["series"]}
        self.assertTrue(any("dense/gel" in name for name in names) and any("loose/gel" in name for name in names), names)

    def test_size_and_units(self):
        path = self.copy_of_measured("a.h5")
        found = self.succeed_json("plot", path, "--figure", "modulus-volume-fraction", "-o", "a.svg", "--width", "12cm", "--height", "80mm")
        self.assertAlmostEqual(found["width"], 0.12)
        root = ElementTree.parse(self.folder / "a.svg").getroot()
        self.assertEqual((root.get("width"), root.get("height")), ("120mm", "80mm"))
        self.assertIn("shear modulus G′ (MPa)", self.texts_of("a.svg"))
        self.assertEqual(found["series"][0]["y"]["unit"], "Pa")

    def test_font_and_limits(self):
        path = self.copy_of_measured("a.h5")
        plot = ["plot", path, "--force", "-o", "a.svg", "--figure"]
        self.succeed(*plot, "pore-curve", "--font", "DejaVu Sans", "--size", "12", "--x-range", "0:3", "--y-range", ":2")
        picture = (self.folder / "a.svg").read_text()
        self.assertIn('font-family="DejaVu Sans, Arial, Helvetica, sans-serif"', picture)
        self.assertIn('font-size="12.00"', picture)
        texts = self.texts_of("a.svg")
        self.assertTrue({"3", "2"} <= set(texts) and "3.5" not in texts, texts)
        self.succeed(*plot, "pair-correlation", "--x-range", "0.4um:900nm")  # in the unit of the axis
        self.assertTrue({"0.4", "0.9"} & set(self.texts_of("a.svg")) or {"400", "900"} & set(self.texts_of("a.svg")), self.texts_of("a.svg"))
        for words, says in ((["pore-curve", "--x-range", "5"], "LOW:HIGH"), (["pore-curve", "--x-range", ":"], "LOW:HIGH"),
                            (["pore-curve", "--x-range", "1s:2s"], "--x-range"), (["pore-curve", "--y-range", "2:1"], "upper end"),
                            (["pair-correlation", "--y-range", "0:5"], "above zero"), (["packing", "--x-range", "0:1"], "no axes"),
                            (["pore-curve", "--font", "x' ; system"], "--font"), (["pore-curve", "--size", "0"], "--size")):
            self.fail_with(2, *plot, *words, says=says)

    def test_what_files_share_has_one_neutral_key(self):
        for name in ("a.h5", "b.h5"):
            self.copy_of_packing(name)
            self.succeed("characterize", name, "--only", "bond_order")
        found = self.succeed_json("plot", "a.h5", "b.h5", "--figure", "bond-order", "-o", "a.svg")
        self.assertEqual([series["name"] for series in found["series"]], ["a", "b", "", ""])
        texts = self.texts_of("a.svg")
        for name in ("a", "b", "q6", "q4"):
            self.assertEqual(texts.count(name), 1, texts)

    def test_every_format(self):
        path = self.copy_of_measured("a.h5")
        for name, begin in (("a.svg", b"<?xml"), ("a.png", b"\x89PNG"), ("a.pdf", b"%PDF")):
            self.succeed("plot", path, "--figure", "overview", "-o", name, *(["--resolution", "80"] if name == "a.png" else []))
            self.assertTrue((self.folder / name).read_bytes().startswith(begin), name)

    def test_several_files_share_a_figure(self):
        first = self.copy_of_measured("a.h5")
        second = self.copy_of_measured("b.h5")
        for words, names in (([], ["a", "b"]), (["--labels", "slow & low,fast"], ["slow & low", "fast"])):
            found = self.succeed_json("plot", first, second, "--figure", "bond-forces", "--force", "-o", "a.svg", *words)
            self.assertEqual([series["name"] for series in found["series"]], names)
            for name in names:
                self.assertIn(name, self.texts_of("a.svg"))
            # One symbol for each place and one for each line of the legend.
            self.assertEqual(self.marks_in("a.svg"), sum(series["points"] for series in found["series"]) + 2)

    def test_mean_and_standard_error_over_structures(self):
        names = [self.series_of(seed, f"s{seed}.h5") for seed in (1, 2, 3)]
        found = self.succeed_json("plot", *names, "--figure", "modulus-heterogeneity", "-o", "a.svg")
        series = found["series"][0]
        moduli = [json.loads(self.succeed("info", name, "--json"))["results"]["/mechanics/linear/storage_modulus/mean"]["value"]
                  for name in names]
        mean = sum(moduli) / 3
        error = (sum((value - mean) ** 2 for value in moduli) / 2 / 3) ** 0.5
        summary = series["y"]["over_structures"]
        self.assertEqual((series["name"], series["points"], summary["structures"]), ("VEM", 3, 3))
        self.assertAlmostEqual(summary["mean"] / mean, 1, places=12)
        self.assertAlmostEqual(summary["standard_error"] / error, 1, places=12)
        self.assertIn("standard error", self.succeed("plot", *names, "--figure", "modulus-heterogeneity", "--force", "-o", "a.svg"))

    def test_published_points(self):
        path = self.copy_of_measured("a.h5")
        found = self.succeed_json("plot", path, "--figure", "modulus-heterogeneity", "--published", "-o", "a.svg", "--data", "a.csv")
        self.assertEqual([(s["name"], s["points"]) for s in found["series"]], [("VEM", 1), ("published VEM", 6), ("published BD", 5)])
        self.assertIn("published BD,degree of heterogeneity,0.373,shear modulus [Pa],480000,49000", (self.folder / "a.csv").read_text())
        self.fail_with(2, "plot", path, "--figure", "contacts", "--published", "-o", "b.svg", says="published")

    def test_tables(self):
        path = self.copy_of_measured("a.h5")
        self.succeed("calibrate", path, "--steps", "3", "-o", "series.csv")
        found = self.succeed_json("plot", "series.csv", "--figure", "modulus-stiffness", "-o", "a.svg")
        self.assertEqual([s["points"] for s in found["series"] if s["name"]], [3])
        self.assertIn("normal particle stiffness kn (N/m)", self.texts_of("a.svg"))
        self.fail_with(2, "plot", path, "--figure", "modulus-stiffness", "-o", "b.svg", says="coagula calibrate")
        self.fail_with(2, "plot", "series.csv", "--figure", "contacts", "-o", "b.svg", says=["series.csv", "table"])
        self.fail_with(2, "plot", "series.csv", "--figure", "modulus-heterogeneity", "-o", "b.svg", says="column a")
        rows = "".join(f"{a},{(a - 0.2) ** 2}\n" for a in (0.3, 0.4, 0.5, 0.6, 0.7))
        self.write("moduli.csv", "a,modulus [MPa]\n" + rows)
        found = self.succeed_json("plot", "moduli.csv", "--figure", "modulus-heterogeneity", "-o", "b.svg")
        self.assertIn("β = 2", found["caption"])
        self.succeed("plot", "moduli.csv", "--figure", "critical-value", "-o", "c.svg")

    def test_missing_results_name_the_verb(self):
        path = self.copy_of_packing()
        for figure, command in (("pore-curve", "coagula characterize packing.h5"), ("bond-forces", "coagula shear packing.h5"),
                                ("frequency", "--frequency-sweep"), ("amplitude", "--amplitudes"), ("stress-strain", "--ramp"), ("compression", "--strain uniaxial"),
                                ("oscillations", "--method dem")):
            self.fail_with(2, "plot", path.name, "--figure", figure, "-o", "a.svg", says=["packing.h5", command])
        self.succeed("characterize", path, "--only", "coordination")
        self.fail_with(2, "plot", path.name, "--figure", "pore-curve", "-o", "a.svg", says="pore_curve")
        self.succeed("plot", path.name, "--figure", "contacts", "-o", "a.svg")

    def test_what_is_wrong_is_said(self):
        path = self.copy_of_measured("a.h5")
        figure = ["--figure", "contacts"]
        self.fail_with(2, "plot", path, "-o", "b.svg", says="--figure")
        self.fail_with(2, "plot", path, *figure, says="--output")
        self.fail_with(2, "plot", path, *figure, "-o", "b.jpg", says=[".svg", ".png", ".pdf"])
        self.fail_with(2, "plot", path, "--figure", "pores", "-o", "b.svg", says=["pores", "pore-curve"])
        self.fail_with(2, "plot", path, *figure, "-o", "b.svg", "--labels", "a,b", says=["2 labels", "1 files"])
        self.fail_with(2, "plot", path, *figure, "-o", "b.svg", "--width", "85", says="--width")
        self.fail_with(2, "plot", path, *figure, "-o", "b.svg", "--width", "3s", says="--width")
        self.fail_with(2, "plot", "none.h5", *figure, "-o", "b.svg", says="none.h5")
        self.fail_with(2, "plot", path, path, "--figure", "packing", "-o", "b.svg", says="one file")
        self.write("b.svg", "precious")
        self.fail_with(3, "plot", path, *figure, "-o", "b.svg", says=["b.svg", "--force"])
        self.assertEqual((self.folder / "b.svg").read_text(), "precious")

    def test_settings_of_gnuplot_and_of_the_caller_do_not_matter(self):
        path = self.copy_of_measured("a.h5")
        self.succeed("plot", path, "--figure", "contacts", "-o", "a.svg")
        pictures = [(self.folder / "a.svg").read_bytes()]
        for variable, value in (("GNUTERM", "nonsense"), ("GNUTERM", "dumb"), ("GNUPLOT_LIB", "/nowhere"), ("FIT_LOG", "/nowhere/log")):
            self.succeed("plot", path, "--figure", "contacts", "-o", "a.svg", "--force", env={**os.environ, variable: value})
            pictures.append((self.folder / "a.svg").read_bytes())
        self.succeed("plot", path, "--figure", "contacts", "-o", "a.svg", "--force",
                     preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
        self.assertEqual({*pictures, (self.folder / "a.svg").read_bytes()}, {pictures[0]})

    def test_without_gnuplot_nothing_is_written(self):
        path = self.copy_of_measured("a.h5")
        environment = {**os.environ, "PATH": str(self.folder)}
        self.fail_with(1, "plot", path, "--figure", "contacts", "-o", "b.svg", says="gnuplot is not installed", env=environment)


@unittest.skipIf(shutil.which("gnuplot") is None, "needs gnuplot")
class Paper(ProgramTest):
    def test_draws_what_can_be_drawn_and_says_what_is_missing(self):
        (self.folder / "made").mkdir()
        path = self.copy_of_measured("made/a.h5")
        found = self.succeed_json("plot", "made", "--paper", "-o", "figures")
        drawn = {figure["number"]: figure["drawn"] for figure in found["figures"]}
        self.assertEqual(drawn, {1: True, 2: True, 3: True, 4: False, 5: False, 6: True})
        missing = {figure["number"]: " ".join(figure["missing"]) for figure in found["figures"]}
        self.assertIn("coagula shear made/a.h5 --method dem", missing[4])
        self.assertIn("coagula calibrate", missing[5])
        self.assertEqual(sorted(os.listdir(self.folder / "figures")),
                         sorted(["captions.md"] + [f"figure{n}.{end}" for n in (1, 2, 3, 6) for end in ("svg", "csv")]))
        captions = (self.folder / "figures/captions.md").read_text()
        self.assertIn("published as a picture only", captions)
        self.succeed("calibrate", path, "--steps", "2", "-o", "made/stiffness.csv")
        again = self.succeed_json("plot", "made", "--paper", "--force", "-o", "figures")
        self.assertTrue(again["figures"][4]["drawn"])
        names = [series["name"] for series in again["figures"][4]["series"] if series["name"]]
        self.assertEqual(names, ["a", "published BD, 0 mV", "published BD, 15 mV"])

    def test_what_is_no_structure_is_skipped_in_a_folder(self):
        (self.folder / "made").mkdir()
        self.copy_of_measured("made/a.h5")
        self.copy_of_packing("made/bare.h5")  # without any result
        self.write("made/broken.h5", "no HDF5")
        with h5py.File(self.folder / "made/state.h5", "w") as file:
            file["state/time"] = [1.0]
        found = self.succeed_json("plot", "made", "--paper", "-o", "figures")
        self.assertEqual([figure["drawn"] for figure in found["figures"]], [True, True, True, False, False, True])
        self.assertIn("made/bare.h5", " ".join(found["figures"][0]["missing"]))
        self.assertEqual(len(found["skipped"]), 2)
        for name, sentence in zip(("broken.h5", "state.h5"), found["skipped"]):
            self.assertIn(f"made/{name}", sentence)
        table = self.succeed("plot", "made", "--paper", "--force", "-o", "figures")
        self.assertRegex(table, r"\nskipped +made/broken.h5 .*\nskipped +made/state.h5")
        os.remove(self.folder / "made/bare.h5")
        self.assertEqual(len(self.succeed_json("plot", "made", "--figure", "contacts", "-o", "c.svg")["skipped"]), 2)
        self.fail_with(2, "plot", "made/a.h5", "made/state.h5", "--paper", "-o", "other", says="made/state.h5")
        os.remove(self.folder / "made/a.h5")
        self.fail_with(2, "plot", "made", "--paper", "-o", "other", says="made/broken.h5")

    def test_nothing_to_draw(self):
        self.fail_with(2, "plot", support.PACKING, "--paper", "--figure", "contacts", "-o", "figures", says="--figure")
        (self.folder / "empty").mkdir()
        self.fail_with(2, "plot", "empty", "--paper", "-o", "figures", says="empty")
