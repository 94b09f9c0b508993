# SPDX-License-Identifier: GPL-3.0-or-later
"""A day at the rheometer: what torque and angle the instrument would read on a material with hidden effects, written as an experiment file and
tables. Formulas are those of a plate-plate or cone-plate rheometer, from torque and angle, not those of the diagnosis."""

from dataclasses import dataclass, field, replace

import numpy

import settling as weight
from days import CONE, GAP, PLATE, SMALL_STRAIN, sweep
from material import FRACTIONS_KNOWN, KNOWN_EACH


FORCE_ERROR = 0.01  # of a normal force that is read [N]


@dataclass(frozen=True)
class Hidden:
    """What is switched on. `modulus` takes strain, frequency and time of a table's rows."""
    name: str = "nothing"
    loss: tuple = ()        # ratio, exponent
    loads: tuple = ()       # largest load of the amplitude sweep
    ageing: float = 0.0     # per decade
    slip: float = 0.0       # m/Pa
    gap_error: float = 0.0  # m
    compliance: float = 0.0
    inertia: float = 0.0
    resonance: tuple = ()   # size, frequency [Hz]
    drift: float = 0.0      # stress offset after ten minutes over G times the small strain
    warmth: tuple = ()      # size, period [s]
    contact: tuple = ()     # cause, value; or "contacts-removed", share of the particles' bonds; "missing-contacts", share; "volume-fraction", true one
    viscosity: float = 0.0  # of the solvent, felt by the particles [Pa.s]
    bump: tuple = ()        # size, place [Hz], width in decades: of G'' over G'
    power: tuple = ()       # exponent, time [s]: stiffness as a power of the age
    setting: tuple = ()     # growth, time [s]: stiffness towards an end
    cooling: tuple = ()     # difference at the start, time [s]
    drying: tuple = ()      # volume lost under a wide plate [1/s], exponent of the modulus in the volume fraction
    skin: float = 0.0       # growth of the stiffness of a skin around the rim [N/(m s)]
    fracture: tuple = ()    # strain at a gap of 1 mm, power of the torque that is left
    softening: tuple = ()   # strain at which half of the contacts are open, exponent, loss there over the modulus
    stiffening: tuple = ()  # strain at which bonds pull twice as much as springs, exponent of what is more
    loss_of_hold: tuple = ()  # sample, row among all its rows, share of the torque that remains
    dashpot: float = 0.0    # viscosity of a contact over its stiffness [s]
    relaxing: tuple = ()    # part of a contact that relaxes over the rest, time [s]
    thixotropy: tuple = ()  # breaking per unit of strain, time in which bonds form again [s]
    settled: tuple = ()     # difference of the volume fraction between plates at the usual gap in the end, time there [s]
    backflow: tuple = ()    # growth, mobility of the solvent [m2/(Pa s)] (poroelastic.py)
    rates: tuple = ()       # frequency [Hz] and largest load of a sweep, for each frequency
    braking: float = 0.0    # torque of the bearing over the speed [N.m.s]
    turned: float = 0.0     # of the phase, by the instrument [rad]
    density: float = 0.0    # of a sample through which waves pass [kg/m3]
    overfill: float = 0.0   # by which the sample is wider than its plate [m]
    torque: float = 0.0     # that does not come from the sample [N.m]
    thinning: float = 0.0   # of the viscosity at a rate of 1/s
    exponent: float = 0.5   # of the rate, by which it is the less
    images: tuple = ()      # errors in the plane and along z [m], shares of missed and of false centres
    sizes: float = 0.0      # relative deviation of the particles' radii
    potential: float = 0.0  # of the surfaces on which particles coagulated [V]
    ions: float = 1.0       # among which they did, over those of a Debye length of 10 nm
    hertz: float = 0.0      # overlap of Hertz contacts at rest, over the radius
    pressure: float = 0.0   # that presses contacts as their adhesion does, where plates press them further apart or together [Pa] (pressed.py)
    rim: bool = False       # strain grows along the radius of the plates: bonds break at the rim first


@dataclass(frozen=True)
class Noise:
    torque: float = 0.02   # relative
    phase: float = 0.004   # rad
    sample: float = 0.08
    tail: float = numpy.inf
    correlation: float = 0.0
    wrong_rows: int = 0     # read ten times too large
    slid: str = ""          # a sample that slides between its plates: it shows two fifths of its modulus


