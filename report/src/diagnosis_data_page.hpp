// SPDX-License-Identifier: GPL-3.0-or-later
// The section of a diagnosis report about the data themselves, as HTML.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/noise.hpp>

#include <string>
#include <vector>

namespace coagula::report {

/// Errors of rows and samples, and where they are from; empty where none are known.
std::string noise_section(const std::vector<diagnose::NoiseModel>& noise);

/// Cells that are not used, with reasons.
std::string left_out_section(const diagnose::Experiment& experiment);

}  // namespace coagula::report
