# SPDX-License-Identifier: GPL-3.0-or-later
"""Days at the rheometer: which sweeps are set, on which sample, in which order."""

from dataclasses import dataclass, replace

import numpy

GAP = 1e-3
PLATE = 12.5e-3
SMALL_STRAIN = 1e-5
CONE = numpy.pi / 180  # angle
PAUSE = 10.0  # after the last row of a table [s]


@dataclass(frozen=True)
class Table:
    """Set values of one sweep; arrays of one length."""
    kind: str
    sample: str
    order: int
    strain: numpy.ndarray
    frequency: numpy.ndarray
    time: numpy.ndarray
    gap: numpy.ndarray
    plate: float
    start: float = 0.0
    trap: bool = False                 # under which nothing dries
    rough: bool = False                # plates at which nothing slips
    viscosity: float = float("nan")    # of an oil in place of the sample
    cone: bool = False                 # in place of the upper plate


def sweep(kind, sample, order, strain, frequency, step, gap=GAP, plate=PLATE):
    strain, frequency, gap = numpy.broadcast_arrays(*map(numpy.atleast_1d, (strain, frequency, gap)))
    return Table(kind, sample, order, strain, frequency, step * numpy.arange(1, len(strain) + 1), gap, plate)


def placed(tables):
    """With the time at which each table begins on its sample."""
    for table in tables:
        before = [each for each in tables if each.sample == table.sample and each.order < table.order]
        yield replace(table, start=sum(each.time[-1] + PAUSE for each in before))


def full_day(largest_strain, rows):
    """Three samples in full, two at other gaps, two under a wider plate."""
    tables = []
    for name in "ABC":
        tables += [sweep("frequency-sweep", name, 0, SMALL_STRAIN, numpy.geomspace(0.1, 30, 10), 20),
                   sweep("time-sweep", name, 1, numpy.full(10, SMALL_STRAIN), 1.0, 60),
                   sweep("amplitude-sweep", name, 2, largest_strain * numpy.arange(1, rows + 1) / rows, 1.0, 10)]
    for name in "DE":
        tables.append(sweep("gap-series", name, 0, SMALL_STRAIN, 1.0, 120, gap=numpy.array([0.4, 0.6, 1.0, 1.5, 2.5]) * 1e-3))
    for name in "FG":
        tables.append(sweep("frequency-sweep", name, 0, SMALL_STRAIN, numpy.geomspace(0.1, 30, 8), 20, plate=2 * PLATE))
    return list(placed(tables))


def one_sample():
    """One sample: nothing tells the errors of a row."""
    return [table for table in full_day(4e-4, 14) if table.sample == "A"]


def gap_day():
    return list(placed([sweep("gap-series", name, 0, SMALL_STRAIN, 1.0, 1, gap=numpy.geomspace(0.3e-3, 3e-3, 8)) for name in "ABC"]))


def level_day():
    """Small oscillations at one frequency and gap: nothing but the level of the modulus."""
    return list(placed([sweep("time-sweep", name, 0, numpy.full(10, SMALL_STRAIN), 1.0, 60) for name in "ABCDE"]))


def yield_day(largest_strain, rows):
    """One upward amplitude sweep on each of three samples."""
    return list(placed([sweep("amplitude-sweep", name, 0, largest_strain * numpy.arange(1, rows + 1) / rows, 1.0, 10) for name in "ABC"]))


def wide_strains():
    """Far up and down again, at two gaps."""
    strains = numpy.geomspace(0.01, 3, 14)
    return list(placed([sweep("amplitude-sweep", name, order, each, 1.0, 10, gap=gap)
                        for name, gap in zip("ABCDE", [0.5e-3] * 3 + [2e-3] * 2) for order, each in ((0, strains), (1, strains[::-1]))]))


def up_and_down():
    """Up to where contacts open, and down again."""
    strains = numpy.geomspace(SMALL_STRAIN, 1e-2, 12)
    return list(placed([sweep("amplitude-sweep", name, order, each, 1.0, 10) for name in "ABC" for order, each in ((0, strains), (1, strains[::-1]))]))


