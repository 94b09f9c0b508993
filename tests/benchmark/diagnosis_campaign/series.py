# SPDX-License-Identifier: GPL-3.0-or-later
"""Moduli of structures of several coordinations, on materials with a hidden contact, as an experiment file with a structure series."""

from dataclasses import dataclass

import numpy

from material import COORDINATIONS, SERIES_KNOWN, SERIES_STRUCTURES, STIFFNESS
from session import Hidden

ERROR = 0.03  # of a measured modulus, relative


@dataclass
class Series:
    hidden: Hidden
    stiffness: float

    def moduli(self, material, contact):
        """Mean of each row's structures and the standard error that their scatter leaves."""
        rows = numpy.array([[material.modulus(number, *contact, coordination) for number in range(SERIES_STRUCTURES)]
                            for coordination in COORDINATIONS]) * self.stiffness / STIFFNESS
        scatter = numpy.sqrt(numpy.mean(numpy.var(rows, axis=1, ddof=1)))
        return rows.mean(axis=1), scatter / numpy.sqrt(SERIES_STRUCTURES)

    def write(self, material, folder, generator):
        """The experiment file and its table."""
        folder.mkdir(parents=True, exist_ok=True)
        clean, scatter = self.moduli(material, self.hidden.contact or ("", 0.0))
        measured = clean * (1 + ERROR * generator.standard_normal(len(clean)))
        errors = numpy.hypot(ERROR * measured, scatter)
        rows = ["coordination [1],storage_modulus [Pa],error [Pa]"]
        rows += [f"{c:.9g},{m:.9g},{e:.9g}" for c, m, e in zip(COORDINATIONS, measured, errors)]
        (folder / "series.csv").write_text("\n".join(rows) + "\n")
        files = [str(material.known_structure(number, coordination)) for coordination in COORDINATIONS for number in range(SERIES_KNOWN)]
        groups = [row + 1 for row in range(len(COORDINATIONS)) for _ in range(SERIES_KNOWN)]
        path = folder / "experiment.toml"
        path.write_text(f"""[sample]
particle_radius = "0.25 um"
volume_fraction = 0.4

[structures]
files = {files}
groups = {groups}

[[measurement]]
kind = "structure-series"
file = "series.csv"
standard_errors = {{ storage_modulus = "error" }}
""")
        return path

    def gain(self, material):
        """By how much chi-square falls when the true model takes the place of the base model, the stiffness fitted in both."""
        true, scatter = self.moduli(material, self.hidden.contact or ("", 0.0))
        base, _ = self.moduli(material, ("", 0.0))
        deviation = numpy.hypot(ERROR * true, scatter)
        base, true = base / deviation, true / deviation
        return float(true @ true - (true @ base)**2 / (base @ base))
