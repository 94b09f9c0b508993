// SPDX-License-Identifier: GPL-3.0-or-later
// Layers in series between the plates: a suspension that has settled a little.
#pragma once

#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <cstddef>
#include <span>

namespace coagula::diagnose {

/// Whether structures of these volume fractions say how the modulus depends on it: some differ by more than a hundredth.
bool differ_in_volume_fraction(std::span<const double> fractions);

/// Difference of volume fraction between the lowest and the highest layer, as far as a sediment goes: no layer without particles,
/// none denser than a random close packing (0.64; Scott 1960, Nature 188, 908), the mean kept.
double settled_difference(double volume_fraction, double difference);

/// Modulus of layers in series over that of the sample before it settled, phi(z) = phi + difference (z / h - 1/2), where the
/// modulus of a layer goes as phi to the power `exponent`: the harmonic mean (Reuss 1929, ZAMM 9, 49) over the gap h.
/// @param relative_difference of volume fraction over its mean, 0 .. 2, 2 excluded.
double layers_in_series(double exponent, double relative_difference);

/// Mean volume fraction of the structures of a group.
double mean_volume_fraction(Simulator& simulator, std::size_t group = 0);

/// Slope of the logarithm of the linear modulus over that of the volume fraction, by least squares over all structures that bear a
/// load; 0 where their volume fractions do not differ by a hundredth.
double volume_fraction_exponent(Simulator& simulator, const Settings& settings, bool exact = false);

}  // namespace coagula::diagnose
