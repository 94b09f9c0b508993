// SPDX-License-Identifier: GPL-3.0-or-later
#include "coordinate.hpp"

#include <array>
#include <cstddef>

namespace coagula::diagnose {

std::span<const Coordinate> all_coordinates() {
    static constexpr std::array all{Coordinate::strain,
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
    return all;
}

const char* name_of(Coordinate coordinate) {
    constexpr std::array<const char*, 12> names{
        "strain",        "angular_frequency", "shear_rate",      "time",     "gap",         "plate_radius",
        "heterogeneity", "coordination",      "volume_fraction", "distance", "pore_radius", "none"};
    return names.at(static_cast<std::size_t>(coordinate));
}

double coordinate_of(const Observation& observation, Coordinate coordinate) {
    switch (coordinate) {
        case Coordinate::strain:
            return observation.set_strain;
        case Coordinate::angular_frequency:
            return observation.angular_frequency;
        case Coordinate::shear_rate:
            return is<Viscosity>(observation) ? as<Viscosity>(observation)->shear_rate : unset;
        case Coordinate::time:
            return observation.time;
        case Coordinate::gap:
            return observation.gap;
        case Coordinate::plate_radius:
            return observation.plate_radius;
        case Coordinate::heterogeneity:
            return observation.heterogeneity;
        case Coordinate::coordination:
            return observation.coordination;
        case Coordinate::volume_fraction:
            return observation.volume_fraction;
        case Coordinate::distance:
            return is<Neighbours>(observation) ? as<Neighbours>(observation)->distance : unset;
        case Coordinate::pore_radius:
            return is<Pore>(observation) ? as<Pore>(observation)->radius : unset;
        case Coordinate::none:
            break;
    }
    return 0;
}

}  // namespace coagula::diagnose
