// SPDX-License-Identifier: GPL-3.0-or-later
// These functions write, in sentences, what a reader should know about the data of an experiment.
#pragma once

#include <coagula/diagnose/noise.hpp>
#include <coagula/experiment/checked_experiment.hpp>

#include <string>
#include <vector>

namespace coagula::report {

/// Says where the numbers of a noise model come from.
std::string source_of(const diagnose::NoiseModel& noise);

/// The notes of the file, then what the checks found, one sentence each.
std::vector<std::string> notes_on(const experiment::CheckedExperiment& checked);

}  // namespace coagula::report