@dataclass
class Session:
    tables: list
    hidden: Hidden
    noise: Noise
    stiffness: float
    structure: int
    moduli: list = field(default_factory=list)  # without noise
    known_stiffness: bool = False
    known_structures: tuple = (0, 1)
    storage_only: bool = False
    mean_of: tuple = ()          # structures as large as which together the sample is, in a solvent that drags
    told_noise: bool = False     # the file states the errors that there are
    sheared: bool = False        # before each run, which destroys the structure
    loads: dict = field(default_factory=dict)  # of each sample: pressure at the start, part that remains, time [s]
    tells_load: bool = False     # the tables have a normal force
    two_fractions: bool = False  # the structures of the diagnosis have another volume fraction each

    def write(self, material, folder, generator):
        """The experiment file and its tables."""
        folder.mkdir(parents=True, exist_ok=True)
        structures = [material.known_structure(number) for number in self.known_structures]
        if self.two_fractions:
            structures = [material.known_structure(number, fraction=each) for each in FRACTIONS_KNOWN for number in range(KNOWN_EACH)]
        offsets = {}
        lines = ["[sample]", 'particle_radius = "0.25 um"', "volume_fraction = 0.4", "", "[instrument]", 'geometry = "plate-plate"',
                 f"plate_radius = {PLATE}", f"gap = {GAP}", "", "[structures]", f"files = {[str(each) for each in structures]}", ""]
        if self.known_stiffness:
            lines[3:3] = [f"normal_stiffness = {self.stiffness}", "normal_stiffness_error = 0.05"]
        if self.sheared:
            lines[3:3] = ["sheared_before = true"]
        if self.told_noise:
            lines += ["[noise]", f"stated_relative = {self.noise.torque}", f"stated_phase = {self.noise.phase}",
                      f"stated_sample = {self.noise.sample}", ""]
        wrong = set(generator.choice(sum(len(table.strain) for table in self.tables), self.noise.wrong_rows, replace=False).tolist())
        for number, table in enumerate(self.tables):
            spread = 0.0 if numpy.isfinite(table.viscosity) else self.noise.sample
            offset = offsets.setdefault(table.sample, 1 + spread * generator.standard_normal())
            clean = reading(material, self.sliding(material, table), table, offset)
            self.moduli.append(clean)
            size = 1 + self.noise.torque * errors(generator, self.noise, len(clean))
            measured = clean * size * numpy.exp(1j * self.noise.phase * errors(generator, self.noise, len(clean)))
            first = sum(len(each.strain) for each in self.tables[:number])
            measured *= numpy.array([10.0 if first + row in wrong else 1.0 for row in range(len(clean))])
            columns = {"strain [1]": table.strain, "frequency [Hz]": table.frequency, "time [s]": table.time, "gap [m]": table.gap,
                       "storage_modulus [Pa]": measured.real, "loss_modulus [Pa]": measured.imag}
            if self.tells_load:
                force = numpy.pi * table.plate**2 * pressure_on(self, table)
                columns["normal force [N]"] = force + FORCE_ERROR * generator.standard_normal(len(force))
            if table.cone:
                del columns["gap [m]"]
            if self.storage_only:
                del columns["loss_modulus [Pa]"]
            rows = [",".join(columns)] + [",".join(f"{value:.9g}" for value in row) for row in zip(*columns.values())]
            (folder / f"table{number}.csv").write_text("\n".join(rows) + "\n")
            lines += ["[[measurement]]", f'kind = "{table.kind}"', f'file = "table{number}.csv"', f'sample = "{table.sample}"',
                      f"run_order = {table.order}", f"values = {{ plate_radius = {table.plate} }}"]
            lines += ["rough_plates = true"] * table.rough + ["solvent_trap = true"] * table.trap + [f"fluid_viscosity = {table.viscosity:.9g}"] * bool(numpy.isfinite(table.viscosity))
            lines += [f"cone_angle = {CONE:.9g}"] * table.cone + [""]
        path = folder / "experiment.toml"
        path.write_text("\n".join(lines))
        return path

    def sliding(self, material, table):
        """The session as this table sees it."""
        if table.sample != self.noise.slid:
            return self
        modulus = abs(reading(material, replace(self, hidden=Hidden()), table)[0])
        return replace(self, hidden=replace(self.hidden, slip=0.75 * GAP / modulus))

    def gain(self, material):
        """By how much chi-square falls when the true model takes the place of the base model, stiffness and sample effects fitted in both."""
        base = replace(self, hidden=Hidden())
        names = sorted({table.sample for table in self.tables})
        difference, directions = [], []
        for table in self.tables:
            on, off = reading(material, self, table), reading(material, base, table)
            scatter = (self.noise.torque * abs(on), numpy.hypot(self.noise.phase * abs(on), self.noise.torque * abs(on.imag)))
            for part, deviation in ((numpy.real, scatter[0]), (numpy.imag, scatter[1]))[:1 if self.storage_only else 2]:
                difference.append(part(on - off) / deviation)
                own = numpy.outer(part(off) / deviation, [1.0] + [float(name == table.sample) for name in names])
                directions.append(own)
        difference, directions = numpy.concatenate(difference), numpy.vstack(directions)
        prior = numpy.hstack([numpy.zeros((len(names), 1)), numpy.eye(len(names)) / self.noise.sample])
        if self.known_stiffness:
            prior = numpy.vstack([prior, numpy.eye(1, len(names) + 1) / 0.05])
        directions = numpy.vstack([directions, prior])
        difference = numpy.concatenate([difference, numpy.zeros(len(prior))])
        fit = numpy.linalg.lstsq(directions, difference, rcond=None)[0]
        return float(numpy.sum((difference - directions @ fit)**2))


