// coagula shear --method quasistatic: moduli at small strain, ramps and amplitude sweeps through equilibria.
#pragma once

#include "arguments.hpp"
#include "shear_findings.hpp"

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <string>
#include <vector>

namespace coagula::tools {

/// What only this method needs.
std::vector<Option> quasistatic_options();

/// "1e-4,1e-3" or "1e-4:1e-2:10" (logarithmic steps, ends included). Throws InputError for what is no list of strains > 0.
std::vector<double> parse_amplitudes(const std::string& text);

Findings quasistatic_response(const Arguments& arguments, const Packing& packing, const ContactNetwork& bonds,
                              const ContactModel& model, const std::vector<double>& frequencies, const Progress& progress);

}  // namespace coagula::tools
