# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula dataset: bad sweeps end before anything runs."""

import unittest

from support import ProgramTest


class Sweeps(ProgramTest):
    """Bad sweeps end before anything runs."""

    GOOD = '[[generate]]\nverb = "vem"\nparticles = 60\nvolume-fraction = 0.4\nradius = "0.25um"\n'

    def refuse(self, text, *says):
        self.write("sweep.toml", text)
        for verb in ("run", "plan"):
            output = ["-o", "set.h5"] if verb == "run" else []
            self.fail_with(2, "dataset", verb, "sweep.toml", *output, says=["sweep.toml", *says])

    def test_not_toml(self):
        self.refuse("a =", "line 1")

    def test_no_generator(self):
        self.refuse('title = "x"\n', "[[generate]]")

    def test_unknown_keys(self):
        self.refuse('titel = "x"\n' + self.GOOD, "'titel'", "did you mean 'title'?")
        self.refuse(self.GOOD + "[desing]\nkind = 'grid'\n", "'desing'", "did you mean 'design'?")

    def test_unknown_generator(self):
        self.refuse(self.GOOD.replace('"vem"', '"vme"'), "'verb'", "did you mean 'vem'?")
        self.refuse(self.GOOD.replace('verb = "vem"\n', ""), "'verb'", "is missing")

    def test_unknown_option(self):
        self.refuse(self.GOOD + "volume_fraction = 0.3\n", "[[generate]]", "'volume_fraction'", "did you mean 'volume-fraction'?")
        self.refuse(self.GOOD + "[shear]\nmehod = 'linear'\n", "[shear]", "'mehod'", "did you mean 'method'?")

    def test_options_without_place(self):
        self.refuse(self.GOOD + 'output = "a.h5"\n', "'output'", "has no place in a set")
        self.refuse(self.GOOD + '[shear]\nmethod = "dem"\ncheckpoint = "a"\n', "'checkpoint'", "has no place in a set")

    def test_empty_list(self):
        self.refuse(self.GOOD + "voids = []\n", "'voids'", "empty list")

    def test_values_twice(self):
        self.refuse(self.GOOD + "voids = [10, 20, 10]\n", "'voids'", "twice")

    def test_same_structure_twice(self):
        self.refuse(self.GOOD + self.GOOD, "same options")
        self.refuse(self.GOOD + self.GOOD + "seed = 1\n", "same options")  # which is the default
        self.refuse(self.GOOD + self.GOOD + 'contact-tolerance = "0.01"\n', "same options")

    def test_nested_values(self):
        self.refuse(self.GOOD + "voids = [[10]]\n", "'voids'", "must be a number")
        self.refuse(self.GOOD + "voids = 2024-01-01\n", "'voids'", "must be a number")

    def test_ranges(self):
        for given, says in (("{ from = 1, to = 5 }", "needs 'steps'"), ("{ to = 5, steps = 2 }", "without 'from'"),
                            ("{ from = 5, to = 1, steps = 2 }", "must run upwards"), ("{ from = 1, to = 1, steps = 2 }", "must run upwards"),
                            ("{ from = 0, to = 9, steps = 3, scale = 'log' }", "above 0"), ("{ from = 1, to = 9, steps = 1 }", "'steps'"),
                            ("{ from = 1, to = 3, steps = 9 }", "more steps than values"), ("{ from = 1, to = 9, step = 3 }", "did you mean 'steps'?"),
                            ("{ from = 1, to = 9, steps = 3, scale = 'ln' }", "'scale'"), ("{ from = '1um', to = 9, steps = 3 }", "'voids'")):
            with self.subTest(range=given):
                self.refuse(self.GOOD + f"voids = {given}\n", "'voids'", says)

    def test_range_of_texts(self):
        self.refuse(self.GOOD + "size-distribution = { from = 1, to = 2, steps = 2 }\n", "takes no range")

    def test_design(self):
        many = self.GOOD + "voids = { from = 10, to = 30 }\n"
        self.refuse(many + "[design]\nkind = 'gird'\n", "[design]", "did you mean 'grid'?")
        self.refuse(many + "[design]\nkind = 'sobol'\n", "'samples'", "is missing")
        self.refuse(many + "[design]\nkind = 'sobol'\nsamples = 0\n", "'samples'", "from 1")
        self.refuse(many + "[design]\nkind = 'sobol'\nsamples = 4\nseed = 3\n", "'seed'")
        self.refuse(self.GOOD + "[design]\nkind = 'grid'\nsamples = 4\n", "'samples'")
        self.refuse(many.replace("30 }", "30, steps = 3 }") + "[design]\nkind = 'sobol'\nsamples = 4\n", "'steps'")

    def test_too_many_structures(self):
        self.refuse(self.GOOD + "voids = { from = 1, to = 60, steps = 60 }\nreplicates = 200000\n", "more than 200000 structures")
        self.refuse(self.GOOD + "seed = { from = 1, to = 1000000000, steps = 1000000000 }\n", "'seed'")

    def test_replicates(self):
        self.refuse(self.GOOD + "replicates = 0\n", "'replicates'")
        self.refuse(self.GOOD + "replicates = 2\nseed = [1, 2]\n", "'replicates'", "seed")
        self.refuse(self.GOOD + "[shear]\nreplicates = 2\n", "[shear]", "'replicates'")

    def test_values_that_a_verb_refuses(self):
        self.refuse(self.GOOD.replace("0.4", "[0.4, 0.9]"), "[[generate]]", "volume-fraction", "out of range")
        self.refuse(self.GOOD.replace('"0.25um"', "0.25"), "radius", "has no unit")
        self.refuse(self.GOOD + "[shear]\nmethod = ['linear', 'quasistatic']\nramp = 0.1\n", "[shear]", "ramp is read only with")
        self.refuse(self.GOOD + "[characterize]\nonly = 'dooh'\n", "[characterize]", "did you mean 'doh'?")
        self.refuse('[[generate]]\nverb = "brownian"\nvolume-fraction = 0.2\nradius = "0.25um"\nsurface-potential = "0mV"\n', "stop-time")

    def test_card(self):
        self.refuse("title = 3\n" + self.GOOD, "'title'", "text")

    def test_verbs_without_a_name(self):
        self.fail_with(2, "dataset", says="'dataset' needs what to do")
        self.fail_with(2, "dataset", "rum", says="did you mean 'dataset run'?")


if __name__ == "__main__":
    unittest.main()