def follow_up(session, what):
    """The tables that a proposal asks for, on a fresh sample."""
    gaps = numpy.geomspace(GAP / 3, 3 * GAP, 8)
    series = sweep("gap-series", "N", 0, SMALL_STRAIN, 1.0, 60, gap=gaps if "from narrow" in what else gaps[::-1])
    frequencies = numpy.geomspace(0.1, 10, 20)
    strains = numpy.geomspace(SMALL_STRAIN, max(table.strain.max() for table in session.tables), 20)
    if "series of gaps" in what:
        largest = max(abs(reading).max() for reading in session.moduli)
        oil = replace(series, sample="O", viscosity=0.1 * largest / (2 * numpy.pi))
        with_sample = replace(series, rough="rough" in what)
        return [with_sample] * ("oil" not in what or "rough" in what) + [oil] * ("oil" in what)
    if "half the radius" in what:
        return [sweep("frequency-sweep", "N", 0, SMALL_STRAIN, frequencies, 20, plate=PLATE / 2)]
    if "frequency sweep" in what:
        return [sweep("frequency-sweep", "N", 0, SMALL_STRAIN, numpy.geomspace(0.01, 100, 20), 20)]
    if "ten times as long" in what:
        longest = max(table.start + table.time[-1] for table in session.tables)
        long = sweep("time-sweep", "N", 0, numpy.full(20, SMALL_STRAIN), 1.0, 1)
        return [replace(long, time=numpy.geomspace(0.01, 10, 20) * longest, trap="trap" in what)]
    if "again after a rest" in what:
        pair = [sweep("amplitude-sweep", "N", order, strains, 1.0, 30) for order in (0, 1)]
        return [pair[0], replace(pair[1], start=pair[0].time[-1] + 1800)]
    if "ten times the frequency" in what:
        return [sweep("amplitude-sweep", "N", 0, strains, 10.0, 10)]
    if "quarter of the gap" in what:
        return [sweep("amplitude-sweep", "N", 0, strains, 1.0, 10, gap=GAP / 4)]
    if "constant small strain" in what:
        return [sweep("time-sweep", "N", 0, numpy.full(20, SMALL_STRAIN), 1.0, 60)]
    if session.hidden.loads:  # the bank has that sweep only, without waveforms
        return [replace(session.tables[0], sample="N", cone="cone" in what)]
    strains = numpy.geomspace(SMALL_STRAIN, 10 * SMALL_STRAIN, 10)
    down = [sweep("amplitude-sweep", "N", 1, strains[::-1], 1.0, 10)] if "up and down" in what else []
    return [sweep("amplitude-sweep", "N", 0, strains, 1.0, 10), *down]


