# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a data set in a real browser: figure, filters, order, and one structure of it."""

import csv
import io
import unittest

import h5py
import numpy

try:
    from selenium.webdriver import ActionChains
except ImportError:
    ActionChains = None

from browser import Browser, needs_browser
from support import ProgramTest
from test_dataset import SWEEP

TITLE = "Two <b>kinds</b></script>"


class WithSet(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("sweep.toml", SWEEP.replace('title = "small"', f'title = "{TITLE}"'))
        self.succeed("dataset", "run", "sweep.toml", "-o", "set.h5")
        with h5py.File(self.folder / "set.h5") as file:
            self.index = {name: file["index"][name][:] for name in file["index"]}
        self.ids = [name.decode() for name in self.index["id"]]


class SetPageFile(WithSet):
    def test_page_of_a_structure(self):
        found = self.succeed_json("report", "set.h5", "--structure", self.ids[3], "-o", "one.html")
        self.assertEqual(found["structures"], 1)
        self.assertIn(f"set.h5: {self.ids[3]}", (self.folder / "one.html").read_text())

    def test_refusals(self):
        self.fail_with(2, "report", "set.h5", "--structure", "ffff", "-o", "no.html", says=["set.h5", "holds no structure ffff"])
        self.fail_with(2, "report", "set.h5", "set.h5", "-o", "no.html", says=["set.h5 is a data set", "--structure"])
        self.copy_of_packing("packing.h5")
        self.fail_with(2, "report", "packing.h5", "--structure", self.ids[0], "-o", "no.html", says=["packing.h5 is no data set"])
        self.assertFalse((self.folder / "no.html").exists())


@needs_browser
class SetPage(WithSet):
    def setUp(self):
        super().setUp()
        self.assertEqual(self.succeed_json("report", "set.h5", "-o", "set.html")["structures"], len(self.ids))

    def rows(self, browser):
        return browser.run("return [...document.querySelectorAll('.wide.set tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent))")

    def heads(self, browser):
        return browser.run("return [...document.querySelectorAll('.wide.set thead tr:first-child th')].map((cell) => cell.textContent.replace(/ [▲▼]/, ''))")

    def filter(self, browser, column, text):
        browser.run("const input = document.querySelector(`[aria-label='rows with ${arguments[0]}']`); input.value = arguments[1]; input.dispatchEvent(new Event('input'));", column, text)

    def test_table_sorts_and_filters(self):
        with Browser() as browser:
            browser.open(self.folder / "set.html")
            self.assertEqual(browser.run("return document.querySelector('h1').textContent"), TITLE)  # a text, never HTML
            heads = self.heads(browser)
            self.assertEqual([row[heads.index("id")] for row in self.rows(browser)], self.ids)
            self.filter(browser, "voids", ">20")
            many = [name for name, voids in zip(self.ids, self.index["voids"]) if voids > 20]
            self.assertEqual([row[heads.index("id")] for row in self.rows(browser)], many)
            self.filter(browser, "shear-stiffness", "10")
            few = [k for k, name in enumerate(self.ids) if self.index["voids"][k] > 20 and self.index["shear-stiffness"][k] == 10]
            self.assertEqual([row[heads.index("id")] for row in self.rows(browser)], [self.ids[k] for k in few])
            browser.run("[...document.querySelectorAll('.wide.set thead button')].find((one) => one.textContent.startsWith('storage_modulus.mean')).click()")
            in_order = sorted(few, key=lambda k: self.index["storage_modulus.mean"][k])
            self.assertEqual([row[heads.index("id")] for row in self.rows(browser)], [self.ids[k] for k in in_order])
            self.filter(browser, "voids", "about 20")
            self.assertEqual(browser.run("return document.querySelector(\"[aria-label='rows with voids']\").getAttribute('aria-invalid')"), "true")
            self.assertEqual(browser.console(), [])

    def test_a_click_on_a_point_chooses_its_structure(self):
        with Browser() as browser:
            browser.open(self.folder / "set.html")
            browser.wait_for("return coagula.chart.plot !== null")
            row = 5
            x, y = browser.run("""
                const plot = coagula.chart.plot, group = coagula.points.find((one) => one.rows.includes(arguments[0]));
                const k = group.rows.indexOf(arguments[0]);
                plot.over.scrollIntoView({ block: "center" });
                return [plot.valToPos(group.series.x[k], "x") - plot.over.clientWidth / 2, plot.valToPos(group.series.y[k], "y") - plot.over.clientHeight / 2];
                """, row)
            over = browser.driver.find_element("css selector", ".u-over")
            ActionChains(browser.driver).move_to_element_with_offset(over, round(x), round(y)).click().perform()
            detail = browser.run("return document.querySelector('.detail').textContent")
            self.assertIn(f"coagula report set.h5 --structure {self.ids[row]}", detail)
            self.assertEqual(browser.run("return document.querySelector('tr.chosen').cells[0].textContent"), self.ids[row])

    def test_csv_holds_the_rows_shown(self):
        with Browser() as browser:
            browser.open(self.folder / "set.html")
            self.filter(browser, "voids", "10")
            text = browser.run("return coagula.table.csv()")
            rows = list(csv.DictReader(io.StringIO(text)))
            expected = [k for k, voids in enumerate(self.index["voids"]) if voids == 10]
            self.assertEqual([row["id"] for row in rows], [self.ids[k] for k in expected])
            numpy.testing.assert_allclose([float(row["storage_modulus.mean [Pa]"]) for row in rows], self.index["storage_modulus.mean"][expected])


if __name__ == "__main__":
    unittest.main()
