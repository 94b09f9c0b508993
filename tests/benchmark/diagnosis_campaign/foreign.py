# SPDX-License-Identifier: GPL-3.0-or-later
"""Effects that the catalogue never had, by formulas of textbooks and papers on rheometry. Nothing here comes from the diagnosis: its program, its mechanisms
and the other effects of this campaign are not used. Written before any threshold of the verdict was set.

Each effect says which links of the chain and which axes a right verdict may state: links cannot be told apart where the formula acts on G* alike. Effects
with an even number are the half on which thresholds are set, those with an odd number the half that is reported.

Sources: Macosko, Rheology (1994); Ewoldt, Johnston, Caretta, in Complex Fluids in Biological Systems (2015) 207; Ferry, Viscoelastic Properties of Polymers
(1980); Crank, The Mathematics of Diffusion (1975); Bird, Armstrong, Hassager, Dynamics of Polymeric Liquids 1 (1987); and the papers named at each effect."""

from dataclasses import dataclass, field, replace
from math import gamma, pi

import numpy

from days import GAP, PLATE, SMALL_STRAIN, full_day, long_day, slow_day

TORQUE, PHASE, SAMPLE = 0.02, 0.004, 0.08  # errors of a row, relative and in rad, and of the level of a sample
GAINS = (100, 400)                         # chi-square that the true formula explains
LARGEST_STRAIN = 4e-4                      # of the sweeps
RATES = numpy.geomspace(0.01, 100, 13)     # of the flow of an oil [1/s]


def wave(table):
    """Angular frequency."""
    return 2 * pi * table.frequency


def clock(table):
    """Since the sample was filled in [s]."""
    return table.start + table.time


def stress_per_torque(table):
    """Of plates, at the rim (Macosko, ch. 5)."""
    return 2 / (pi * table.plate**3)


def tool_stiffness(table):
    """Torque over angle of a sample of 1 Pa between plates [m^3]."""
    return pi * table.plate**4 / (2 * table.gap)


# Of each effect the apparent G* from the true one, at a strength x.

def resonance(modulus, table, x):
    """Torsional resonance of shaft and coupling above the range (Walters, Rheometry (1975), ch. 6)."""
    ratio = wave(table) / (2 * pi * 60)
    return modulus * (1 + x * ratio**2 / (1 - ratio**2 + 0.1j * ratio))


def torque_nonlinearity(modulus, table, x):
    """A transducer whose reading is not linear in the torque (Macosko, ch. 8)."""
    torque = abs(modulus) * table.strain / stress_per_torque(table)
    return modulus * (1 + x * torque / 1e-3)


def surface_torque(modulus, table, x):
    """A constant torque of the contact line, in phase with the angle (Johnston and Ewoldt, Journal of Rheology 57 (2013) 1515)."""
    return modulus + x * 1e-6 * stress_per_torque(table) / table.strain


def viscous_heating(modulus, table, x):
    """A sample that warms with the work of the oscillation, which grows as the strain squared (Bird et al., ch. 4.4)."""
    return modulus / (1 + x * (table.strain / LARGEST_STRAIN)**2 * table.frequency)


def stress_slip(modulus, table, x):
    """Slip that begins at a critical stress (Yoshimura and Prud'homme, Journal of Rheology 32 (1988) 53)."""
    stress = abs(modulus) * table.strain
    slid = x * 1e-10 * numpy.maximum(0, stress - 0.3 * LARGEST_STRAIN * abs(modulus))
    return modulus * table.strain / (table.strain + slid / table.gap)


def dewetting(modulus, table, x):
    """One sample of several lets go of its plate bit by bit: the torque falls with the area (Ewoldt et al., 3.6)."""
    return modulus * (1 - x * clock(table) / 3000 * (table.sample == "B"))


def tilted_plates(modulus, table, x):
    """Plates that are not parallel, by the local gap (Andablo-Reyes, Hidalgo-Alvarez, de Vicente, Journal of Rheology 55 (2011) 981)."""
    radius, angle = numpy.meshgrid((numpy.arange(60) + 0.5) / 60, 2 * pi * (numpy.arange(60) + 0.5) / 60)
    local = lambda gap: numpy.average(gap / (gap + x * 3e-4 * radius * numpy.cos(angle)), weights=radius**3)
    return modulus * numpy.array([local(gap) for gap in table.gap])


