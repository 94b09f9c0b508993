# SPDX-License-Identifier: GPL-3.0-or-later
"""What is hidden: one function per row of the table, drawing a session from a random generator."""

from dataclasses import replace

import numpy

from days import (GAP, PLATE, full_day, gap_day, gaps_day, gradual_day, level_day, long_day, one_sample, plates_day, radii_day, rates_day, rest_day, tool_day,
                  up_and_down, wide_strains, yield_day)
from material import CONTACTS, DRAGGED, KNOWN, LOADS, RUPTURE_LOAD, STRUCTURES, SWEEP_ROWS
from relaxations import null_relaxation
from series import Series
from session import Hidden, Noise, Session

LEAST_GAIN, LARGEST_GAIN = 25, 400
KNOWN_THAT_BREAK = 4  # structures of the diagnosis where bonds break, drawn of those that there are
FAULTY_GAIN = 36
SETTLING_LOOK_ALIKES = ("temperature-drift", "evaporation", "ageing", "ageing-saturating")
MOBILITY = 1.9e-12  # of water in spheres of 0.5 um at a volume fraction of 0.4, by Kozeny and Carman: d^2 (1 - phi)^3 / (180 phi^2 eta) [m2/(Pa s)]
VISCOSITIES = (0.5, 2.0, 8.0)
REMOVED, DENSER = 0.12, 0.45  # share of the contacts; volume fraction where 0.4 is stated
CRITICAL_STRAIN = 1e-4  # of the bank of breaking structures; the sweep's strains follow from the load


def known_that_break(generator):
    return tuple(int(number) for number in generator.choice(KNOWN, KNOWN_THAT_BREAK, replace=False))


def draw_session(generator, material, hidden=Hidden(), noise=Noise(), tables=None):
    tables = tables or full_day(generator.choice([4.0, 8.0]) * CRITICAL_STRAIN, 14)
    return Session(tables, hidden, noise, stiffness=float(numpy.exp(generator.uniform(numpy.log(20), numpy.log(200)))),
                   structure=int(generator.integers(8)))


def scaled(session, material, wanted, strengths):
    """The session with that strength of its effect, of those from `strengths` (a function of 0 .. 1 giving Hidden), whose gain is nearest."""
    at = lambda place: replace(session, hidden=strengths(place))
    sketch = material.sketch()
    low, high = 0.0, 1.0
    for _ in range(25):
        middle = 0.5 * (low + high)
        if at(middle).gain(sketch) < wanted:
            low = middle
        else:
            high = middle
    return at(high)


def logarithmic(low, high):
    return lambda place: low * (high / low)**place


