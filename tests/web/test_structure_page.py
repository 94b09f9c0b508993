# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula report in a real browser: nothing on the console, spheres where geometry says, numbers that the file holds."""

import csv
import io
import unittest

import h5py
import numpy

from browser import Browser, needs_browser
from geometry import Spheres, first_hits, rays
from support import ProgramTest

PIXELS = """
const viewer = coagula.views.stages[arguments[0]].viewer;
viewer.drawNow();
const canvas = document.createElement("canvas");
[canvas.width, canvas.height] = [viewer.canvas.width, viewer.canvas.height];
const context = canvas.getContext("2d");
context.drawImage(viewer.canvas, 0, 0);
const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
return arguments[1].map(([x, y]) => [...data.slice(4 * (y * canvas.width + x), 4 * (y * canvas.width + x) + 3)]);
"""


def rotation(n):
    """A rotation whose first row is the unit vector n."""
    helper = numpy.eye(3)[numpy.argmin(numpy.abs(n))]
    second = numpy.cross(n, helper)
    second /= numpy.linalg.norm(second)
    return numpy.array([n, second, numpy.cross(n, second)])


def moduli(stiffness, n):
    """Young's modulus along n and the mean, least and largest shear modulus of plates normal to n, by turning the tensor with four indices."""
    voigt = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    tensor = numpy.zeros((3, 3, 3, 3))
    for a, (i, j) in enumerate(voigt):
        for b, (k, l) in enumerate(voigt):
            for first in ((i, j), (j, i)):
                for second in ((k, l), (l, k)):
                    tensor[first + second] = stiffness[a, b]
    shears = []
    for angle in numpy.radians(numpy.arange(0, 180, 0.5)):
        turn = rotation(n)
        turn[1:] = [[numpy.cos(angle), numpy.sin(angle)], [-numpy.sin(angle), numpy.cos(angle)]] @ turn[1:]
        turned = numpy.einsum("ai,bj,ck,dl,ijkl->abcd", turn, turn, turn, turn, tensor, optimize=True)
        compliance = numpy.linalg.inv([[turned[one + other] for other in voigt] for one in voigt])
        shears.append(1 / compliance[5, 5])
    return 1 / compliance[0, 0], 1 / numpy.mean(1 / numpy.array(shears)), min(shears), max(shears)


