# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequency sweeps of a material without a model that relaxes as one of eight formulas (Ferry, Viscoelastic Properties of Polymers (1980), ch. 1 and 3;
Cole and Cole, Journal of Chemical Physics 9 (1941) 341), with nothing hidden: the experiment file and the tables."""

from dataclasses import dataclass, field

import numpy

from session import Hidden

PHASE = 0.005  # error of a row [rad]


def maxwell(frequency, modulus, time):
    return modulus * 1j * frequency * time / (1 + 1j * frequency * time)


def formulas(time):
    """G* [Pa] by the angular frequency; `time` [s] lies within the sweep or beyond."""
    return {"solid": lambda w: 500 * (1j * w)**0.06, "fluid": lambda w: 1j * w * 2 / (1 + 0.003j * w) + 1, "critical gel": lambda w: 30 * (1j * w)**0.5,
            "Maxwell": lambda w: maxwell(w, 300, time) + 2, "two times": lambda w: maxwell(w, 100, time) + maxwell(w, 80, time / 30) + 20 + 0.05j * w,
            "Kelvin and Voigt": lambda w: 200 + 3j * w, "emulsion": lambda w: 150 * (1 + 0.05 * (1j * w)**0.5),
            "Cole and Cole": lambda w: 20 + 400 / (1 + (1j * w * time)**-0.7)}


@dataclass
class Sweeps:
    modulus: object
    frequencies: numpy.ndarray  # angular [rad/s], in the order of the sweep
    samples: int
    error: float                # of a row, relative
    scatter: float              # of the samples
    hidden: Hidden = field(default_factory=Hidden)
    stiffness: float = field(default=float("nan"))

    def gain(self, _material=None):
        return 0.0

    def write(self, _material, folder, generator):
        folder.mkdir(parents=True, exist_ok=True)
        lines = ["[material]", 'kind = "smooth"', "", "[instrument]", 'geometry = "plate-plate"', "plate_radius = 0.0125", "gap = 0.001", ""]
        for number in range(self.samples):
            shown = self.modulus(self.frequencies) * (1 + self.scatter * generator.standard_normal())
            shown = shown * (1 + self.error * generator.standard_normal(len(shown))) * numpy.exp(1j * PHASE * generator.standard_normal(len(shown)))
            rows = ["angular_frequency [rad/s],storage_modulus [Pa],loss_modulus [Pa]"]
            rows += [f"{w:.9g},{value.real:.9g},{value.imag:.9g}" for w, value in zip(self.frequencies, shown)]
            (folder / f"sweep{number}.csv").write_text("\n".join(rows) + "\n")
            lines += ["[[measurement]]", 'kind = "frequency-sweep"', f'file = "sweep{number}.csv"', f'sample = "{"ABC"[number]}"', "values = { strain = 0.01 }", ""]
        path = folder / "experiment.toml"
        path.write_text("\n".join(lines))
        return path


def null_relaxation(generator, _material):
    choices = formulas(10**generator.uniform(-2, 1))
    frequencies = 2 * numpy.pi * numpy.geomspace(10**generator.uniform(-2, -0.5), 10**generator.uniform(0.7, 1.6), int(generator.integers(12, 30)))
    return Sweeps(choices[generator.choice(list(choices))], frequencies if generator.random() < 0.5 else frequencies[::-1], int(generator.integers(1, 4)),
                  float(generator.choice([0.01, 0.02, 0.04])), float(generator.choice([0.003, 0.03, 0.1])))
