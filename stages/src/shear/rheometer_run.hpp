// SPDX-License-Identifier: GPL-3.0-or-later
// shear --method dem: the explicit rheometer.
#pragma once

#include <coagula/stages/shear.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// Options of this method alone.
std::vector<Option> rheometer_options();

/// The part of the call that must be the same for a run to go on from its checkpoint: everything but where results go.
std::string run_signature(const Arguments& arguments, const ContactModel& model);

/// Settings of the run from its options. @param frequencies at most one; empty: 1 Hz.
mechanics::RheometerOptions rheometer_options_of(const Arguments& arguments, const ContactModel& model,
                                                 const std::vector<double>& frequencies);

/// Runs the test, from its checkpoint if that file is there.
Findings rheometer_response(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress);

}  // namespace coagula::stages