def effects(generator, session):
    """Function of 0 .. 1 that makes each effect stronger."""
    exponent = round(float(generator.uniform(0.015, 0.1)), 3)
    load = float(generator.choice([4.0, 8.0]))
    sign = float(generator.choice([-1, 1]))
    begin = float(numpy.exp(generator.uniform(numpy.log(100), numpy.log(2000))))
    fracture = (float(generator.uniform(0.1, 1.0)), float(generator.uniform(0.5, 4.0)))
    power = float(generator.uniform(2.5, 5.5))
    where = (str(generator.choice(list("ABCD"))), int(generator.integers(4, 32)))
    build_up = (float(numpy.exp(generator.uniform(numpy.log(0.4), numpy.log(2.5)))), begin)
    setting = (float(numpy.exp(generator.uniform(numpy.log(0.5), numpy.log(500)))), begin)
    opening = (0.3 * (power - 1.5), 0.3 * fracture[0])  # exponent and loss; a draw more would change all other rows
    relaxation = round(logarithmic(0.015, 0.5)((exponent - 0.015) / 0.085), 4)
    within = {"contact-dashpot": logarithmic(1e-6, 1e-2), "contact-relaxation": logarithmic(0.004, 5.0), "thixotropy": logarithmic(0.1, 1e3),
              "contact-loss": logarithmic(0.04, 5.0), "ageing": logarithmic(0.02, 0.3), "tool-compliance": logarithmic(5e-4, 1e-2),
              "tool-inertia": logarithmic(1e-8, 0.9e-4), "overfill": logarithmic(1e-5, 1e-3), "skin": logarithmic(1e-7, 1.0),
              "cooling": logarithmic(1e-3, 0.3), "softening": logarithmic(1.0, 1e-4),
              "braking": logarithmic(1e-9, 1e-4), "turned": logarithmic(1e-4, 0.02), "settled": logarithmic(1e-3, 0.05),
              "squeezed": logarithmic(1e-3, 0.5), "drying": logarithmic(1e-7, 2e-5), "wall-slip": logarithmic(1e-12, 1e-9), "gap-error": logarithmic(1e-6, 60e-6)}
    return {
        "contact-loss": lambda place: Hidden("contact-loss", loss=(float(f"{within['contact-loss'](place):.3g}"), exponent)),
        "ageing": lambda place: Hidden("ageing", ageing=within["ageing"](place)),
        "tool-compliance": lambda place: Hidden("tool-compliance", compliance=within["tool-compliance"](place)),
        "tool-inertia": lambda place: Hidden("tool-inertia", inertia=within["tool-inertia"](place)),
        "wall-slip": lambda place: Hidden("wall-slip", slip=within["wall-slip"](place)),
        "gap-error": lambda place: Hidden("gap-error", gap_error=within["gap-error"](place)),
        "bond-strength": lambda place: Hidden("bond-strength", loads=(load,)),
        "ageing-power": lambda place: Hidden("ageing-power", power=build_up),
        "ageing-saturating": lambda place: Hidden("ageing-saturating", setting=setting),
        "temperature-drift": lambda place: Hidden("temperature-drift", cooling=(sign * within["cooling"](place), begin)),
        "evaporation": lambda place: Hidden("evaporation", drying=(within["drying"](place), power)),
        "sedimentation": lambda place: Hidden("sedimentation", settled=(within["settled"](place), 0.5 * begin)),
        "poroelastic-backflow": lambda place: Hidden("poroelastic-backflow", backflow=(within["squeezed"](place), MOBILITY * setting[0]**0.3)),
        "bearing-damping": lambda place: Hidden("bearing-damping", braking=within["braking"](place)),
        "phase-offset": lambda place: Hidden("phase-offset", turned=sign * within["turned"](place)),
        "drying-rim": lambda place: Hidden("drying-rim", skin=within["skin"](place)),
        "radius-error": lambda place: Hidden("radius-error", overfill=sign * within["overfill"](place)),
        "sudden-loss": lambda place: Hidden("sudden-loss", loss_of_hold=(where[0], where[1], 0.98 - 0.9 * place)),
        "contact-dashpot": lambda place: Hidden("contact-dashpot", dashpot=float(f"{within['contact-dashpot'](place):.3g}")),
        "contact-relaxation": lambda place: Hidden("contact-relaxation", relaxing=(float(f"{within['contact-relaxation'](place):.3g}"), relaxation)),
        "thixotropy": lambda place: Hidden("thixotropy", thixotropy=(within["thixotropy"](place), begin)),
        "edge-fracture": lambda place: Hidden("edge-fracture", fracture=fracture),
        "reversible-softening": lambda place: Hidden("reversible-softening", softening=(within["softening"](place), *opening)),
    }


def null(generator, material):
    return draw_session(generator, material)


def null_tails(generator, material):
    return draw_session(generator, material, noise=Noise(tail=4))


def null_correlated(generator, material):
    return draw_session(generator, material, noise=Noise(correlation=0.6))


def null_offsets(generator, material):
    return draw_session(generator, material, noise=Noise(sample=0.3))


def of_effect(name):
    def draw(generator, material):
        session = draw_session(generator, material)
        strengths = effects(generator, session)[name]
        wanted = float(numpy.exp(generator.uniform(numpy.log(LEAST_GAIN), numpy.log(LARGEST_GAIN))))
        if name == "bond-strength":
            load = strengths(1).loads[0]
            return replace(session, tables=full_day(load * CRITICAL_STRAIN, SWEEP_ROWS), hidden=strengths(1),
                           known_structures=known_that_break(generator))
        return scaled(session, material, wanted, strengths)
    return draw


DAYS = {"edge-fracture": wide_strains, "radius-error": plates_day, "reversible-softening": up_and_down, "thixotropy": rest_day,
        "contact-dashpot": lambda: full_day(4e-4, 14), "contact-relaxation": lambda: full_day(4e-4, 14)}