def rest_day():
    """Under a cone: up in strain, small strains while the sample rests, and up again."""
    strains = numpy.geomspace(SMALL_STRAIN, 1e-3, 10)
    tables = [sweep("amplitude-sweep", name, order, strains, 1.0, 20) for name in "ABC" for order in (0, 2)]
    tables += [sweep("time-sweep", name, 1, numpy.full(8, SMALL_STRAIN), 1.0, 120) for name in "ABC"]
    return list(placed([replace(table, cone=True) for table in tables]))


def sheared_day():
    """Three samples, each sheared before every run: from seconds to an hour, twice, and frequencies in between."""
    tables = []
    for name in "ABC":
        tables += [replace(sweep("time-sweep", name, order, numpy.full(14, SMALL_STRAIN), 1.0, 5), time=numpy.geomspace(5, 3600, 14)) for order in (0, 2)]
        tables.append(sweep("frequency-sweep", name, 1, SMALL_STRAIN, numpy.geomspace(0.1, 30, 8), 20))
    return list(placed(tables))


def rates_day(largest_strain, rows, frequencies):
    """Sweeps of strain at several frequencies under a cone, each on samples of its own."""
    return list(placed([replace(sweep("amplitude-sweep", f"{name}{number}", 0, largest_strain * numpy.arange(1, rows + 1) / rows, frequency, 10), cone=True)
                        for number, frequency in enumerate(frequencies) for name in "AB"]))


def slow_day(gaps=(GAP, GAP), plates=(PLATE, PLATE)):
    """Times from seconds to hours, on two samples each between these plates."""
    tables = []
    for name, gap, plate in zip("ABCD", (gaps[0], *gaps, gaps[1]), (plates[0], *plates, plates[1])):
        tables += [sweep("time-sweep", name, 0, numpy.full(8, SMALL_STRAIN), 1.0, 5, gap, plate),
                   sweep("time-sweep", name, 1, numpy.full(10, SMALL_STRAIN), 1.0, 720, gap, plate)]
    return list(placed(tables))


def gaps_day():
    return slow_day(gaps=(GAP, 3 * GAP))


def gradual_day():
    """The same with rows in even steps of the logarithm of time."""
    return list(placed([replace(sweep("time-sweep", name, 0, numpy.full(18, SMALL_STRAIN), 1.0, 5, gap), time=numpy.geomspace(5, 7250, 18))
                        for name, gap in zip("ABCD", (GAP, GAP, 3 * GAP, 3 * GAP))]))


def radii_day():
    return slow_day(plates=(PLATE, 2 * PLATE))


def tool_day():
    """Frequencies of samples between plates near to and far from each other, small and wide."""
    return list(placed([sweep("frequency-sweep", name, 0, SMALL_STRAIN, numpy.geomspace(0.1, 30, 10), 20, gap, plate)
                        for name, gap, plate in (("A", GAP, PLATE), ("B", GAP, PLATE), ("C", 3 * GAP, PLATE), ("D", GAP, 2 * PLATE), ("E", GAP, 2 * PLATE))]))


def plates_day():
    """Samples under a small, a middle and a wide plate."""
    return list(placed([sweep("time-sweep", f"{name}{count}", 0, numpy.full(10, SMALL_STRAIN), 1.0, 60, plate=plate)
                        for name, plate in (("S", 4e-3), ("M", 12.5e-3), ("W", 30e-3)) for count in range(4)]))


def long_day():
    """Times from seconds to hours, before and after which other things are varied."""
    tables = []
    for name, plate in (("A", PLATE), ("B", PLATE), ("C", 2 * PLATE), ("D", 2 * PLATE)):
        tables += [sweep("time-sweep", name, 0, numpy.full(12, SMALL_STRAIN), 1.0, 5, plate=plate),
                   sweep("frequency-sweep", name, 1, SMALL_STRAIN, numpy.geomspace(0.1, 30, 8), 20, plate=plate),
                   sweep("time-sweep", name, 2, numpy.full(16, SMALL_STRAIN), 1.0, 450, plate=plate)]
    return list(placed(tables))
