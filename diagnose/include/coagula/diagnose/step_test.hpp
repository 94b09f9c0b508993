// SPDX-License-Identifier: GPL-3.0-or-later
// Step tests (creep, stress relaxation, start-up of shear) as moduli against frequency.
#pragma once

#include <coagula/diagnose/error_spec.hpp>
#include <coagula/diagnose/measurement.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Says what a step test was converted into.
struct StepConversion {
    std::size_t measurement;        ///< place in the experiment
    MeasurementKind kind;           ///< as it was measured
    std::size_t rows_used;          ///< of the step test
    std::size_t frequencies;        ///< rows of the frequency sweep
    double lowest_frequency;        ///< [rad/s]
    double highest_frequency;       ///< [rad/s]
    double largest_strain = unset;  ///< up to which the response is taken for linear; unset: not known
    TableErrors errors;             ///< of the frequency sweep
    double first_time;              ///< of the rows used [s]
    double last_time;
    std::string label;  ///< of the table
    std::string sample;
};

/// Adds the response over the height of the step where a table of a step test has both: the compliance of a creep, the modulus of a
/// relaxation, the viscosity of a start-up. Strain and stress follow from deflection and torque where the table has no others, or
/// where `raw` is set. Throws InputError where the step is 0 or goes the other way than the response.
void derive_step_response(Measurement& table, const Instrument& instrument, bool raw);

/// Puts a frequency sweep in the place of every step test: G* of a linear sample at five angular frequencies a decade between one
/// over the last time and one over the first, where its error is below a tenth, with the errors of its size and phase. The
/// tool is part of what is linear, so that its inertia, with which a creep rings, is in G* as it is in that of an oscillation.
/// Throws InputError for a table whose step does not stay, whose stress overshoots in a start-up, which begins too late or gives
/// fewer than five frequencies.
std::vector<StepConversion> convert_step_tests(Experiment& experiment);

}  // namespace coagula::diagnose