def of_its_day(name):
    """Effects at the rim, in time and with strain, on days that can show them: of a gain that is drawn, or as large as they are."""
    def draw(generator, material):
        session = draw_session(generator, material, tables=DAYS.get(name, long_day)())
        strengths = effects(generator, session)[name]
        wanted = float(numpy.exp(generator.uniform(numpy.log(LEAST_GAIN), numpy.log(LARGEST_GAIN))))
        return scaled(session, material, wanted, strengths)
    return draw


def rupture(name, strengths):
    """Bonds so many times as strong at the higher frequency as at the lower one, which are two or three decades apart."""
    def draw(generator, material):
        lowest = float(generator.choice([0.01, 0.1]))
        hidden = Hidden(name, rates=((lowest, RUPTURE_LOAD), (10.0, RUPTURE_LOAD / float(generator.choice(strengths)))))
        session = draw_session(generator, material, hidden, tables=rates_day(4e-4, SWEEP_ROWS, (lowest, 10.0)))
        return replace(session, known_structures=known_that_break(generator))
    return draw


def between_gaps(name):
    """The same effects between plates near to and far from each other, where a sample that settles loses most far from each other."""
    def draw(generator, material):
        session = replace(draw_session(generator, material, tables=gaps_day()), two_fractions=True)
        wanted = float(numpy.exp(generator.uniform(numpy.log(LEAST_GAIN), numpy.log(LARGEST_GAIN))))
        strengths = effects(generator, session)[name]
        if name == "temperature-drift":  # one that falls
            rising = strengths
            strengths = lambda place: replace(rising(place), cooling=(abs(rising(place).cooling[0]), rising(place).cooling[1]))
        return scaled(session, material, wanted, strengths)
    return draw


def missing_contacts(generator, material):
    """Of a series of coordinations, at two strengths; a share of 0.08 has a gain of 14 only, because each row is four structures."""
    stiffness = float(numpy.exp(generator.uniform(numpy.log(20), numpy.log(200))))
    return Series(Hidden("missing-contacts", contact=("missing-contacts", float(generator.choice([0.16, 0.2])))), stiffness)


def backflow(day):
    """Of a gel so soft that its solvent takes minutes to leave."""
    def draw(generator, material):
        stiffness = float(numpy.exp(generator.uniform(numpy.log(0.01), numpy.log(0.1))))
        session = replace(draw_session(generator, material, tables=day()), stiffness=stiffness)
        wanted = float(numpy.exp(generator.uniform(numpy.log(LEAST_GAIN), numpy.log(LARGEST_GAIN))))
        return scaled(session, material, wanted, effects(generator, session)["poroelastic-backflow"])
    return draw


def soft(generator, material, hidden=Hidden()):
    stiffness = float(numpy.exp(generator.uniform(numpy.log(0.02), numpy.log(0.2))))
    return replace(draw_session(generator, material, hidden, tables=tool_day()), stiffness=stiffness)


def of_tool(name):
    """Of a soft sample, of which the tool has a part of the torque."""
    def draw(generator, material):
        session = soft(generator, material)
        wanted = float(numpy.exp(generator.uniform(numpy.log(LEAST_GAIN), numpy.log(LARGEST_GAIN))))
        return scaled(session, material, wanted, effects(generator, session)[name])
    return draw


def sample_inertia(generator, material):
    """As the densities of samples are."""
    return soft(generator, material, Hidden("sample-inertia", density=float(generator.uniform(1000, 3000))))


def gradient(generator, material):
    """Of samples that have settled long before."""
    session = replace(draw_session(generator, material, tables=gap_day()), two_fractions=True)
    wanted = float(numpy.exp(generator.uniform(numpy.log(LEAST_GAIN), numpy.log(LARGEST_GAIN))))
    return scaled(session, material, wanted,
                  lambda place: Hidden("volume-fraction-gradient", settled=(logarithmic(1e-3, 0.05)(place), 0.0)))


