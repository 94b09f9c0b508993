# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of a whole diagnosis share: structures, tables and the experiment around them."""

import json

from support import ProgramTest

PLATES = '[instrument]\ngeometry = "plate-plate"\nplate_radius = "12.5 mm"\ngap = "1 mm"\n'
STIFFNESS = 40  # N/m, of the measured particles; the simulation's own unit is 100 N/m


class Tables(ProgramTest):
    def structure(self, name, seed, particles=150, coordination=4.7, fraction=0.4):
        self.succeed("generate", "vem", "--particles", particles, "--voids", particles // 2, "--volume-fraction", fraction, "--radius",
                     "0.25um", "--target-coordination", coordination, "--seed", seed, "--quiet", "-o", name)

    def modulus(self, name):
        """By the linear method, for particles of 100 N/m."""
        return self.succeed_json("shear", name, "-o", "sheared.h5", "--force")["storage_modulus"]["mean"]

    def table(self, name, heads, rows):
        self.write(name, "\n".join([",".join(heads)] + [",".join(f"{cell:.9g}" for cell in row) for row in rows]) + "\n")

    def diagnosis(self, text, *words):
        self.write("experiment.toml", text)
        said = self.succeed_json("diagnose", "experiment.toml", "-o", "results", "--force", "--bootstrap", 199, *words)
        written = json.loads((self.folder / "results" / "diagnosis.json").read_text())
        self.assertEqual(written["rows"], said["rows"])
        return written

    def refuse(self, text, *says):
        self.write("experiment.toml", text)
        self.refuse_experiment(says)