def avrami(modulus, table, x):
    """Growth of crystals (Avrami, Journal of Chemical Physics 7 (1939) 1103), exponent 3."""
    return modulus * (1 + x * (1 - numpy.exp(-(clock(table) / 900)**3)))


def critical_gel(modulus, table, x):
    """The relaxation of a gel at its point, exponent 0.5, beside its modulus (Winter and Chambon, Journal of Rheology 30 (1986) 367)."""
    return modulus * (1 + x * gamma(0.5) * (1j * wave(table))**0.5)


def cole_cole(modulus, table, x):
    """A broad relaxation (Cole and Cole, Journal of Chemical Physics 9 (1941) 341; Ferry, ch. 3)."""
    return modulus * (1 + x - x / (1 + (1j * wave(table) / 10)**0.5))


def gent(modulus, table, x):
    """Chains of finite length (Gent, Rubber Chemistry and Technology 69 (1996) 59)."""
    return modulus / (1 - x * (table.strain / LARGEST_STRAIN)**2)


def air_conditioning(modulus, table, x):
    """The room warms and cools every quarter of an hour (Macosko, ch. 8)."""
    return modulus * (1 + x * numpy.sin(2 * pi * clock(table) / 900))


def tool_expansion(modulus, table, x):
    """Shafts that lengthen while they warm up close the gap (Macosko, ch. 8; Laun et al., Pure and Applied Chemistry 86 (2014) 1945)."""
    return modulus * table.gap / (table.gap - x * 3e-4 * (1 - numpy.exp(-clock(table) / 600)))


def late_strain(modulus, table, x):
    """A signal of the strain that comes late (Velankar and Giles, Rheology Bulletin 76 (2007) 8)."""
    return modulus * numpy.exp(1j * wave(table) * x * 1e-3)


def secondary_flow(viscosity, rates, x):
    """Inertia turns the flow: torque grows as the Reynolds number squared (Turian, Industrial and Engineering Chemistry Fundamentals 11 (1972) 361)."""
    return viscosity * (1 + x * (rates / RATES[-1])**2)


def oil_heating(viscosity, rates, x):
    """An oil that the flow warms, by its Brinkman number (Bird et al., ch. 4.4)."""
    brinkman = x * 100 * (rates / RATES[-1])**2
    return viscosity * numpy.log(numpy.sqrt(1 + brinkman / 8) + numpy.sqrt(brinkman / 8))**2 / (brinkman / 8)


def receding_rim(modulus, table, x):
    """The rim moves inwards at one speed while solvent is lost: torque as the fourth power of the radius (Ewoldt et al., 3.6)."""
    return modulus * (1 - x * clock(table) / 1e4 * PLATE / table.plate)**4


def melting(modulus, table, x):
    """Bonds go one after the other: a power of the distance from the threshold (Stauffer and Aharony, Introduction to Percolation Theory (1994), ch. 5)."""
    return modulus * (1 - 0.5 * x * clock(table) / 8000)**2.1


def bearing_stiffness(modulus, table, x):
    """The bearing holds its rotor as a weak spring (Laeuger and Stettin, Journal of Rheology 60 (2016) 393)."""
    return modulus + x * 1e-2 / tool_stiffness(table)


def elastoplastic(modulus, table, x):
    """An elastic material that yields at one stress (Masing 1926; Hardin and Drnevich, ASCE 98 (1972) 667): first harmonic in closed form."""
    load = numpy.maximum(1, x * table.strain / LARGEST_STRAIN * 3)
    angle = numpy.arccos(1 - 2 / load)
    storage = (angle - numpy.sin(2 * angle) / 2) / pi
    loss = 4 / (pi * load) * (1 - 1 / load)
    return modulus * (storage + 1j * loss)


def backlash(modulus, table, x):
    """A coupling with play takes a part of the angle (Macosko, ch. 8)."""
    return modulus * (1 - numpy.minimum(0.99, x * SMALL_STRAIN * GAP / (table.strain * table.gap)))


def swelling(modulus, table, x):
    """Solvent from a wet chamber goes in through the rim, as the root of the time (Crank, ch. 5)."""
    return modulus * (1 - 2 * x * numpy.sqrt(clock(table) / 1e4) * PLATE / table.plate)


def torque_zero_drift(modulus, table, x):
    """The zero of the torque moves with the time (Macosko, ch. 8), in phase with the angle."""
    return modulus + x * 1e-5 * clock(table) / 3600 * stress_per_torque(table) / table.strain


