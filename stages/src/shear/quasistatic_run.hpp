// SPDX-License-Identifier: GPL-3.0-or-later
// shear --method quasistatic: moduli at small strain, ramps and amplitude sweeps through equilibria.
#pragma once

#include <coagula/stages/shear.hpp>

#include <vector>

namespace coagula::stages {

/// Options of this method alone.
std::vector<Option> quasistatic_options();

/// The path that the options describe. @param frequencies at most one.
QuasistaticPath quasistatic_path(const Arguments& arguments, const ContactModel& model, const std::vector<double>& frequencies);

Findings quasistatic_response(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress);

}  // namespace coagula::stages
