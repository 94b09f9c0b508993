# SPDX-License-Identifier: GPL-3.0-or-later
"""The page and the HDF5 file of a diagnosis: they say what diagnosis.json says, need no other file, and appear whole or not at all."""

import json
import os
import re
import unittest
from html.parser import HTMLParser

import h5py

from support import VEM, ProgramTest
from test_diagnosis import EXPERIMENT, MODEL

EMPTY = {"meta", "br"}  # elements without an end


class Page(HTMLParser):
    """Text, elements and addresses of a page; complains about elements that are not closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.words, self.elements, self.addresses, self.ids = [], [], [], [], []
        self.places = 0
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.elements.append(tag)
        self.take(attributes)
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.elements.append(tag)
        self.take(attributes)

    def take(self, attributes):
        for name, value in attributes:
            if name in ("src", "href", "xlink:href"):
                self.addresses.append(value)
            self.places += name == "data-chart"
            if name == "id":
                self.ids.append(value)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open[-3:], self.getpos())
        self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script", "noscript"):
            self.words.append(data)

    @property
    def text(self):
        return re.sub(r"\s+", " ", " ".join(self.words))


class Report(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed(*VEM[:3], "150", "--voids", "75", *VEM[6:], "-o", "packing.h5")
        self.write("experiment.toml", EXPERIMENT.replace("hidden loss", 'Loss & <gel>'))

    def measured(self, loss=True):
        if loss:
            self.write("model.toml", MODEL)
        found = self.succeed_json("shear", "packing.h5", "-o", "swept.h5", "--force", "--frequency-sweep", "0.1Hz:100Hz:16",
                                  *(["--model", "model.toml"] if loss else ["--normal-stiffness", "80N/m", "--shear-stiffness", "8N/m"]))
        lines = ["frequency [Hz],storage_modulus [Pa]" + (",loss_modulus [Pa]" if loss else "")]
        for k, frequency in enumerate(found["frequency"]):
            error = 1 + 0.03 * (-1) ** (k * (k + 1) // 2)
            moduli = [found["storage_modulus"]["mean"][k] * error] + ([found["loss_modulus"]["mean"][k] / error] if loss else [])
            lines.append(",".join(map(str, [frequency] + moduli)))
        if loss:
            lines[4] = lines[4].rsplit(",", 1)[0] + ",n/a"
        self.write("sweep.csv", "\n".join(lines) + "\n")

    def page(self, folder="results"):
        text = (self.folder / folder / "report.html").read_text(encoding="utf-8")
        self.assertTrue(text.startswith("<!DOCTYPE html>"))
        page = Page(text)
        self.assertEqual([address for address in page.addresses if not address.startswith("#")], [], "the page needs other files")
        self.assertNotIn("http", re.sub(r"<(script|style).*?</\1>", "", text, flags=re.DOTALL))
        self.assertEqual(len(page.ids), len(set(page.ids)), "ids are not unique")
        self.assertIsNone(re.search(r"\bnan\b", page.text, re.IGNORECASE))
        return page

    def test_page_and_file_say_what_the_numbers_say(self):
        self.measured()
        found = self.succeed_json("diagnose", "experiment.toml", "-o", "results")
        self.assertEqual(found["verdict"], "tied")
        self.assertEqual(sorted(os.listdir(self.folder / "results")),
                         ["diagnosis.h5", "diagnosis.json", "extended_model.toml", "report.html", "simulations.txt"])
        page = self.page()
        self.assertGreaterEqual(page.places, 4)  # data, residuals, test, gain
        for words in ("Loss & <gel>", "contact-loss explains the data, but nothing that was measured", "What is certain: the deviation follows the frequency", "an oil of known viscosity",
                      "sweep.csv", "n/a", "tied", "packing.h5", "coagula diagnose experiment.toml -o results",
                      found["where"][0]["sentence"], f"{found['gain']['held_out']} numbers were held out"):
            self.assertIn(words, page.text)
        best = found["causes"][0]
        probability = "> 99.9 %" if best["posterior"] >= 0.9995 else f"{100 * best['posterior']:.3g} %"
        self.assertIsNone(re.search(r"probability 100 %|probability above", page.text))
        self.assertEqual(page.text.count(probability), 1)
        exponent = best["parameters"]["exponent"]
        self.assertIn(f"{exponent['low']:.3g} to {exponent['high']:.3g}", page.text)
        with h5py.File(self.folder / "results" / "diagnosis.h5") as file:
            self.check_attributes(file)
            rows = file["diagnosis/rows"]
            for name in ("measured", "standard_deviation", "base", "extended"):
                self.assertEqual(list(rows[name]), [row[name] for row in found["rows"]])
            self.assertEqual(list(file["diagnosis/causes/posterior"]), [cause["posterior"] for cause in found["causes"]])
            self.assertEqual(file["diagnosis/causes/names"][()].decode().split("\n")[0], "contact-loss")
            draws = file["diagnosis/parameters/contact-loss/exponent/draws"][()]
            self.assertTrue(exponent["low"] <= draws.mean() <= exponent["high"])
            bootstrap = file["diagnosis/detection/bootstrap"][()]
            largest = file["diagnosis/detection/score"][0]
            self.assertAlmostEqual(((bootstrap >= largest).sum() + 1) / (len(bootstrap) + 1), found["p_value"])
            held = file["diagnosis/gain"]
            level = {}
            for row in found["rows"]:
                level[row["row"]] = (level.get(row["row"], 0) ** 2 + row["measured"] ** 2) ** 0.5
            for kind in ("base", "extended"):
                errors = [(value - found["rows"][k]["measured"]) / level[found["rows"][k]["row"]]
                          for k, value in zip(held["entry"], held[kind])]
                rms = (sum(error * error for error in errors) / len(errors)) ** 0.5
                self.assertAlmostEqual(rms / found["gain"]["rmse_" + kind], 1, delta=1e-9)
            self.assertIn("n/a", file["diagnosis/data/table_1/left_out"][()].decode())
            self.assertEqual(file["provenance/0001_diagnose/seed"][()], 1)

    def check_attributes(self, file):
        def check(name, entry):
            if isinstance(entry, h5py.Dataset):
                self.assertTrue(entry.attrs["unit"] and entry.attrs["description"], name)

        file.visititems(check)

    def test_nothing_wrong_is_said_so(self):
        self.measured(loss=False)
        found = self.succeed_json("diagnose", "experiment.toml", "-o", "results")
        self.assertEqual(found["verdict"], "no-discrepancy")
        page = self.page()
        self.assertIn("The base model explains the data", page.text)
        self.assertNotIn("What to measure next", page.text)
        self.assertNotIn("extended_model.toml", os.listdir(self.folder / "results"))

    def test_a_folder_is_never_half_written(self):
        self.measured()
        self.succeed("diagnose", "experiment.toml", "-o", "results", "--quiet")
        before = {name: (self.folder / "results" / name).read_bytes() for name in os.listdir(self.folder / "results")}
        # A limit of the size of files makes the write of the page fail.
        failed = self.run_program("diagnose", "experiment.toml", "-o", "results", "--force", "--seed", "2", preexec_fn=limit_files)
        self.assertEqual(failed.returncode, 1, failed.stderr)
        after = {name: (self.folder / "results" / name).read_bytes() for name in os.listdir(self.folder / "results")}
        self.assertEqual(after, before)
        failed = self.run_program("diagnose", "experiment.toml", "-o", "fresh", preexec_fn=limit_files)
        self.assertEqual(failed.returncode, 1, failed.stderr)
        self.assertFalse((self.folder / "fresh").exists())
        # What a killed run left is removed.
        (self.folder / "results" / ".new").mkdir()
        (self.folder / "results" / ".new" / "report.html").write_text("half a page")
        self.succeed("diagnose", "experiment.toml", "-o", "results", "--force", "--quiet", "--seed", "2")
        self.assertFalse((self.folder / "results" / ".new").exists())
        self.assertEqual(json.loads((self.folder / "results" / "diagnosis.json").read_text())["verdict"], "tied")


def limit_files():
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000))


if __name__ == "__main__":
    unittest.main()
