# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula diagnose with structures by a recipe: causes that change the structures, coordinates, pore curves, what cannot be made."""

import hashlib
import unittest

from support import ProgramTest

EXPERIMENT = """[sample]
particle_radius = "{radius} um"
volume_fraction = 0.4

[structures]
{structures}
particles = {particles}
seeds = [1, 2]
"""

TABLE = """
[[measurement]]
kind = "{kind}"
file = "{name}.csv"
sample = "{name}"
"""


def marked(line):
    """A line of the cache whose first number differs in the last digits from what a simulation gives."""
    key, numbers, _ = line.split("\t")
    first, *rest = numbers.split(" ")
    text = key + "\t" + " ".join([repr(float(first) * (1 + 1e-13)), *rest])
    return text + "\t" + hashlib.sha256(text.encode()).hexdigest()[:16]


class Recipe(ProgramTest):
    def experiment(self, structures, kind, *tables, radius=0.25, particles=200):
        self.write("experiment.toml", EXPERIMENT.format(structures=structures, radius=radius, particles=particles) +
                   "".join(TABLE.format(kind=kind, name=name) for name in tables))

    def test_sizes_hidden_in_coordinates_are_found(self):
        for seed in ("31", "32"):
            self.succeed("generate", "vem", "--particles", "600", "--volume-fraction", "0.4", "--radius", "0.25um", "--size-distribution",
                         "normal:0.15", "--seed", seed, "--quiet", "-o", f"hidden{seed}.h5")
            self.succeed("export", f"hidden{seed}.h5", "--format", "csv", "-o", f"hidden{seed}.csv")
        self.experiment('generator = "vem"\nvoids = 60', "coordinates", "hidden31", "hidden32", particles=120)
        words = ("diagnose", "experiment.toml", "-o", "results", "--force", "--causes", "polydispersity,localisation-error", "--bootstrap", "299")
        found = self.succeed_json(*words)
        self.assertTrue(found["detected"])
        self.assertEqual(found["credible_set"][0], "polydispersity")
        size = found["causes"][0]["parameters"]["relative_size_deviation"]
        self.assertLess(size["low"], 0.15)
        self.assertGreater(size["high"], 0.14)
        self.assertGreater(found["gain"]["rmse_ratio"], 2)
        # What was simulated is known by the recipe, and serves again to the same result.
        cache = self.folder / "results" / "simulations.txt"
        lines = cache.read_text().splitlines()
        place = next(n for n, line in enumerate(lines) if "--size-distribution lognormal:0.4 --target-coordination 4.69 --seed 2" in line)
        lines[place] = marked(lines[place])
        cache.write_text("\n".join(lines) + "\n")
        again = self.succeed_json(*words)
        self.assertEqual(cache.read_text().splitlines()[place], lines[place], "was simulated again")
        self.assertEqual([cause["name"] for cause in again["causes"]], [cause["name"] for cause in found["causes"]])
        for one, other in zip(again["causes"], found["causes"]):
            self.assertAlmostEqual(one["posterior"], other["posterior"], delta=1e-6)

    def test_a_pore_curve_of_coagulated_structures(self):
        """Small particles, whose barrier at 15 mV is low. The sample coagulated as the recipe says."""
        for seed in ("7", "8"):
            self.succeed("generate", "brownian", "--particles", "150", "--volume-fraction", "0.4", "--radius", "0.1um", "--surface-potential",
                         "0mV", "--stop-coordination", "4.69", "--seed", seed, "--quiet", "-o", "sample.h5", "--force")
            exact = self.succeed_json("characterize", "sample.h5", "--only", "pores", "--radii", "40", "-o", "pores.h5", "--force")
            curve = exact["pore_curve"]
            self.write(f"pores{seed}.csv", "pore_radius [m],exclusion_probability\n" +
                       "".join(f"{r},{p}\n" for r, p in zip(curve["radius"], curve["exclusion_probability"])))
        self.experiment('generator = "brownian"\nsurface_potential = "0 mV"', "pore-curve", "pores7", "pores8", radius=0.1, particles=150)
        found = self.succeed_json("diagnose", "experiment.toml", "-o", "results", "--bootstrap", "299")
        self.assertEqual(found["verdict"], "no-discrepancy")
        self.assertEqual({row["observable"] for row in found["rows"]}, {"exclusion_probability"})
        cache = (self.folder / "results" / "simulations.txt").read_text()
        for change in ("--surface-potential 0.015 ", "--size-distribution lognormal:0.4 "):
            self.assertIn(change, cache)

    def pores_of_void_expansion(self, voids, volume_fraction, causes):
        """Diagnosis of the pores of 300 particles by a recipe of 0.4 and a void for every other particle."""
        self.succeed("generate", "vem", "--particles", "300", "--voids", str(voids), "--volume-fraction", str(volume_fraction), "--radius",
                     "0.25um", "--seed", "9", "--quiet", "-o", "sample.h5")
        curve = self.succeed_json("characterize", "sample.h5", "--only", "pores", "--radii", "40", "-o", "pores.h5")["pore_curve"]
        self.write("pores.csv", "pore_radius [m],exclusion_probability\n" +
                   "".join(f"{r},{p}\n" for r, p in zip(curve["radius"], curve["exclusion_probability"])))
        self.experiment('generator = "vem"', "pore-curve", "pores", particles=120)
        return self.succeed_json("diagnose", "experiment.toml", "-o", "results", "--causes", causes, "--bootstrap", "299")

    def test_a_denser_sample_is_made_with_more_particles_in_the_volume(self):
        found = self.pores_of_void_expansion(150, 0.44, "volume-fraction")
        call = found["extended_structures"][0].split()
        self.assertAlmostEqual(float(call[call.index("--volume-fraction") + 1]), 0.44, delta=0.015)
        self.assertAlmostEqual(found["causes"][0]["parameters"]["volume_fraction_over_stated"]["value"], 1.1, delta=0.04)

    def test_structures_are_made_again_by_the_words_of_generate(self):
        """The sample has fewer voids than the recipe."""
        found = self.pores_of_void_expansion(45, 0.4, "volume-fraction,coordination,heterogeneity")
        self.assertEqual(found["causes"][0]["name"], "heterogeneity")
        self.assertEqual(len(found["extended_structures"]), 2)
        voids = found["causes"][0]["parameters"]["voids_per_particle"]["value"]
        self.assertIn(f"--voids {round(120 * voids)} ", found["extended_structures"][0])
        self.succeed(*found["extended_structures"][0].split()[1:], "--quiet", "-o", "again.h5")
        cache = (self.folder / "results" / "simulations.txt").read_text()
        for words in ("--voids 15 ", "--target-coordination 5.1 ", "--volume-fraction 0.34 "):
            self.assertIn(words, cache)

    def test_refusals(self):
        self.write("pores.csv", "pore_radius [um],exclusion_probability\n" + "".join(f"{0.02 * k},{1 / (1 + k)}\n" for k in range(12)))
        self.experiment('generator = "brownian"', "pore-curve", "pores")
        self.refuse_experiment("structures.surface_potential")
        self.experiment('generator = "brownian"\nsurface_potential = "60 mV"', "pore-curve", "pores")
        self.refuse_experiment(("barrier", "--surface-potential 0.06"))
        self.copy_of_packing()
        self.write("experiment.toml", '[sample]\nparticle_radius = "0.25 um"\n[structures]\nfiles = ["packing.h5"]\n' +
                   TABLE.format(kind="pore-curve", name="pores"))
        self.refuse_experiment("no cause")
        self.experiment('generator = "vem"\ntarget_coordination = 7', "pore-curve", "pores")
        self.refuse_experiment("target-coordination")


if __name__ == "__main__":
    unittest.main()
