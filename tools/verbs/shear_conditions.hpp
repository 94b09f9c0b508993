// The conditions under which shear results were found, as they stand beside them in the file.
#pragma once

#include "cli/arguments.hpp"
#include "cli/report.hpp"

#include <coagula/common/contact_model.hpp>

#include <string>

namespace coagula::tools {

/// Where the results of this call go: "/mechanics/linear", "/mechanics/frequency", "/mechanics/quasistatic" or "/mechanics/dem".
std::string shear_group(const Arguments& arguments);

/// The options that bear on the results of the method, each with its value, below GROUP/conditions. How the equations are solved,
/// and what is printed where, are no conditions.
Results shear_conditions(const Arguments& arguments, const ContactModel& model);

}  // namespace coagula::tools