def true_modulus(material, session, table):
    """Of what is in the gap, row by row."""
    hidden = session.hidden
    if numpy.isfinite(table.viscosity):
        return 2j * numpy.pi * table.frequency * table.viscosity
    if session.mean_of:
        level = numpy.mean([material.elastic(number) for number in session.mean_of])
    elif session.known_stiffness:
        level = material.mean_modulus(*hidden.contact)
    else:
        level = material.modulus(session.structure)
    modulus = numpy.full(len(table.strain), level * session.stiffness / 100, dtype=complex)
    if hidden.loss:
        modulus *= material.losses(session.structure, *hidden.loss, table.frequency)
    if hidden.dashpot:
        modulus *= material.dashpots(session.structure, hidden.dashpot, table.frequency)
    if hidden.relaxing:
        modulus *= material.relaxing(session.structure, *hidden.relaxing, table.frequency)
    if hidden.thixotropy:
        modulus *= material.left_by_bonds(session.structure, share_of_bonds(session, table))
    for frequency, load in hidden.rates:
        if table.kind == "amplitude-sweep" and table.frequency[0] == frequency:
            modulus *= material.mean_rupture(load)
    if hidden.viscosity:
        modulus *= material.mean_drag(hidden.viscosity / session.stiffness, table.frequency, session.mean_of)
    if hidden.loads and table.kind == "amplitude-sweep":
        modulus *= material.mean_breaking(*hidden.loads, rim=hidden.rim and not table.cone)
    age = table.time if session.sheared else table.start + table.time
    if hidden.pressure:
        modulus *= material.pressed(session.structure, pressure_on(session, table) / hidden.pressure)
    if hidden.hertz:
        modulus *= material.hertz(hidden.hertz, table.strain)
    if hidden.ageing:
        modulus *= 1 + hidden.ageing * numpy.log10(1 + age)
    if hidden.bump:
        size, place, width = hidden.bump
        modulus += 1j * size * abs(modulus) * numpy.exp(-0.5 * (numpy.log10(table.frequency / place) / width)**2)
    if hidden.softening:
        half, exponent, loss = hidden.softening
        odds = (table.strain / half)**(2 * exponent)
        opened = odds / (1 + odds)
        modulus *= 1 - opened + 2j * loss * numpy.sqrt(opened * (1 - opened))
    if hidden.stiffening:
        modulus *= stiffened(table.strain, *hidden.stiffening)
    clock = table.start + table.time
    if hidden.power:
        exponent, begin = hidden.power
        modulus *= ((begin + age) / begin)**exponent
    if hidden.setting:
        growth, begin = hidden.setting
        modulus *= 1 + growth - growth / numpy.exp(age / begin)
    if hidden.cooling:
        difference, settling = hidden.cooling
        modulus *= numpy.exp(difference / numpy.exp(clock / settling))
    if hidden.drying and not table.trap:
        rate, exponent = hidden.drying
        lost = rate * clock * 2 * PLATE / table.plate  # of all the solvent: rim over volume is 2 / R
        modulus /= (1 - lost)**exponent
    if hidden.backflow:
        growth, mobility = hidden.backflow
        times, shrunk = material.consolidation(table.plate / table.gap[0])
        modulus *= 1 + growth * numpy.interp(clock * abs(modulus) * mobility / table.gap[0]**2, times, shrunk)
    if hidden.settled:
        difference, time = hidden.settled
        profiles = weight.gradients(clock, time * (table.gap[0] / GAP)**2)
        modulus *= weight.shown(material.layers, profiles, difference * table.gap / GAP)
    if hidden.warmth:
        size, period = hidden.warmth
        modulus *= 1 + size * numpy.sin(2 * numpy.pi * clock / period)
    return modulus


def stiffened(amplitudes, begin, exponent, steps=400):
    """First harmonic of the force of strands over that of springs, moment by moment."""
    sines = numpy.sin(2 * numpy.pi * (numpy.arange(steps) + 0.5) / steps)
    extensions = numpy.outer(amplitudes, sines)
    forces = extensions + extensions * abs(extensions / begin)**exponent
    return 2 * numpy.mean(forces * sines, axis=1) / amplitudes


def with_waves(modulus, density, table, layers=400):
    """Stress at the plate that moves, the other at rest, over that of a sample without mass: a chain of masses and springs."""
    shares = []
    for stiffness, frequency, gap in zip(modulus, table.frequency, table.gap):
        mass = density * (2 * numpy.pi * frequency)**2 * (gap / layers)**2 / stiffness  # over a spring
        moved = numpy.zeros(layers + 1, complex)
        moved[1] = 1
        for place in range(1, layers):
            moved[place + 1] = (2 - mass) * moved[place] - moved[place - 1]
        shares.append(((1 - mass / 2) * moved[-1] - moved[-2]) * layers / moved[-1])
    return numpy.array(shares)


def pressure_on(session, table):
    """Of the plates on a sample, row by row: what closing the gap has left relaxes as a stretched exponential."""
    start, part, time = session.loads[table.sample]
    return start * (part + (1 - part) * numpy.exp(-numpy.sqrt((table.start + table.time) / time)))


