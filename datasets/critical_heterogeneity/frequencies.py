#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a network in a solvent begins to stiffen, against its equilibrium modulus: is the exponent 2/3, as Rizzi (arXiv:1711.02689) finds?

    datasets/critical_heterogeneity/frequencies.py FOLDER

computes for each structure of frequencies.h5 in FOLDER the modulus G of the network and its response with the drag of water on every particle, and
looks for two frequencies: where G' is 2 G, and where G'' is G. Printed is the exponent x of G ~ frequency^x, for all structures and by volume
fraction, with its standard deviation over resampled structures, and the median of the largest G''/G'. Needs the Python package of coagula and numpy.
"""

import pathlib
import sys

import coagula
import numpy

CONTACT = {"normal_stiffness": "100 N/m", "shear_stiffness": "10 N/m", "solvent_viscosity": "1 mPa.s"}
FREQUENCIES = numpy.logspace(2, 10, 25)  # [Hz]
RESAMPLES = 1000
LEAST_MODULUS = 1.0  # of a network that counts as rigid [Pa]


def crossing(values, level):
    """The frequency where values first pass the level, between two of them by a power law; nan where they do not."""
    above = numpy.flatnonzero(values > level)
    if len(above) == 0 or above[0] == 0:
        return numpy.nan
    place = slice(above[0] - 1, above[0] + 1)
    return float(numpy.exp(numpy.interp(numpy.log(level), numpy.log(values[place]), numpy.log(FREQUENCIES[place]))))


def response(packing):
    """Modulus of the network [Pa], the frequencies where G' is twice that and where G'' is that [Hz], and the largest G''/G'."""
    modulus = coagula.shear(packing).storage_modulus.mean
    found = coagula.shear(packing, frequency=FREQUENCIES.tolist(), model=CONTACT).to_dict()
    storage, loss = (numpy.array(found[name]["mean"]) for name in ("storage_modulus", "loss_modulus"))
    return modulus, crossing(storage, 2 * modulus), crossing(loss, modulus), (loss / storage).max()


def exponent(moduli, frequencies):
    """Of G ~ frequency^x, with its standard deviation over resampled structures."""
    known = numpy.isfinite(frequencies)
    x, y = numpy.log(frequencies[known]), numpy.log(moduli[known])
    generator = numpy.random.default_rng(1)

    def slope(chosen):
        spread = numpy.var(x[chosen])
        return numpy.mean((x[chosen] - x[chosen].mean()) * y[chosen]) / spread if spread > 0 else numpy.nan

    draws = [slope(generator.integers(len(x), size=len(x))) for _ in range(RESAMPLES)]
    return slope(slice(None)), numpy.nanstd(draws), known.sum()


def main():
    data = coagula.open_dataset(str(pathlib.Path(sys.argv[1]) / "frequencies.h5"))
    table = data.table()
    done = [number for number in range(len(data)) if str(table["status"][number]) == "done"]
    fractions = numpy.array([round(float(table["volume_fraction"][number]), 3) for number in done])
    found = numpy.array([response(data.structure(table["id"][number]).packing) for number in done])
    rigid = found[:, 0] > LEAST_MODULUS
    found, fractions = found[rigid], fractions[rigid]
    print(f"{len(found)} networks, G {found[:, 0].min():.3g} to {found[:, 0].max():.3g} Pa; {numpy.sum(~rigid)} are not rigid")
    for name, chosen in [("all", fractions > 0), *((f"phi = {phi:g}", fractions == phi) for phi in sorted(set(fractions)))]:
        by_storage, by_loss = (exponent(found[chosen, 0], found[chosen, column]) for column in (1, 2))
        print(f"  {name:10s} G' = 2 G: {by_storage[0]:.2f} +- {by_storage[1]:.2f} ({by_storage[2]} networks)   "
              f"G'' = G: {by_loss[0]:.2f} +- {by_loss[1]:.2f} ({by_loss[2]})   largest G''/G' {numpy.median(found[chosen, 3]):.2f}")


if __name__ == "__main__":
    main()
