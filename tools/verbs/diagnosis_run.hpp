// coagula diagnose: structures, noise, diagnosis, files.
#pragma once

#include "cli/arguments.hpp"

#include <vector>

namespace coagula::tools {

/// Options beside --check.
std::vector<Option> diagnosis_options();

/// Diagnoses an experiment and writes diagnosis.json, report.html and what belongs to them into --output.
void run_diagnosis(const Arguments& arguments);

}  // namespace coagula::tools
