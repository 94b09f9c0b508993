// SPDX-License-Identifier: GPL-3.0-or-later
// The measured numbers, one by one.
#pragma once

#include <coagula/diagnose/error_spec.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/observable.hpp>

#include "repeated_images.hpp"
#include "row_conditions.hpp"

#include <Eigen/Core>

#include <cmath>
#include <complex>
#include <cstddef>
#include <variant>
#include <vector>

namespace coagula::diagnose {

/// G' or G'' [Pa]. Errors of torque and phase lie along and across G*: they are the errors of its two parts, each turned by at most
/// 45 degrees.
struct Modulus {
    bool loss = false;       ///< G'', else G'
    bool of_phase = false;   ///< the error is that of the phase, or of a loss modulus alone; else of the torque
    double turned = 0;       ///< angle from the axis of G' to that of its error, towards G'' [rad]
    double other_error = 0;  ///< error of the other part of G*, as turned [Pa]
};

/// G3' or G3'' of the third harmonic of the stress, over |G*|.
struct Harmonic {
    bool loss = false;  ///< G3'', else G3'
};

/// Viscosity in steady flow [Pa.s].
struct Viscosity {
    double shear_rate = unset;  ///< [1/s]
};

/// Mean number of neighbours in consecutive shells of one direction, the first of which is the row of the observation.
struct Neighbours {
    double distance = unset;  ///< middle of the shells over the diameter
    std::size_t shells = 1;
    double centres = 0;  ///< whose neighbours were counted
    double mutual = 0;   ///< share of the neighbours that are centres, too
};

/// How images of the same particles differ; the rows follow those of the shells.
struct ImageDifference {
    ImageQuantity quantity = ImageQuantity::plane;
    double centres = 0;  ///< that are compared
};

/// Share of the void space that is farther from any surface than a radius.
struct Pore {
    double radius = unset;  ///< [m]
};

/// One number that was measured, with the conditions of its row.
struct Observation : RowConditions {
    std::size_t measurement = 0;
    std::size_t row = 0;
    std::variant<Modulus, Harmonic, Viscosity, Neighbours, ImageDifference, Pore> what = {};
    double value = 0;
    double standard_error = unset;  ///< NaN where nobody states or estimated one
    ErrorLaw errors = {};           ///< law of the errors, of torque or phase
};

/// Null where the observation is something else.
template <class Kind>
const Kind* as(const Observation& observation) {
    return std::get_if<Kind>(&observation.what);
}

template <class Kind>
bool is(const Observation& observation) {
    return std::holds_alternative<Kind>(observation.what);
}

/// The line of the table of observables.
const Observable& observable_of(const Observation& observation);

/// Whether a Newtonian fluid is in place of the sample.
inline bool is_fluid(const Observation& observation) {
    return std::isfinite(observation.fluid_viscosity);
}

/// Whether the value grows in proportion to the stiffness or the viscosity of the material.
inline bool is_modulus_or_viscosity(const Observation& observation) {
    return is<Modulus>(observation) || is<Viscosity>(observation);
}

/// Whether the value is the viscous part of the stress: G'', a viscosity or G3''.
inline bool is_loss(const Observation& observation) {
    if (const auto* modulus = as<Modulus>(observation)) {
        return modulus->loss;
    }
    const auto* harmonic = as<Harmonic>(observation);
    return harmonic != nullptr ? harmonic->loss : is<Viscosity>(observation);
}

/// The part of a complex modulus or harmonic that the observation shows.
inline double part_of(std::complex<double> value, const Observation& observation) {
    return is_loss(observation) ? value.imag() : value.real();
}

/// Whether the error is that of the phase, or of a loss modulus or harmonic alone.
bool has_error_of_phase(const Observation& observation);

/// What a difference in this observation is measured against where the expectation is `level`: that, but neighbours against one
/// neighbour at least and everything else as it stands.
double relative_to(const Observation& observation, double level);

/// The moduli of all tables of moduli, row by row, cells that were left out skipped; then what tables show of the structure.
/// @param errors beside those that tables state.
std::vector<Observation> observations_of(const Experiment& experiment, const ErrorSpec& errors = {});

/// Writes these numbers into the cells of the tables.
void put_values(const std::vector<Observation>& observations, const Eigen::VectorXd& values, Experiment& experiment);

/// |G*| at each observation of these moduli [Pa]; 1 at a third harmonic and between images.
Eigen::ArrayXd complex_moduli(const std::vector<Observation>& observations, const Eigen::VectorXd& moduli);

}  // namespace coagula::diagnose
