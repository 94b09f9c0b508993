// coagula shear --method dem: the explicit rheometer.
#pragma once

#include "cli/arguments.hpp"
#include "findings.hpp"

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <vector>

namespace coagula::tools {

/// Options of this method alone.
std::vector<Option> rheometer_options();

/// What must be the same for a run to go on from its checkpoint: everything but where results go.
std::string run_signature(const Arguments& arguments, const Packing& packing, const ContactModel& model);

/// Settings of the run from its options. @param frequencies at most one; empty: 1 Hz.
mechanics::RheometerOptions rheometer_options_of(const Arguments& arguments, const ContactModel& model,
                                                 const std::vector<double>& frequencies);

/// Runs the test, from --checkpoint if that file is there.
Findings rheometer_response(const Arguments& arguments, const Packing& packing, const ContactNetwork& bonds,
                            const ContactModel& model, const std::vector<double>& frequencies, const Progress& progress);

}  // namespace coagula::tools