def share_of_bonds(session, table):
    """Row by row, in steps of a quarter of a second since the sample was filled: some break by the shear, some form again."""
    breaking, time = session.hidden.thixotropy
    runs = sorted((each for each in session.tables if each.sample == table.sample and each.order <= table.order), key=lambda each: each.order)
    share, clock, step, rows = 1.0, 0.0, 0.25, []
    for run in runs:
        moments = run.start + run.time
        rates = 4 * run.strain * run.frequency  # a cycle goes through four amplitudes
        first = moments[0] - (moments[1] - moments[0])
        while clock < moments[-1] - step / 2:
            rate = 0.0 if clock < first - step / 2 else rates[numpy.searchsorted(moments, clock + step / 2)]
            share += step * ((1 - share) / time - breaking * rate * share)
            clock += step
            if run is table and numpy.any(abs(moments - clock) < step / 2):
                rows.append(share)
    return numpy.array(rows)


def worst_so_far(session, table):
    """The largest strain that the sample has seen, row by row."""
    earlier = [each.strain.max() for each in session.tables if each.sample == table.sample and each.order < table.order]
    return numpy.maximum.accumulate(numpy.maximum(table.strain, max(earlier, default=0.0)))


def reading(material, session, table, level=1.0):
    """Apparent G* from torque and angle. A sample differs from others in its level; the tool does not."""
    hidden = session.hidden
    modulus = level * true_modulus(material, session, table)
    stress = modulus * table.strain
    slip = 0.0 if table.rough or numpy.isfinite(table.viscosity) else hidden.slip
    if table.cone:
        radius = table.plate * (numpy.arange(400) + 0.5)[:, None] / 400  # in rings of one width
        at_radius = stress / (1 + 2 * slip * modulus / (radius * CONE))
        torque = 2 * numpy.pi * numpy.sum(at_radius * radius**2, axis=0) * table.plate / 400
        return 3 * torque / (2 * numpy.pi * table.plate**3) / (table.strain + hidden.compliance * torque / CONE)
    true_gap = table.gap + hidden.gap_error
    if hidden.density:
        stress = stress * with_waves(modulus, hidden.density, table)
    torque = numpy.pi * table.plate**3 / 2 * stress * ((table.plate + hidden.overfill) / table.plate)**4
    if hidden.fracture:
        strain, power = hidden.fracture
        torque = torque / numpy.maximum(1, worst_so_far(session, table) / (strain * numpy.sqrt(1e-3 / table.gap)))**power
    if hidden.loss_of_hold:
        sample, row, share = hidden.loss_of_hold
        before = sum(len(each.strain) for each in session.tables if each.sample == sample and each.order < table.order)
        if table.sample == sample:
            torque = torque * numpy.where(before + numpy.arange(len(torque)) >= row, share, 1)
    if hidden.skin and not table.trap:
        # A ring of this height and circumference that is strained as the rim is.
        torque = torque + hidden.skin * (table.start + table.time) * 2 * numpy.pi * table.plate**2 * table.strain
    angle = (true_gap * table.strain + 2 * slip * stress) / table.plate + hidden.compliance * torque
    torque = torque - hidden.inertia * (2 * numpy.pi * table.frequency)**2 * angle + 2j * numpy.pi * table.frequency * hidden.braking * angle
    torque = torque * numpy.exp(1j * hidden.turned)
    if hidden.resonance:
        size, place = hidden.resonance
        ratio = table.frequency / place
        torque = torque * (1 + size / (1 - ratio**2 + 0.3j * ratio))
    if hidden.drift:
        # Grows as the root of time, in phase with the strain.
        offset = hidden.drift * abs(modulus) * SMALL_STRAIN * numpy.sqrt((table.start + table.time) / 600)
        torque = torque + numpy.pi * table.plate**3 / 2 * offset
    apparent_strain = angle * table.plate / table.gap
    return 2 * torque / (numpy.pi * table.plate**3) / apparent_strain


def errors(generator, noise, count):
    """Unit variance."""
    if numpy.isfinite(noise.tail):
        drawn = generator.standard_t(noise.tail, count) * numpy.sqrt((noise.tail - 2) / noise.tail)
    else:
        drawn = generator.standard_normal(count)
    for row in range(1, count):
        drawn[row] = noise.correlation * drawn[row - 1] + numpy.sqrt(1 - noise.correlation**2) * drawn[row]
    return drawn
