// SPDX-License-Identifier: GPL-3.0-or-later
// Diagnoses of experiments, and what comes before one.
#pragma once

#include <coagula/common/progress.hpp>
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/power.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/findings.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

struct DiagnoseRun {
    std::string experiment;   ///< the experiment file
    std::string folder = {};  ///< where everything goes; empty: nothing is written
    bool overwrite = false;   ///< an earlier diagnosis in the folder
    diagnose::DiagnosisOptions options = {};
    io::Provenance call = {};  ///< entry of the history; its time and duration are set at the end
};

Verb diagnose_verb();
/// @param folder see DiagnoseRun.
DiagnoseRun diagnose_run(const Arguments& arguments, std::string folder);
/// The object of diagnosis.json, and a table of what was found.
Printed diagnose_experiment(const DiagnoseRun& run, const Progress& progress);

/// What an experiment file and its tables hold, and the noise of the measurements.
Verb diagnose_check_verb();
Printed check_data(const std::string& experiment);

/// The causes that a planned experiment could find.
struct PlanRun {
    std::string experiment;
    std::string folder = {};  ///< for power.json; empty: nothing is written
    bool overwrite = false;
    diagnose::PowerOptions options = {};  ///< but for what stands in the experiment file
};
Verb diagnose_plan_verb();
PlanRun plan_run(const Arguments& arguments);
Printed plan_experiment(PlanRun run, const Progress& progress);

/// A first experiment file from exports of instruments.
struct NewExperiment {
    Json json;
    std::string text;  ///< the commented file
    Table table = {};  ///< about the tables of the exports
};
Verb diagnose_new_verb();
/// @param path where the file will be written, as its paths are relative to that; empty: the current folder.
NewExperiment experiment_from_exports(const std::vector<std::string>& exports, const std::string& path);

Verb diagnose_catalogue_verb();

}  // namespace coagula::stages
