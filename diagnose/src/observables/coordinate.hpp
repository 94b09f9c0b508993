// SPDX-License-Identifier: GPL-3.0-or-later
// The coordinates along which observations are ordered.
#pragma once

#include "observations.hpp"

#include <array>

namespace coagula::diagnose {

/// Quantities along which residuals are looked at.
enum class Coordinate {
    strain,
    angular_frequency,
    shear_rate,
    time,
    gap,
    plate_radius,
    heterogeneity,
    coordination,
    volume_fraction,
    distance,
    pore_radius,
    none
};

/// All but none.
inline constexpr std::array all_coordinates{Coordinate::strain,
                                            Coordinate::angular_frequency,
                                            Coordinate::shear_rate,
                                            Coordinate::time,
                                            Coordinate::gap,
                                            Coordinate::plate_radius,
                                            Coordinate::heterogeneity,
                                            Coordinate::coordination,
                                            Coordinate::volume_fraction,
                                            Coordinate::distance,
                                            Coordinate::pore_radius};

/// "strain", "angular_frequency", ...
const char* name_of(Coordinate coordinate);

/// Coordinate of one observation; NaN where it has none.
double coordinate_of(const Observation& observation, Coordinate coordinate);

}  // namespace coagula::diagnose
