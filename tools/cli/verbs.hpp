// SPDX-License-Identifier: GPL-3.0-or-later
// The verbs of the program, one file each.
#pragma once

#include "stages.hpp"

#include <vector>

namespace coagula::tools {

/// A verb, and what it does: values of options -> stage -> print.
struct Command {
    Verb verb;
    void (*run)(const Arguments&) = nullptr;
};

/// All verbs, in the order in which help texts list them.
const std::vector<Command>& commands();

/// Their tables alone.
std::vector<Verb> all_verbs();

void run_calibrate(const Arguments& arguments);
void run_characterize(const Arguments& arguments);
void run_completion(const Arguments& arguments);
void run_dataset_join(const Arguments& arguments);
void run_dataset_plan(const Arguments& arguments);
void run_dataset_run(const Arguments& arguments);
void run_dataset_table(const Arguments& arguments);
void run_dataset_verify(const Arguments& arguments);
void run_dataset_workflow(const Arguments& arguments);
void run_diagnose(const Arguments& arguments);
void run_diagnose_catalogue(const Arguments& arguments);
void run_diagnose_check(const Arguments& arguments);
void run_diagnose_new(const Arguments& arguments);
void run_diagnose_plan(const Arguments& arguments);
void run_export(const Arguments& arguments);
void run_fit_power_law(const Arguments& arguments);
void run_generate_brownian(const Arguments& arguments);
void run_generate_vem(const Arguments& arguments);
void run_import(const Arguments& arguments);
void run_info(const Arguments& arguments);
void run_man(const Arguments& arguments);
void run_plot(const Arguments& arguments);
void run_report(const Arguments& arguments);
void run_shear(const Arguments& arguments);

// The tables of verbs that print only and have no stage.
Verb completion_verb();
Verb info_verb();
Verb man_verb();

}  // namespace coagula::tools