def encoder_noise(modulus, table, x):
    """The angle is read with noise, which adds to its amplitude (Ewoldt et al., 3.1)."""
    return modulus / numpy.sqrt(1 + (x * SMALL_STRAIN * GAP / (table.strain * table.gap))**2)


@dataclass(frozen=True)
class Foreign:
    name: str
    links: tuple
    axes: tuple
    act: object = None
    weakest: float = 1e-4
    strongest: float = 1.0
    day: object = None
    strength: float = 0.0


def usual_day():
    return full_day(LARGEST_STRAIN, 14)


EFFECTS = [
    Foreign("resonance", ("tool", "material"), ("frequency",), resonance, 1e-4, 3),
    Foreign("torque-nonlinearity", ("tool", "material"), ("strain", "stress", "radius"), torque_nonlinearity, 1e-4, 30),
    Foreign("surface-torque", ("tool", "material"), ("strain", "stress"), surface_torque, 1e-5, 100),
    Foreign("viscous-heating", ("material", "history"), ("strain", "stress"), viscous_heating),
    Foreign("stress-slip", ("geometry", "material"), ("strain", "stress", "gap"), stress_slip, 1e-3, 1e3),
    Foreign("dewetting", ("errors", "geometry", "history"), ("sample", "time"), dewetting),
    Foreign("tilted-plates", ("geometry",), ("gap",), tilted_plates, 1e-2, 1.0),
    Foreign("avrami", ("history",), ("time",), avrami),
    Foreign("critical-gel", ("material",), ("frequency",), critical_gel),
    Foreign("cole-cole", ("material",), ("frequency",), cole_cole, 1e-3, 10),
    Foreign("gent", ("material",), ("strain", "stress"), gent, 1e-3, 0.95),
    Foreign("air-conditioning", ("history",), ("time",), air_conditioning, 1e-3, 0.9),
    Foreign("tool-expansion", ("geometry", "history"), ("time", "gap"), tool_expansion, 1e-3, 0.9, slow_day),
    Foreign("late-strain", ("tool", "material"), ("frequency",), late_strain, 1e-4, 3),
    Foreign("secondary-flow", ("geometry", "tool", "material"), ("shear_rate",), secondary_flow),
    Foreign("oil-heating", ("material", "history"), ("shear_rate",), oil_heating, 1e-4, 10),
    Foreign("receding-rim", ("geometry", "history"), ("time", "radius"), receding_rim, 1e-4, 0.9, long_day),
    Foreign("melting", ("history",), ("time",), melting, 1e-4, 0.9, long_day),
    Foreign("bearing-stiffness", ("tool",), ("gap", "radius"), bearing_stiffness, 1e-3, 1e4),
    Foreign("elastoplastic", ("material",), ("strain", "stress"), elastoplastic, 0.334, 5),
    Foreign("backlash", ("tool", "material"), ("strain", "stress"), backlash, 1e-3, 0.95),
    Foreign("swelling", ("geometry", "history"), ("time", "radius"), swelling, 1e-4, 0.45, long_day),
    Foreign("torque-zero-drift", ("tool", "history"), ("time", "strain"), torque_zero_drift, 1e-4, 1e3),
    Foreign("encoder-noise", ("tool", "material"), ("strain", "stress"), encoder_noise, 1e-3, 3),
]
FLOWS = ("secondary-flow", "oil-heating")


