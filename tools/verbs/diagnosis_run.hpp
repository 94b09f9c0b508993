// coagula diagnose: structures, noise, diagnosis, files.
#pragma once

#include <coagula/experiment/experiment_file.hpp>
#include "cli/arguments.hpp"

#include <coagula/diagnose/noise.hpp>

#include <vector>

namespace coagula::tools {

/// Options beside --check.
std::vector<Option> diagnosis_options();

/// Diagnoses an experiment whose tables have passed the checks and writes diagnosis.json and extended_model.toml into --output.
void run_diagnosis(const Arguments& arguments, experiment::ExperimentFile file, const std::vector<diagnose::NoiseModel>& noise);

}  // namespace coagula::tools
