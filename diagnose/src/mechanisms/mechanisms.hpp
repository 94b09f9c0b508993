// SPDX-License-Identifier: GPL-3.0-or-later
// This header holds what the mechanisms share; each mechanism is a file of its own.
#pragma once

#include <coagula/diagnose/mechanism.hpp>

#include "data/knows.hpp"
#include "observables/observations.hpp"

#include <cmath>
#include <complex>

namespace coagula::diagnose::mechanisms {

/// Step of critical strains along their priors, 0 .. 1: 1 % of the strain, less than structures can resolve.
constexpr double strength_step = 1.0 / 920;

constexpr double usual_gap = 1e-3;  ///< where none is known [m]

/// What the layers of a sample that has settled, in series, do to the modulus of a row; 1 where nobody knows the gap.
/// @param difference of the volume fraction between the plates at the gap of the instrument, 1 mm where that is not known.
std::complex<double> settled_layers(const Observation& row, double difference, const SimulatedSample& sample);

/// Layers between plates are in series; what the modulus of a layer is, structures of other volume fractions say.
bool can_settle_between_plates(const Knows& knows);

/// (1 + age / time)^exponent, of an exponent and a time [s].
inline std::complex<double> power_of_age(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    return std::isfinite(row.age) ? std::pow(1 + row.age / values[1], values[0]) : 1;
}

/// Whether strains differ, without which what follows the strain is a level that anything can have.
inline bool strains_differ(const Knows& knows) {
    return column_differs(knows.experiment, "strain");
}

inline bool gaps_differ(const Knows& knows) {
    return column_differs(knows.experiment, "gap");
}

inline bool radii_differ(const Knows& knows) {
    return column_differs(knows.experiment, "plate_radius");
}

/// Whether an oil was measured, which shows what the instrument does and nothing that a sample does by itself.
inline bool shows_oil(const Knows& knows) {
    return knows.experiment.material.kind == MaterialKind::newtonian || has_oil(knows.experiment);
}

/// Solvent that leaves at the rim stays under a trap, and is the less the wider the plates are.
inline bool shows_rim(const Knows& knows) {
    return radii_differ(knows) || has_trap(knows.experiment);
}

/// A smooth viscosity may grow towards low rates in any way.
inline bool flows_as_an_oil(const Knows& knows) {
    return knows.flow && knows.experiment.material.kind == MaterialKind::newtonian;
}

}  // namespace coagula::diagnose::mechanisms
