# SPDX-License-Identifier: GPL-3.0-or-later
"""Causes that show in coordinates, pores, steady flow, repeated sweeps and after a shear: rows of the table beside those of cases.py, each at two
strengths."""

from dataclasses import replace

import numpy

import images
from cases import draw_session, effects, scaled
from days import long_day, sheared_day, up_and_down
from flow import Flow
from images import Images
from series import Series
from session import Hidden

GAINS = (40, 200)                        # of an effect whose strength is free
NARROW, WIDE = 12.5e-3, 25e-3            # plates
FOUND = {"weak": (1.5e-8, 3e-8, 0.01, 0.01), "strong": (2.5e-8, 6e-8, 0.03, 0.03)}  # as in Hidden.images
SIZES = (0.08, 0.16)
POTENTIALS = (0.013, 0.014)  # the prior ends at 0.015
BARRIER = 0.0145               # V, of a recipe
IONS = (1.6, 2.4)
TENSIONS = (6e-3, 9e-3)
BUILD_UP = (0.15, 0.6)                   # exponents
PER_DECADE = (0.04, 0.1)


def within(low, high, generator):
    return float(numpy.exp(generator.uniform(numpy.log(low), numpy.log(high))))


def hertz(generator, material):
    """Up and down, where contacts that stiffen do not show what comes with time."""
    session = draw_session(generator, material, tables=up_and_down())
    return scaled(session, material, float(generator.choice(GAINS)),
                  lambda place: Hidden("contact-nonlinearity", hertz=3e-2 * (1e-5 / 3e-2)**place))


def stiffening(generator, material):
    """The same of strands."""
    session = draw_session(generator, material, tables=up_and_down())
    exponent = float(generator.uniform(1.6, 2.6))
    return scaled(session, material, float(generator.choice(GAINS)),
                  lambda place: Hidden("bond-stiffening", stiffening=(2e-4**place, exponent)))


def ageing_up_and_down(generator, material):
    """What looks like Hertz contacts on the way up."""
    session = draw_session(generator, material, tables=up_and_down())
    return scaled(session, material, float(generator.choice(GAINS)), effects(generator, session)["ageing"])


def loads(generator, tables):
    """What closing the gap leaves on each sample, in Pa: 1 to 2 N under plates of 12.5 mm."""
    drawn = lambda: (within(2e3, 4e3, generator), float(generator.uniform(0.0, 0.4)), within(100, 2000, generator))
    return {name: drawn() for name in sorted({table.sample for table in tables})}


def normal_load(tells_load):
    """Of samples that were pressed more and less, as large as it is. Under more than four tenths of the pressure that holds the contacts together they
    would open."""
    def draw(generator, material):
        tables = long_day()
        hidden = Hidden("normal-load" if tells_load else "loading-relaxation", pressure=within(1e4, 2e4, generator))
        return replace(draw_session(generator, material, hidden, tables=tables), loads=loads(generator, tables), tells_load=tells_load)
    return draw


def cooling_under_load(generator, material):
    """A load that relaxes and has no part in what the sample does."""
    tables = long_day()
    session = replace(draw_session(generator, material, tables=tables), loads=loads(generator, tables), tells_load=True)
    return scaled(session, material, float(generator.choice(GAINS)), effects(generator, session)["temperature-drift"])


def prestress(generator, material):
    return Series(Hidden("prestress", contact=("prestress", float(generator.choice(TENSIONS)))), within(20, 200, generator))


def bending_series(generator, material):
    """What looks like tension in a series of coordinations."""
    return Series(Hidden("bond-bending", contact=("bond-bending", float(generator.choice([0.003, 0.03])))), within(20, 200, generator))


def after_shear(generator, material):
    """As large as it is."""
    hidden = Hidden("ageing-after-shear", power=(float(generator.choice(BUILD_UP)), within(3, 300, generator)))
    return replace(draw_session(generator, material, hidden, tables=sheared_day()), sheared=True)


def ageing_sheared(generator, material):
    """Another law of the same age, as large as it is: at a gain of 200 it is less a decade than the diagnosis knows."""
    hidden = Hidden("ageing", ageing=float(generator.choice(PER_DECADE)))
    return replace(draw_session(generator, material, hidden, tables=sheared_day()), sheared=True)


def flow(name, part, largest, plates=(NARROW,) * 3, gaps=(1e-3,) * 3):
    """An oil in steady flow with one effect of a drawn gain."""
    def draw(generator, material):
        sign = float(generator.choice([-1, 1]))
        oil = Flow(Hidden(), within(0.1, 10, generator), plates, gaps)
        return scaled(oil, material, float(generator.choice(GAINS)), lambda place: Hidden(name, **{part: sign * largest * 1e-6**(1 - place)}))
    return draw


def thinning(generator, material):
    """An oil that is none."""
    exponent = generator.uniform(0.1, 0.9)
    oil = Flow(Hidden(), within(0.1, 10, generator), (NARROW,) * 3, (1e-3,) * 3)
    return scaled(oil, material, float(generator.choice(GAINS)),
                  lambda place: Hidden("shear-thinning", thinning=1e-6**(1 - place), exponent=exponent))


def localisation(generator, material):
    return Images(Hidden("localisation-error", images=FOUND[str(generator.choice(list(FOUND)))]), "coordinates", pair(generator))


def sizes(generator, material):
    return Images(Hidden("polydispersity", sizes=float(generator.choice(SIZES))), "coordinates", pair(generator))


def potential(generator, material):
    return Images(Hidden("surface-potential", potential=float(generator.choice(POTENTIALS))), "pore-curve", pair(generator), "brownian")


def ions(generator, material):
    hidden = Hidden("ionic-strength", potential=BARRIER, ions=float(generator.choice(IONS)))
    return Images(hidden, "pore-curve", pair(generator), "brownian", Hidden(potential=BARRIER))


def sharp(kind, maker):
    """Nothing hidden."""
    return lambda generator, material: Images(Hidden(), kind, pair(generator), maker)


def pair(generator):
    return tuple(int(number) for number in generator.choice(images.POOL, 2, replace=False))


ROWS = {"contact-nonlinearity": hertz, "bond-stiffening": stiffening, "ageing-up-and-down": ageing_up_and_down,
        "prestress": prestress, "bond-bending-series": bending_series,
        "normal-load": normal_load(True), "loading-relaxation": normal_load(False), "temperature-drift-loaded": cooling_under_load,
        "ageing-after-shear": after_shear, "ageing-sheared": ageing_sheared,
        "torque-offset": flow("torque-offset", "torque", 1e-5),
        "torque-offset-plates": flow("torque-offset", "torque", 1e-5, plates=(NARROW, NARROW, WIDE, WIDE), gaps=(1e-3,) * 4),
        "shear-thinning": thinning,
        "localisation-error": localisation, "polydispersity": sizes, "surface-potential": potential,
        "ionic-strength": ions,
        "null-coordinates": sharp("coordinates", "vem"), "null-pores": sharp("pore-curve", "brownian")}