@needs_browser
class StructurePage(ProgramTest):
    def make(self, *names):
        for name in names:
            self.copy_of_packing(name)
            self.succeed("characterize", name)
            self.succeed("shear", name)
        self.succeed("report", *names, "-o", "report.html")
        return self.folder / "report.html"

    def check_console(self, browser):
        self.assertEqual(browser.console(), [])
        self.assertEqual(browser.run("return performance.getEntriesByType('resource').map((entry) => entry.name).filter((name) => !name.startsWith('blob:'))"), [])

    def canvas_of(self, browser, view=0):
        canvas = browser.find_all(".stage canvas[role=img]")[view]
        browser.run("arguments[0].scrollIntoView({block: 'nearest'})", canvas)
        return canvas

    def camera(self, browser, view=0):
        return browser.run("return coagula.views.stages[arguments[0]].viewer.projection()", view)

    def check_picks(self, browser, spheres, slab=None):
        """Clicks on pixels well inside a sphere pick that sphere."""
        canvas = self.canvas_of(browser)
        width, height = (int(canvas.rect[name]) for name in ("width", "height"))
        random = numpy.random.default_rng(1)
        pixels = random.integers([0.3 * width, 0.3 * height], [0.6 * width, 0.7 * height], (3000, 2))
        hits, margins = first_hits(spheres, self.camera(browser), width, height, pixels, slab)
        sure = [k for k in range(len(pixels)) if hits[k] >= 0 and margins[k] > 0.1][:4]  # two pixels from any edge
        self.assertEqual(len(sure), 4)
        for k in sure:
            browser.run("coagula.views.stages[0].viewer.select(null)")  # the panel may lie over the next place
            browser.click_at(canvas, *map(int, pixels[k]))
            browser.wait_for(f"return document.querySelector('.picked')?.dataset.particle === '{hits[k]}'")
            x, y = (int(canvas.rect[side] + pixels[k][c]) - browser.run(f"return Math.round(scroll{'XY'[c]})") for c, side in enumerate("xy"))
            browser.wait_for(f"return document.elementFromPoint({x}, {y})?.tagName === 'CANVAS'")  # the panel does not hide the particle
            panel = browser.find(".picked")
            self.assertEqual(int(panel.get_attribute("data-particle")), hits[k])
            self.assertIn(f"Particle {hits[k]}", panel.text)
            self.assertRegex(panel.text, rf"coordination\s+{spheres.coordination[hits[k]]}\b")
            self.assertEqual(len(panel.find_elements("css selector", "tbody tr")), spheres.coordination[hits[k]])

    def check_drawing(self, browser, spheres, slab=None):
        """Spheres are drawn where rays meet them and nowhere else, each in the colour of its coordination."""
        canvas = self.canvas_of(browser)
        width, height = (int(canvas.rect[name]) for name in ("width", "height"))
        random = numpy.random.default_rng(2)
        pixels = random.integers([0.1 * width, 0.05 * height], [0.9 * width, 0.95 * height], (2500, 2))
        hits, margins = first_hits(spheres, self.camera(browser), width, height, pixels, slab)
        colours = numpy.array(browser.run(PIXELS, 0, pixels.tolist()), dtype=float)
        background = numpy.array(browser.run(PIXELS, 0, [[1, 1]])[0])
        is_drawn = numpy.abs(colours - background).sum(axis=1) > 6
        sure = margins > 0.05
        self.assertTrue(((hits >= 0) & sure).sum() > 50 and ((hits < 0) & sure).sum() > 50)
        wrong = (is_drawn != (hits >= 0)) & sure
        self.assertEqual(wrong.sum(), 0, pixels[wrong])
        # Viridis turns from blue to green with the number of contacts; light and distance change red, green and blue alike.
        seen = sure & (hits >= 0)
        greenness = (colours[seen, 1] - colours[seen, 2]) / colours[seen].sum(axis=1)
        self.assertGreater(numpy.corrcoef(greenness, spheres.coordination[hits[seen]])[0, 1], 0.9)

    def check_cut_faces(self, browser, spheres, slab):
        """A cut face has the colour that the legend gives its value."""
        canvas = self.canvas_of(browser)
        width, height = (int(canvas.rect[name]) for name in ("width", "height"))
        legend = [tuple(map(int, colour.strip("rgb()").split(",")))
                  for colour in browser.run("return [...document.querySelectorAll('.legend .steps i')].map((i) => getComputedStyle(i).backgroundColor)")]
        pixels = numpy.random.default_rng(3).integers([0.2 * width, 0.2 * height], [0.8 * width, 0.8 * height], (1500, 2))
        camera = self.camera(browser)
        hits, _ = first_hits(spheres, camera, width, height, pixels, slab)
        colours = browser.run(PIXELS, 0, pixels.tolist())
        axis, low, high = slab
        seen = 0
        for colour, hit, eye, direction in zip(colours, hits, *rays(camera, width, height, pixels.astype(float))):
            along = min((bound - eye[axis]) / direction[axis] for bound in (low, high))
            away = numpy.linalg.norm(eye + along * direction - spheres.centres[hit]) / spheres.radii[hit]
            if hit >= 0 and away < 0.9:  # inside its rim, which is darker
                self.assertLessEqual(max(abs(a - b) for a, b in zip(colour, legend[spheres.coordination[hit]])), 1)
                seen += 1
        self.assertGreater(seen, 20)

    def test_spheres_are_where_geometry_says(self):
        page = self.make("packing.h5")
        spheres = Spheres(self.folder / "packing.h5")
        with Browser() as browser:
            browser.open(page)
            browser.run("coagula.views.change({box: false})")
            self.check_drawing(browser, spheres)
            self.check_picks(browser, spheres)
            before = self.camera(browser)
            browser.drag(self.canvas_of(browser), 120, -60)
            self.assertGreater(numpy.linalg.norm(numpy.subtract(self.camera(browser)["eye"], before["eye"])), 1)
            browser.run("coagula.views.stages[0].viewer.select(null)")
            self.check_drawing(browser, spheres)
            browser.run("coagula.views.change({slab: {on: true, axis: 0, position: 0.6, thickness: 0.2}})")
            slab = (0, 0.5 * spheres.lengths[0], 0.7 * spheres.lengths[0])
            self.check_drawing(browser, spheres, slab)
            self.check_picks(browser, spheres, slab)
            browser.run("coagula.views.stages[0].viewer.select(null)")
            self.check_cut_faces(browser, spheres, slab)
            browser.run("coagula.views.change({parallel: true})")
            self.check_drawing(browser, spheres, slab)
            self.check_cut_faces(browser, spheres, slab)
            browser.run("coagula.views.change({slab: {on: false, axis: 0, position: 0.6, thickness: 0.2}})")
            self.check_drawing(browser, spheres)
            self.check_picks(browser, spheres)
            self.check_console(browser)

    def test_keyboard_and_controls(self):
        page = self.make("packing.h5")
        with Browser() as browser:
            browser.open(page)
            canvas = self.canvas_of(browser)
            first = self.camera(browser)["eye"]
            browser.press(canvas, "\ue012", "+")  # arrow to the left
            turned = self.camera(browser)["eye"]
            self.assertLess(numpy.linalg.norm(turned), numpy.linalg.norm(first))
            browser.press(canvas, "r")
            numpy.testing.assert_allclose(self.camera(browser)["eye"], first, rtol=1e-9)
            for axis, key in enumerate("xyz"):
                browser.press(canvas, key)
                way = numpy.subtract(self.camera(browser)["eye"], self.camera(browser)["target"])
                numpy.testing.assert_allclose(way / numpy.linalg.norm(way), numpy.eye(3)[axis], atol=1e-5)
            browser.press(canvas, "r")
            for settings in ("colourBy: 'cluster'", "colourBy: 'nonaffinity', logarithmic: true", "colourBy: 'energy_share'", "colourBy: 'radius'",
                             "bonds: 'normal_force', sphereScale: 0.3", "arrows: 'nonaffine_displacement'", "parallel: true", "parallel: false", "backboneOnly: true, plane: 'yz'", "images: 'layer', pores: 20",
                             "images: 'double'", "spheres: false"):
                browser.run(f"coagula.views.change({{{settings}}})")
                colours = {tuple(colour) for colour in browser.run(PIXELS, 0, [[x, y] for x in range(100, 500, 7) for y in range(100, 400, 7)])}
                self.assertGreater(len(colours), 100, settings)
            legend = browser.find(".legends").text
            for words in ("normal force per unit strain", "compression", "tension"):
                self.assertIn(words, legend)
            self.check_console(browser)

    def test_values_are_selected_and_coloured_as_one_wants(self):
        page = self.make("packing.h5")
        spheres = Spheres(self.folder / "packing.h5")
        drawn = "return coagula.views.stages[0].viewer.drawn.particle.length"
        with Browser() as browser:
            browser.open(page)
            low, high = browser.find_all(".legend input.number")
            low.send_keys("5", "\ue004")  # tabulator: goes on to the other end
            browser.wait_for("return document.activeElement.getAttribute('aria-label') === 'Upper end of the colours of the particles'")
            browser.wait_for("return document.querySelector('.legend .steps').innerText.trim().split(/\\s/)[0] === '5'")
            browser.find(".legend input[type=checkbox]").click()
            expected = int((spheres.coordination >= 5).sum())
            browser.wait_for(f"{drawn} === {expected}")
            self.assertIn(f"{expected} of 500 particles", browser.find(".legends").text)
            browser.run("coagula.views.change({bonds: 'plain'})")
            ends = browser.run("return coagula.views.stages[0].viewer.sticks.count")
            with h5py.File(self.folder / "packing.h5") as file:
                bonds = spheres.coordination[file["connectivity/bonds"][()]]
            self.assertGreaterEqual(ends, (bonds >= 5).all(axis=1).sum())
            self.assertLessEqual(ends, 2 * (bonds >= 5).all(axis=1).sum())  # those through the boundary are drawn in halves
            browser.run("document.querySelector('.legend select').value = 'inferno'; document.querySelector('.legend select').dispatchEvent(new Event('change'))")
            browser.wait_for("return document.querySelector('.legend button') !== null")
            self.assertEqual(browser.find(".legend select").get_attribute("value"), "inferno")
            browser.find(".legend button").click()
            browser.wait_for(f"{drawn} === 500")
            # Two boxes along each axis start whole inside the view.
            browser.run("coagula.views.change({bonds: 'none', images: 'double'})")
            camera = self.camera(browser)
            eye, target = numpy.array(camera["eye"]), numpy.array(camera["target"])
            ahead = (target - eye) / numpy.linalg.norm(target - eye)
            right = numpy.cross(ahead, camera["up"])
            right /= numpy.linalg.norm(right)
            corners = numpy.stack(numpy.meshgrid(*([0, 2 * length] for length in spheres.lengths)), axis=-1).reshape(-1, 3) - eye
            depth = corners @ ahead
            half = numpy.tan(numpy.radians(camera["fieldOfView"]) / 2)
            self.assertLess(numpy.max(numpy.abs(corners @ numpy.cross(right, ahead)) / (depth * half)), 1)
            self.assertLess(numpy.max(numpy.abs(corners @ right) / (depth * half * camera["aspect"])), 1)
            # What is picked is told once, with what it refers to.
            browser.run("coagula.views.change({images: 'none'}); coagula.views.stages[0].viewer.select(7)")
            names = [name.text for name in browser.find_all(".picked dt")]
            self.assertEqual(len(names), len(set(names)), names)
            self.assertIn("non-affine displacement per unit strain", names)
            self.check_console(browser)

    def test_no_value_vanishes_in_the_dark(self):
        page = self.make("packing.h5")
        contrast = """
            const luminance = (text) => { const [r, g, b] = text.match(/\\d+/g).map((part) => part / 255).map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
              return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
            const stage = luminance(getComputedStyle(document.querySelector('.stage')).backgroundColor);
            return [...document.querySelectorAll('.legend .steps i')].map((i) => luminance(getComputedStyle(i).backgroundColor))
              .map((one) => (Math.max(one, stage) + 0.05) / (Math.min(one, stage) + 0.05));"""
        with Browser() as browser:
            browser.prefer("dark")
            browser.open(page)
            for name in ("viridis", "inferno", "grey"):
                browser.run(f"coagula.views.change({{particles: {{map: '{name}', low: null, high: null, within: false}}}})")
                self.assertGreater(min(browser.run(contrast)), 2.2, name)

    def test_headline_contents_and_words(self):
        page = self.make("packing.h5")
        with h5py.File(self.folder / "packing.h5") as file:
            modulus, error = (file[f"mechanics/linear/storage_modulus/{name}"][()] for name in ("mean", "std"))
        with Browser() as browser:
            browser.open(page)
            facts = dict(zip([name.text for name in browser.find_all(".facts dt")], [value.text.replace("\u00a0", " ") for value in browser.find_all(".facts dd")]))
            self.assertEqual(facts["radius"], "250 nm")
            value, spread = (float(part) for part in facts["G′"].removesuffix(" MPa").split(" ± "))
            self.assertAlmostEqual(value / (modulus / 1e6), 1, delta=5e-3)  # three digits
            self.assertAlmostEqual(spread / (error / 1e6), 1, delta=0.06)
            links = browser.run("return [...document.querySelectorAll('.contents a')].map((link) => [link.getAttribute('href'), link.textContent])")
            self.assertTrue(all(browser.run("return document.querySelector(arguments[0]) !== null", href) for href, _ in links), links)
            self.assertEqual({f"#{figure}" for figure in browser.run("return [...document.querySelectorAll('.figures figure')].map((figure) => figure.id)")},
                             {href for href, _ in links} & {f"#{figure}" for figure in browser.run("return [...document.querySelectorAll('figure')].map((figure) => figure.id)")})
            labels = browser.run("return [...document.querySelectorAll('.plot')].map((plot) => plot.getAttribute('aria-label'))")
            self.assertFalse([label for label in labels if "000 m" in label or "[rad" in label or "_" in label], labels)
            self.assertFalse([label for label in labels if label.lower().startswith("linear response, non affinity")], "six components are no curve")

    def test_a_page_without_results_shows_the_structure_alone(self):
        self.copy_of_packing("packing.h5")
        self.succeed("report", "packing.h5", "-o", "report.html")
        with Browser() as browser:
            browser.open(self.folder / "report.html")
            self.assertGreater(browser.run("return document.querySelector('.stage').clientWidth / document.body.clientWidth"), 0.9)
            self.assertIn("holds no results yet", browser.find(".notes").text)
            self.assertEqual(browser.find_all("#all-results, .contents, .figures"), [])
            self.check_console(browser)

    def test_backbone_hides_the_others(self):
        page = self.make("packing.h5")
        with h5py.File(self.folder / "packing.h5") as file:
            bonds = file["connectivity/bonds"][()]
            flags = file["mechanics/linear/load_structure/xz/bonds/backbone"][()]
        particles = len(numpy.unique(bonds[flags == 1]))
        with Browser() as browser:
            browser.open(page)
            browser.run("coagula.views.change({backboneOnly: true, plane: 'xz'})")
            self.assertEqual(browser.run("return coagula.views.stages[0].viewer.drawn.particle.length"), particles)
            browser.run("coagula.views.change({backboneOnly: false, images: 'double'})")
            self.assertEqual(browser.run("return coagula.views.stages[0].viewer.drawn.particle.length"), 8 * 500)
            self.check_console(browser)

    def test_numbers_as_csv(self):
        page = self.make("packing.h5")
        with Browser(downloads=self.folder) as browser:
            browser.open(page)
            buttons = browser.find_all(".figures .csv")
            rows = list(csv.reader(io.StringIO(browser.download(buttons[0], self.folder, "pore-curve.csv"))))
            self.assertEqual(rows[0], ["distance from the surface r / r₀", "exact", "fit"])
            with h5py.File(self.folder / "packing.h5") as file:
                curve = file["characterization/pore_curve"]
                r0 = file["characterization/mean_radius"][()]
                expected = numpy.stack([curve["radius"][()] / r0, curve["exclusion_probability"][()], curve["fit"][()]], axis=1)
                stiffness = file["mechanics/linear/elastic_tensor"][()]
            numpy.testing.assert_allclose(numpy.array(rows[1:], dtype=float), expected, rtol=1e-7)
            elastic = browser.find(".elastic .csv")
            table = list(csv.DictReader(io.StringIO(browser.download(elastic, self.folder, "moduli-in-every-direction.csv"))))
            self.assertGreater(len(table), 500)
            for row in table[::97]:
                n = numpy.array([float(row[name]) for name in ("nx", "ny", "nz")])
                found = [float(row[name]) for name in ("youngs_modulus [Pa]", "shear_modulus [Pa]", "shear_modulus_least [Pa]", "shear_modulus_most [Pa]")]
                numpy.testing.assert_allclose(found, moduli(stiffness, n), rtol=1e-4)  # the ends lie between half degrees
            self.check_console(browser)

    def test_light_and_dark_and_two_widths(self):
        page = self.make("packing.h5")

        def background(browser):
            return sum(map(int, browser.run("return getComputedStyle(document.body).backgroundColor").strip("rgba()").split(",")[:3]))

        with Browser() as browser:
            browser.prefer("dark")
            browser.open(page)
            self.assertLess(background(browser), 150)
            self.assertLess(sum(browser.run(PIXELS, 0, [[1, 1]])[0]), 200)
            browser.find("#theme").click()
            self.assertGreater(background(browser), 700)
            self.assertGreater(sum(browser.run(PIXELS, 0, [[1, 1]])[0]), 600)
            browser.find("#theme").click()
            browser.prefer("light")
            self.assertLess(background(browser), 150)  # what was chosen stays
            for width in (1440, 400):
                browser.set_width(width)
                browser.wait_for("return coagula.views.stages[0].viewer.canvas.clientWidth < innerWidth")
                self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), width, "the page is wider than the window")
            for name in ("role", "aria-label"):
                self.assertTrue(all(plot.get_attribute(name) for plot in browser.find_all(".plot, .stage canvas[role=img], .surfaces canvas")))
            self.check_console(browser)

    def test_two_structures_are_compared(self):
        self.copy_of_packing("b.h5")
        measures = ["--only", "coordination,doh,bond_order"]
        self.succeed("characterize", "b.h5", "--contact-tolerance", "0.05", *measures)
        self.succeed("shear", "b.h5", "--normal-stiffness", "200N/m", "--shear-stiffness", "20N/m")
        self.copy_of_packing("a.h5")
        self.succeed("characterize", "a.h5", *measures)
        self.succeed("shear", "a.h5")
        self.succeed("report", "a.h5", "b.h5", "-o", "report.html")
        with Browser() as browser:
            browser.open(self.folder / "report.html")
            self.assertEqual(len(browser.find_all(".stage canvas[role=img]")), 2)
            browser.drag(self.canvas_of(browser, 0), 80, 30)
            numpy.testing.assert_allclose(self.camera(browser, 0)["eye"], self.camera(browser, 1)["eye"], rtol=1e-9)
            next(label for label in browser.find_all("label.check") if label.text == "linked cameras").click()
            browser.drag(self.canvas_of(browser, 1), 80, 30)
            self.assertGreater(numpy.linalg.norm(numpy.subtract(self.camera(browser, 0)["eye"], self.camera(browser, 1)["eye"])), 1)
            keys = browser.run("return [...document.querySelectorAll('figure')].find((figure) => figure.textContent.includes('Bond-orientational')).querySelectorAll('.key')")
            self.assertEqual([key.text.split("\n")[-1] for key in keys], ["a.h5: q₄", "a.h5: q₆", "b.h5: q₄", "b.h5: q₆"])
            looks = {(key.text.split("\n")[0], key.find_element("css selector", "i").get_attribute("style")) for key in keys}
            self.assertEqual(len(looks), 4, looks)  # colour and kind of line together tell the curves apart
            rows = {row.find_element("css selector", "th").text: row.text for row in browser.find_all(".differences tbody tr")}
            self.assertIn("+100 %", rows["mechanics / linear / storage modulus / mean"].replace("\u00a0", " "))
            self.assertNotIn("characterization / particles", rows)
            self.check_console(browser)

    def test_texts_stay_texts(self):
        name = "<img src=x onerror=fail()></script>.h5".replace("/", "_")
        self.make(name)
        with Browser() as browser:
            browser.open(self.folder / "report.html")
            self.assertEqual(browser.find("h1").text, name)
            self.assertEqual(browser.find_all("img"), [])
            self.assertIn("onerror", browser.find(".history").text)
            self.check_console(browser)

    def test_without_webgl_a_sentence(self):
        page = self.make("packing.h5")
        with Browser(graphics=["--disable-3d-apis"]) as browser:
            browser.open(page)
            self.assertIn("WebGL 2", browser.find(".stage .missing").text)
            self.assertGreaterEqual(len(browser.find_all(".plot canvas")), 3)

    def test_structure_without_results(self):
        self.copy_of_packing("bare.h5")
        self.succeed("report", "bare.h5", "-o", "report.html")
        with Browser() as browser:
            browser.open(self.folder / "report.html")
            self.assertIn("run coagula characterize", browser.find(".notes").text)
            self.check_console(browser)


if __name__ == "__main__":
    unittest.main()