@dataclass
class Gel:
    """An elastic gel between plates."""
    hidden: Foreign
    stiffness: float  # its modulus [Pa]
    tables: list
    moduli: list = field(default_factory=list)

    def shown(self, table, level=1.0):
        modulus = numpy.full(len(table.strain), level * self.stiffness, dtype=complex)
        return self.hidden.act(modulus, table, self.hidden.strength)

    def gain(self, _material=None):
        """By how much chi-square falls against a gel whose samples have a level each."""
        total = 0.0
        for name in {table.sample for table in self.tables}:
            own = [self.shown(table) / self.stiffness for table in self.tables if table.sample == name]
            apart = numpy.concatenate(own)
            size = numpy.maximum(abs(apart), 1e-9)
            departure = numpy.concatenate([(apart.real - 1) / (TORQUE * size), apart.imag / numpy.hypot(PHASE * size, TORQUE * abs(apart.imag)), [0]])
            level = numpy.concatenate([1 / (TORQUE * size), numpy.zeros(len(apart)), [1 / SAMPLE]])
            total += departure @ departure - (departure @ level)**2 / (level @ level)
        return float(total)

    def write(self, material, folder, generator):
        folder.mkdir(parents=True, exist_ok=True)
        structures = [str(material.known_structure(number)) for number in (0, 1)]
        lines = ["[sample]", 'particle_radius = "0.25 um"', "volume_fraction = 0.4", "", "[instrument]", 'geometry = "plate-plate"',
                 f"plate_radius = {PLATE}", f"gap = {GAP}", "", "[structures]", f"files = {structures}", ""]
        offsets = {}
        for number, table in enumerate(self.tables):
            level = offsets.setdefault(table.sample, 1 + SAMPLE * generator.standard_normal())
            clean = self.shown(table, level)
            self.moduli.append(clean)
            size = 1 + TORQUE * generator.standard_normal(len(clean))
            measured = clean * size * numpy.exp(1j * PHASE * generator.standard_normal(len(clean)))
            columns = {"strain [1]": table.strain, "frequency [Hz]": table.frequency, "time [s]": table.time, "gap [m]": table.gap,
                       "storage_modulus [Pa]": measured.real, "loss_modulus [Pa]": measured.imag}
            rows = [",".join(columns)] + [",".join(f"{value:.9g}" for value in row) for row in zip(*columns.values())]
            (folder / f"table{number}.csv").write_text("\n".join(rows) + "\n")
            lines += ["[[measurement]]", f'kind = "{table.kind}"', f'file = "table{number}.csv"', f'sample = "{table.sample}"',
                      f"run_order = {table.order}", f"values = {{ plate_radius = {table.plate} }}", ""]
        path = folder / "experiment.toml"
        path.write_text("\n".join(lines))
        return path


@dataclass
class Oil:
    """Three fillings of an oil of known viscosity in steady flow."""
    hidden: Foreign
    stiffness: float  # its viscosity [Pa.s]
    moduli: list = field(default_factory=list)

    def shown(self):
        return self.hidden.act(numpy.full(len(RATES), self.stiffness), RATES, self.hidden.strength)

    def gain(self, _material=None):
        apart = self.shown() / self.stiffness
        departure = numpy.append((apart - 1) / (TORQUE * apart), 0)
        level = numpy.append(1 / (TORQUE * apart), 1 / 0.01)
        return float(3 * (departure @ departure - (departure @ level)**2 / (level @ level)))

    def write(self, _material, folder, generator):
        folder.mkdir(parents=True, exist_ok=True)
        lines = ["[material]", 'kind = "newtonian"', f"viscosity = {self.stiffness:.9g}", "", "[instrument]", 'geometry = "plate-plate"',
                 f"plate_radius = {PLATE}", f"gap = {GAP}", ""]
        for number in range(3):
            level = 1 + 0.01 * generator.standard_normal()
            measured = level * self.shown() * (1 + TORQUE * generator.standard_normal(len(RATES)))
            rows = ["shear_rate [1/s],viscosity [Pa.s]"] + [f"{rate:.9g},{value:.9g}" for rate, value in zip(RATES, measured)]
            (folder / f"flow{number}.csv").write_text("\n".join(rows) + "\n")
            lines += ["[[measurement]]", 'kind = "flow-curve"', f'file = "flow{number}.csv"', f'sample = "{"ABC"[number]}"', ""]
        path = folder / "experiment.toml"
        path.write_text("\n".join(lines))
        return path


def session_of(effect, generator):
    stiffness = float(numpy.exp(generator.uniform(numpy.log(2e5), numpy.log(2e6))))
    if effect.name in FLOWS:
        return Oil(effect, stiffness / 1e6)
    return Gel(effect, stiffness, (effect.day or usual_day)())


def foreign(generator, _material, number=0):
    """The effect of this number, as strong as a drawn gain asks for, or as it may be."""
    effect = EFFECTS[number % len(EFFECTS)]
    wanted = float(numpy.exp(generator.uniform(*numpy.log(GAINS))))
    session = session_of(effect, generator)
    at = lambda place: replace(session, hidden=replace(effect, strength=effect.weakest * (effect.strongest / effect.weakest)**place))
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if at(middle).gain() < wanted else (low, middle)
    return at(high)


if __name__ == "__main__":
    for count, one in enumerate(EFFECTS):
        drawn = foreign(numpy.random.default_rng([1, count]), None, count)
        print(f"{one.name:22} gain {drawn.gain():8.1f} strength {drawn.hidden.strength:.3g} of {one.weakest:g} .. {one.strongest:g}")