def bond_strength_under_cone(generator, material):
    """All sweeps of the samples whose bonds break: the strain is the same everywhere, so that nothing ties."""
    session = of_effect("bond-strength")(generator, material)
    breaking = {table.sample for table in session.tables if table.kind == "amplitude-sweep"}
    return replace(session, tables=[replace(table, cone=table.sample in breaking) for table in session.tables])


def single(generator, material):
    name = generator.choice(["contact-loss", "ageing", "tool-compliance", "tool-inertia"])
    return of_effect(name)(generator, material)


def pair(generator, material):
    names = generator.choice(["contact-loss", "ageing", "tool-compliance", "tool-inertia"], 2, replace=False)
    session = draw_session(generator, material)
    hidden = Hidden(" + ".join(names))
    for name in names:
        strengths = effects(generator, session)[name]
        one = scaled(session, material, float(generator.uniform(100, 400)), strengths).hidden
        hidden = replace(hidden, loss=one.loss or hidden.loss, ageing=one.ageing or hidden.ageing,
                         compliance=one.compliance or hidden.compliance, inertia=one.inertia or hidden.inertia)
    return replace(session, hidden=hidden)


def tie(generator, material):
    """One gap series on one material: slip and a wrong gap (and a yielding tool) lower the modulus by the same law."""
    name = generator.choice(["wall-slip", "gap-error"])
    session = draw_session(generator, material, tables=gap_day())
    wanted = float(numpy.exp(generator.uniform(numpy.log(2 * LEAST_GAIN), numpy.log(LARGEST_GAIN))))
    return scaled(session, material, wanted, effects(generator, session)[name])


def tie_of_level(generator, material):
    """The level of G' alone: many causes move it."""
    session = replace(draw_session(generator, material, tables=level_day()), known_stiffness=True, storage_only=True)
    name = str(generator.choice([*CONTACTS, "tool-compliance"]))
    if name in CONTACTS:
        return replace(session, hidden=Hidden(name, contact=(name, float(generator.choice(CONTACTS[name])))))
    return scaled(session, material, float(generator.uniform(30, 150)), effects(generator, session)[name])


def tie_of_stiffening(generator, material):
    """One upward amplitude sweep: what comes with time and what comes with strain."""
    session = draw_session(generator, material, tables=yield_day(10 * CRITICAL_STRAIN, SWEEP_ROWS))
    return scaled(session, material, float(generator.uniform(LEAST_GAIN, 4 * LEAST_GAIN)), effects(generator, session)["ageing"])


def tie_of_yield(generator, material):
    """One upward amplitude sweep: bonds that break everywhere at once or at the rim first."""
    load = float(generator.choice(LOADS))
    rim = bool(generator.integers(2))
    hidden = Hidden("plate-strain-field" if rim else "bond-strength", loads=(load,), rim=rim)
    session = draw_session(generator, material, hidden, Noise(torque=0.06, phase=0.02), yield_day(load * CRITICAL_STRAIN, SWEEP_ROWS))
    return replace(session, known_structures=known_that_break(generator))


def structure_series(generator, material):
    name = str(generator.choice(list(CONTACTS)))
    stiffness = float(numpy.exp(generator.uniform(numpy.log(20), numpy.log(200))))
    return Series(Hidden(name, contact=(name, float(generator.choice(CONTACTS[name])))), stiffness)


def null_series(generator, material):
    return Series(Hidden(), float(numpy.exp(generator.uniform(numpy.log(20), numpy.log(200)))))


def with_faults(noise):
    """An effect in data of which some are wrong."""
    def draw(generator, material):
        session = single(generator, material)
        while session.gain(material) < FAULTY_GAIN * (1 - 1e-6):
            session = single(generator, material)
        return replace(session, noise=noise)
    return draw


def null_one_sample(generator, material):
    return replace(draw_session(generator, material, noise=Noise(correlation=0.6), tables=one_sample()), told_noise=True)


def drag(generator, material):
    """The sample is as large as eight structures. They and the two of the diagnosis are others each time, or all runs would share their error."""
    viscosity = float(generator.choice(VISCOSITIES))
    drawn = lambda count: tuple(generator.choice(DRAGGED, count, replace=False).tolist())
    return replace(draw_session(generator, material), known_structures=drawn(2), mean_of=drawn(STRUCTURES),
                   hidden=Hidden("solvent-drag", viscosity=viscosity))


