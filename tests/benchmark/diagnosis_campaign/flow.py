# SPDX-License-Identifier: GPL-3.0-or-later
"""An oil in steady flow between plates, from its torque: the experiment file and the tables."""

from dataclasses import dataclass, field

import numpy

from session import Hidden

GAP = 1e-3
RATES = numpy.geomspace(0.01, 100, 13)
ERROR = 0.02     # of a row, relative
SAMPLE = 0.01    # of a filling


@dataclass
class Flow:
    hidden: Hidden
    viscosity: float
    plates: tuple = (12.5e-3,) * 3      # radius under each filling
    gaps: tuple = (GAP,) * 3
    stiffness: float = field(default=float("nan"))

    def shown(self, plate, gap):
        """Viscosity that the instrument takes from torque, speed and the gap that it believes in."""
        hidden = self.hidden
        speed = RATES * gap / plate
        true_rate = speed * plate / (gap + hidden.gap_error)
        thinning = 1 + hidden.thinning / true_rate**hidden.exponent
        torque = numpy.pi * plate**3 / 2 * self.viscosity * thinning * true_rate + hidden.torque + hidden.braking * speed
        return 2 * torque / (numpy.pi * plate**3) / RATES

    def write(self, material, folder, generator):
        folder.mkdir(parents=True, exist_ok=True)
        lines = ["[material]", 'kind = "newtonian"', f"viscosity = {self.viscosity:.9g}", "", "[instrument]", 'geometry = "plate-plate"',
                 f"plate_radius = {self.plates[0]}", f"gap = {GAP}", ""]
        for number, (plate, gap) in enumerate(zip(self.plates, self.gaps)):
            level = 1 + SAMPLE * generator.standard_normal()
            measured = level * self.shown(plate, gap) * (1 + ERROR * generator.standard_normal(len(RATES)))
            rows = ["shear_rate [1/s],viscosity [Pa.s]"] + [f"{rate:.9g},{value:.9g}" for rate, value in zip(RATES, measured)]
            (folder / f"flow{number}.csv").write_text("\n".join(rows) + "\n")
            lines += ["[[measurement]]", 'kind = "flow-curve"', f'file = "flow{number}.csv"', f'sample = "{"ABCDEF"[number]}"',
                      f"values = {{ plate_radius = {plate}, gap = {gap} }}", ""]
        path = folder / "experiment.toml"
        path.write_text("\n".join(lines))
        return path

    def gain(self, material):
        """By how much chi-square falls against the oil alone, whose level the fillings leave open."""
        total = 0.0
        for plate, gap in zip(self.plates, self.gaps):
            departure = (self.shown(plate, gap) / self.viscosity - 1) / ERROR
            own = numpy.append(numpy.full(len(RATES), SAMPLE / ERROR), 1.0)
            departure = numpy.append(departure, 0.0)
            total += departure @ departure - (departure @ own)**2 / (own @ own)
        return float(total)
