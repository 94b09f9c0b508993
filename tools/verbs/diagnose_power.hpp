// coagula diagnose --power: what a planned experiment could find.
#pragma once

#include "cli/arguments.hpp"

namespace coagula::tools {

/// Simulates the experiment that the input file plans and prints which causes it could find; with --output also writes power.json.
void run_power(const Arguments& arguments);

}  // namespace coagula::tools