def misstated(kind):
    """The structure is not what the file says, and the particles' stiffness is known: a departure of the level alone."""
    def draw(generator, material):
        session = replace(draw_session(generator, material, tables=level_day()), known_stiffness=True)
        value = REMOVED if kind == "contacts-removed" else DENSER
        return replace(session, hidden=Hidden(kind, contact=(kind, value)))
    return draw


def negative_storage(generator, material):
    """An inertia so large that G' falls below zero."""
    session = draw_session(generator, material)
    inertia = float(numpy.exp(generator.uniform(numpy.log(1e-5), numpy.log(8e-5))))
    whole = numpy.pi * PLATE**4 / (2 * GAP) * material.modulus(session.structure) / 100 / (2 * numpy.pi * 30)**2
    stiffness = inertia / whole / float(generator.uniform(1.2, 2.0))  # with that over `whole` G' would be zero at 30 Hz
    return replace(session, stiffness=stiffness, hidden=Hidden("tool-inertia", inertia=inertia))


def with_bump(generator, material):
    """A cause of the catalogue and something besides."""
    session = draw_session(generator, material)
    name = str(generator.choice(["ageing", "tool-inertia"]))
    if name == "tool-inertia":
        session = replace(session, stiffness=session.stiffness / 5)  # a stiff gel hardly shows the largest inertia that there is
    known = scaled(session, material, float(generator.uniform(200, 400)), effects(generator, session)[name]).hidden
    return replace(session, hidden=replace(known, bump=(float(generator.uniform(0.02, 0.04)), 3.0, 0.25)))


def outside(generator, material):
    session = draw_session(generator, material)
    kind = generator.choice(["resonance", "drift", "warmth"])
    strengths = {"resonance": lambda place: Hidden("resonance", resonance=(logarithmic(1e-3, 1.0)(place), 5.0)),
                 "drift": lambda place: Hidden("drift", drift=logarithmic(1e-3, 1.0)(place)),
                 "warmth": lambda place: Hidden("warmth", warmth=(logarithmic(1e-3, 1.0)(place), 400.0))}[kind]
    return scaled(session, material, float(generator.uniform(100, 400)), strengths)


ROWS = {"null": null, "null-tails": null_tails, "null-correlated": null_correlated, "null-offsets": null_offsets, "single": single,
        "pair": pair, "tie": tie, "outside": outside, "null-series": null_series, "structure-series": structure_series,
        "tie-level": tie_of_level, "tie-stiffening": tie_of_stiffening, "tie-yield": tie_of_yield,
        "bond-strength-cone": bond_strength_under_cone, "wrong-rows": with_faults(Noise(wrong_rows=2)), "slid-sample": with_faults(Noise(slid="B")),
        "null-one-sample": null_one_sample, "null-relaxation": null_relaxation, "drag": drag, "contacts-removed": misstated("contacts-removed"),
        "volume-fraction": misstated("volume-fraction"), "negative-storage": negative_storage, "bump": with_bump,
        "activated-rupture": rupture("activated-rupture", (1.5, 2.0)), "bond-strength-rates": rupture("bond-strength", (1.0,)),
        "missing-contacts": missing_contacts, "sedimentation": between_gaps("sedimentation"),
        "bearing-damping": of_tool("bearing-damping"), "phase-offset": of_tool("phase-offset"), "sample-inertia": sample_inertia,
        "volume-fraction-gradient": gradient, "poroelastic-backflow": backflow(gaps_day), "poroelastic-backflow-gradual": backflow(gradual_day),
        "poroelastic-backflow-radii": backflow(radii_day)}
ROWS.update({name: of_effect(name) for name in ("contact-loss", "ageing", "tool-compliance", "tool-inertia", "bond-strength")})
ROWS.update({name: of_its_day(name) for name in ("ageing-power", "ageing-saturating", "temperature-drift", "evaporation", "drying-rim", "sudden-loss",
                                                     "radius-error", "edge-fracture", "reversible-softening", "thixotropy", "contact-dashpot",
                                                     "contact-relaxation")})
ROWS.update({f"{name}-gaps": between_gaps(name) for name in SETTLING_LOOK_ALIKES})
