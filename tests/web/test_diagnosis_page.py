# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a diagnosis in a real browser: figures in their places, causes switched over the data, numbers as CSV."""

import csv
import io
import json
import math
import re
import unittest

import h5py
import numpy

from browser import Browser, needs_browser
from support import VEM, ProgramTest

EXPERIMENT = """title = "Loss & <b>gel</b></script>"

[sample]
particle_radius = "0.25 um"

[structures]
files = ["packing.h5"]

[[measurement]]
kind = "frequency-sweep"
file = "sweep.csv"
sample = "one"
"""


INK = """
const plot = document.querySelectorAll(".plot canvas")[arguments[0]];
const data = plot.getContext("2d").getImageData(0, 0, plot.width, plot.height).data;
const wanted = arguments[1].match(/\\w\\w/g).map((part) => parseInt(part, 16));
let count = 0;
for (let k = 0; k < data.length; k += 4) {
  count += wanted.every((value, c) => Math.abs(data[k + c] - value) < 12) && data[k + 3] > 200;
}
return count;
"""


@needs_browser
class DiagnosisPage(ProgramTest):
    def setUp(self):
        """Moduli of a structure with a loss of the form G'' = 0.1 G', which several causes can explain."""
        super().setUp()
        self.succeed(*VEM[:3], "150", "--voids", "75", *VEM[6:], "-o", "packing.h5")
        self.write("experiment.toml", EXPERIMENT)
        found = self.succeed_json("shear", "packing.h5", "-o", "swept.h5", "--frequency-sweep", "0.1Hz:100Hz:12")
        lines = ["frequency [Hz],storage_modulus [Pa],loss_modulus [Pa]"]
        for k, frequency in enumerate(found["frequency"]):
            error = 1 + 0.02 * math.sin(2.4 * k)
            modulus = found["storage_modulus"]["mean"][k] * (1 + 0.03 * math.log(frequency / 0.1))
            lines.append(f"{frequency},{error * modulus},{0.1 * modulus / error}")
        self.write("sweep.csv", "\n".join(lines) + "\n")

    def test_figures_causes_and_numbers(self):
        found = self.succeed_json("diagnose", "experiment.toml", "-o", "results", "--bootstrap", "99")
        self.assertTrue(found["detected"])
        with Browser(downloads=self.folder) as browser:
            browser.open(self.folder / "results" / "report.html")
            self.assertEqual(browser.find("h1").text, "Loss & <b>gel</b></script>")
            self.assertEqual(browser.find_all("[data-chart]"), [], "a figure is missing")
            browser.wait_for("return [...document.querySelectorAll('figure.chart')].every((chart) => chart.querySelector('.plot canvas'))")
            charts = browser.find_all("figure.chart")
            self.assertGreaterEqual(len(charts), 4)
            self.assertTrue(all(chart.find_elements("css selector", ".plot canvas") for chart in charts))

            switches = {label.text.split(" · ")[0].lstrip("━╌ \n"): label for label in browser.find_all(".models label")}
            best = next(cause["name"] for cause in found["causes"] if cause["parameters"])
            self.assertIn("base model", switches)
            self.assertIn("with " + best, switches)
            colour = browser.run("return getComputedStyle(document.documentElement).getPropertyValue('--extended').trim().slice(1)")
            drawn = browser.run(INK, 0, colour)
            self.assertGreater(drawn, 100)
            switches["with " + best].click()
            self.assertEqual(browser.run(INK, 0, colour), 0)
            switches["with " + best].click()
            self.assertEqual(browser.run(INK, 0, colour), drawn)

            text = browser.download(charts[0].find_element("css selector", ".csv"), self.folder, "moduli.csv")
            rows = list(csv.DictReader(io.StringIO(text)))
            self.check_fitted(list(csv.reader(io.StringIO(text))))
            storage = [row for row in found["rows"] if row["observable"] == "storage_modulus"]
            self.assertEqual(len(rows), len(storage))
            unit = next(iter(rows[0]))
            self.assertIn("angular frequency", unit)
            factor = storage[0]["measured"] / float(rows[0]["G′"])
            self.assertIn(round(factor), (1, 1000, 1000000))
            for row, expected in zip(rows, storage):
                self.assertAlmostEqual(float(row["G′"]) * factor / expected["measured"], 1, delta=1e-12)
                self.assertAlmostEqual(float(row["G′: standard deviation"]) * factor / expected["standard_deviation"], 1, delta=1e-12)
                self.assertEqual(row.get("G′: held out", "0") == "1", expected["held_out"])

            log_y = charts[0].find_elements("css selector", ".tools button")[1]
            before = log_y.get_attribute("aria-pressed")
            log_y.click()
            self.assertNotEqual(log_y.get_attribute("aria-pressed"), before)
            plot = charts[0].find_element("css selector", ".u-over")
            browser.run("arguments[0].scrollIntoView({block: 'center'})", plot)
            browser.drag(plot, 5, 5)  # moves over the plot: the values under the pointer are told
            self.assertIn("base model", charts[0].find_element("css selector", ".readout").text)

            for width in (1440, 400):
                browser.set_width(width)
                browser.wait_for("return document.querySelector('.plot canvas').clientWidth < innerWidth")
                self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), width, "the page is wider than the window")
            browser.find("#theme").click()
            self.assertEqual(browser.run("return document.documentElement.dataset.theme"), "dark")
            self.assertEqual(browser.console(), [])
            self.check_below_zero(browser)

    def check_fitted(self, rows):
        """The curve of the base model is that from which its residuals and the sentences are."""
        with h5py.File(self.folder / "results" / "diagnosis.h5") as file:
            entries = file["diagnosis/rows"]
            storage = entries["loss"][()] == 0
            fitted = entries["base_fitted"][storage]
            self.assertFalse(numpy.allclose(fitted, entries["base"][storage], rtol=1e-6), "this sample has no effect")
        column = rows[0].index("base model")  # of G', that of G'' comes later
        drawn = numpy.array([float(row[column]) for row in rows[1:]])
        numpy.testing.assert_allclose(drawn * fitted[0] / drawn[0], fitted, rtol=1e-9)

    def check_below_zero(self, browser):
        """Where some measured moduli are negative, as raw ones of a heavy tool, all of them are drawn on the logarithmic axis."""
        text = (self.folder / "results" / "report.html").read_text(encoding="utf-8")
        data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.DOTALL).group(1))
        moduli = next(chart for chart in data["charts"] if chart["title"] == "Moduli")  # the first figure on the page
        points = next(series for series in moduli["series"] if series["kind"] == "points")
        moduli["y"]["logarithmic"] = True
        for sign in (1, -1):
            points["y"] = [sign * abs(value) if k % 2 else abs(value) for k, value in enumerate(points["y"])]
            points["colour"] = "--good"  # of nothing else
            self.write("signed.html", re.sub(r'(id="data">).*?(</script>)', lambda part: part.group(1) + json.dumps(data).replace("<", "\\u003c") + part.group(2), text, flags=re.DOTALL))
            browser.open(self.folder / "signed.html")
            browser.wait_for("return document.querySelector('.plot canvas') !== null")
            colour = browser.run("return getComputedStyle(document.documentElement).getPropertyValue('--good').trim().slice(1)")
            drawn = browser.run(INK, 0, colour)
            whole = drawn if sign == 1 else whole
            self.assertGreater(drawn, 0.8 * whole)


if __name__ == "__main__":
    unittest.main()
