// SPDX-License-Identifier: GPL-3.0-or-later
// Options that diagnoses and plans share.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/output_file.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// Where results go, the test, and the seed.
std::vector<Option> diagnosis_options();

/// --causes, --data-sets and --diagnoses.
std::vector<Option> options_of_plans();

diagnose::DiagnosisOptions diagnosis_options_of(const Arguments& arguments);

}  // namespace coagula::stages
