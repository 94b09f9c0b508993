// coagula shear --method quasistatic: moduli at small strain, ramps and amplitude sweeps through equilibria.
#pragma once

#include "cli/arguments.hpp"
#include "findings.hpp"

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <vector>

namespace coagula::tools {

/// Options of this method alone.
std::vector<Option> quasistatic_options();

Findings quasistatic_response(const Arguments& arguments, const Packing& packing, const ContactNetwork& bonds,
                              const ContactModel& model, const std::vector<double>& frequencies, const Progress& progress);

}  // namespace coagula::tools
