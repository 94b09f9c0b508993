// SPDX-License-Identifier: GPL-3.0-or-later
// An experiment after every check that needs no simulation.
#pragma once

#include <coagula/diagnose/check_data.hpp>
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/lone_tables.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/outliers.hpp>
#include <coagula/diagnose/replicate_groups.hpp>
#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/step_test.hpp>
#include <coagula/experiment/experiment_file.hpp>
#include <coagula/experiment/experiment_structures.hpp>

#include <string>
#include <variant>
#include <vector>

namespace coagula::experiment {

/// Something that a reader should know about the data, where it is no sentence yet.
using Finding = std::variant<std::string, diagnose::StepConversion, diagnose::DoubtfulClock, diagnose::Outlier, diagnose::LoneTable,
                             diagnose::ReplicateGroups>;

struct CheckedExperiment {
    ExperimentFile file;  ///< ready to be diagnosed: step tests as frequency sweeps, waveforms as harmonics
    std::vector<diagnose::CheckedMeasurement> tables = {};   ///< as measured, before outliers were left out
    std::vector<diagnose::StepConversion> conversions = {};  ///< of step tests into frequency sweeps, by their place in `tables`
    std::vector<diagnose::NoiseModel> noise = {};            ///< of the tables
    diagnose::DiagnosisOptions options = {};                 ///< with the errors of the experiment
    ExperimentStructures structures = {};
    std::vector<Finding> findings = {};  ///< beside the notes of the file
};

/// Reads an experiment and refuses all that a diagnosis would refuse before it simulates. Throws InputError with a sentence that
/// names the file, the key, the table or the structure and the rule. That no structures are named yet is a note; make_structures
/// refuses it.
CheckedExperiment check_experiment(const std::string& path, diagnose::DiagnosisOptions options = {});

}  // namespace coagula::experiment
