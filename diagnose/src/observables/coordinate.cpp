// SPDX-License-Identifier: GPL-3.0-or-later
#include "coordinate.hpp"

#include <array>
#include <cstddef>

namespace coagula::diagnose {

namespace {

struct Entry {
    const char* name;
    double RowConditions::*condition;  ///< null where the coordinate is not a condition of the row
};

/// The entries have the order of Coordinate.
constexpr std::array entries{Entry{"strain", &RowConditions::set_strain},
                             Entry{"angular_frequency", &RowConditions::angular_frequency},
                             Entry{"shear_rate", nullptr},
                             Entry{"time", &RowConditions::time},
                             Entry{"gap", &RowConditions::gap},
                             Entry{"plate_radius", &RowConditions::plate_radius},
                             Entry{"heterogeneity", &RowConditions::heterogeneity},
                             Entry{"coordination", &RowConditions::coordination},
                             Entry{"volume_fraction", &RowConditions::volume_fraction},
                             Entry{"distance", nullptr},
                             Entry{"pore_radius", nullptr},
                             Entry{"none", nullptr}};

}  // namespace

const char* name_of(Coordinate coordinate) {
    return entries.at(static_cast<std::size_t>(coordinate)).name;
}

double coordinate_of(const Observation& observation, Coordinate coordinate) {
    if (double RowConditions::*condition = entries.at(static_cast<std::size_t>(coordinate)).condition) {
        return observation.*condition;
    }
    switch (coordinate) {
        case Coordinate::shear_rate:
            return is<Viscosity>(observation) ? as<Viscosity>(observation)->shear_rate : unset;
        case Coordinate::distance:
            return is<Neighbours>(observation) ? as<Neighbours>(observation)->distance : unset;
        case Coordinate::pore_radius:
            return is<Pore>(observation) ? as<Pore>(observation)->radius : unset;
        default:
            return 0;
    }
}

}  // namespace coagula::diagnose
