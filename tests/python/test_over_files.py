# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures, pages and tables of result files are those of the program."""

import csv
import io
import os
import shutil
import unittest
from xml.etree import ElementTree

import numpy as np

import coagula
from support import ModuleTest


class OverFiles(ModuleTest):
    def files(self, characterized=("a.h5", "b.h5"), others=()):
        for seed, name in enumerate([*characterized, *others]):
            made = self.made(particles=100, voids=50, seed=seed)
            coagula.write(name, made, *([coagula.characterize(made, only="doh")] if name in characterized else []))
        return [*characterized, *others]


class Tables(OverFiles):
    def test_columns_are_those_of_the_program(self):
        files = self.files(others=["plain.h5", "two.h5"])
        files[3] = os.rename("two.h5", "2") or "2"  # a name that is a number stays a text
        columns = coagula.table(files).columns()
        printed = list(csv.DictReader(io.StringIO(self.run_program("info", *files, "--csv").stdout)))
        self.assertEqual(list(columns), list(printed[0]))
        for heading, column in columns.items():
            self.assertEqual(column.shape, (4,), heading)
            for value, row in zip(column, printed):
                said = row[heading]
                if column.dtype.kind == "U":
                    self.assertEqual(value, said)
                elif column.dtype.kind == "b":
                    self.assertEqual(value, said == "true")
                else:
                    np.testing.assert_array_equal(value, float(said or "nan"), heading)

    def test_values_units_and_kinds(self):
        files = self.files(others=["plain.h5"])
        table = coagula.table(files)
        self.assertEqual(list(table.file), files)
        self.assertEqual((table.unit("box_x"), table.unit("volume_fraction")), ("m", "1"))
        self.assertEqual(table.particles.dtype, np.int64)
        np.testing.assert_array_equal(table.periodic, [True, True, True])
        a = table["characterization/doh/a"]
        self.assertEqual(a[1], coagula.read("b.h5").characterization.doh.a)
        np.testing.assert_array_equal(np.isnan(a), [False, False, True])
        one = coagula.table("a.h5")
        self.assertEqual(one.volume_fraction.tolist(), [coagula.read("a.h5").packing.volume_fraction])

    def test_errors(self):
        with self.assertRaisesRegex(coagula.InputError, "files is empty"):
            coagula.table([])
        files = self.files(characterized=["a.h5"])
        with self.assertRaises(FileNotFoundError) as raised:
            coagula.table([*files, "none.h5"])
        self.assertEqual(raised.exception.filename, "none.h5")
        (self.folder / "-x.h5").write_bytes((self.folder / "a.h5").read_bytes())
        self.assertEqual(len(coagula.table("-x.h5").file), 1)


class Pages(OverFiles):
    def test_the_page_is_that_of_the_program(self):
        files = self.files()
        self.assertEqual(self.run_program("report", *files, "-o", "program.html", "--pores", "3").returncode, 0)
        found = coagula.report(files, "python.html", pores=3)
        self.assertEqual((self.folder / "python.html").read_bytes(), (self.folder / "program.html").read_bytes())
        self.assertEqual((found.structures, found.bytes), (2, (self.folder / "python.html").stat().st_size))
        with self.assertRaises(FileExistsError):
            coagula.report("a.h5", "python.html")
        self.assertEqual(coagula.report("a.h5", "python.html", overwrite=True).structures, 1)
        with self.assertRaises(FileNotFoundError):
            coagula.report("none.h5", "other.html")


@unittest.skipIf(shutil.which("gnuplot") is None, "needs gnuplot")
class Figures(OverFiles):
    def test_the_picture_is_that_of_the_program(self):
        files = self.files()
        said = self.program("plot", *files, "--figure", "pore-curve", "--labels", "one,other", "--width", "10cm", "-o", "program.svg")
        given = {"figure": "pore-curve", "labels": ["one", "other"], "width": 0.1}
        found = coagula.plot(files, output="python.svg", data="python.csv", **given)
        self.assertEqual((self.folder / "python.svg").read_bytes(), (self.folder / "program.svg").read_bytes())
        self.assertEqual((found.caption, len(found.series)), (said["caption"], len(said["series"])))
        self.assertTrue((self.folder / "python.csv").exists())
        self.assertIsNone(found.svg)
        shown = coagula.plot(files, **given)
        self.assertEqual(shown.svg.encode(), (self.folder / "program.svg").read_bytes())
        self.assertEqual(ElementTree.fromstring(shown._repr_svg_()).tag, "{http://www.w3.org/2000/svg}svg")
        with self.assertRaises(FileExistsError):
            coagula.plot(files, output="python.svg", **given)
        coagula.plot(files, output="python.svg", overwrite=True, **given)

    def test_errors(self):
        files = self.files(others=["plain.h5"])
        with self.assertRaisesRegex(coagula.InputError, "plain.h5 has no .*'coagula characterize plain.h5'"):
            coagula.plot("plain.h5", figure="pore-curve")
        with self.assertRaisesRegex(coagula.InputError, "^labels has 1 labels for 3 files"):
            coagula.plot(files, figure="pore-curve", labels="one")
        with self.assertRaisesRegex(coagula.InputError, "^plot\\(\\) needs figure .*help\\(coagula.plot\\)"):
            coagula.plot(files)
        with self.assertRaisesRegex(coagula.InputError, "^paper needs output"):
            coagula.plot(files, paper=True)
        with self.assertRaises(TypeError):
            coagula.plot(files, figure="pore-curve", shade="red")


if __name__ == "__main__":
    unittest.main()
