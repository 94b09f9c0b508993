// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a step test.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <string>
#include <vector>

namespace coagula::diagnose {

/// Which columns of a step test are the step, the response, and the response over the step.
struct StepColumns {
    const char* step;
    const char* response;
    const char* ratio;
    const char* test;  ///< in a sentence
};

StepColumns step_columns_of(MeasurementKind kind);

/// Throws InputError with the rule that a table breaks.
[[noreturn]] void refuse(const Measurement& table, const std::string& rule);

/// The numbers in a column; none where there is no column.
std::vector<double> readable_numbers(const Column* column);

}  // namespace coagula::diagnose
