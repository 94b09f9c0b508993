// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/verbs.hpp"

#include <coagula/stages/characterize.hpp>
#include <coagula/stages/dataset.hpp>
#include <coagula/stages/diagnose.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/shear.hpp>

#include <algorithm>
#include <iterator>

namespace coagula::tools {

const std::vector<Command>& commands() {
    using namespace stages;
    static const std::vector<Command> all = {{generate_vem_verb(), run_generate_vem},
                                             {generate_brownian_verb(), run_generate_brownian},
                                             {characterize_verb(), run_characterize},
                                             {shear_verb(), run_shear},
                                             {calibrate_verb(), run_calibrate},
                                             {fit_power_law_verb(), run_fit_power_law},
                                             {diagnose_verb(), run_diagnose},
                                             {diagnose_new_verb(), run_diagnose_new},
                                             {diagnose_check_verb(), run_diagnose_check},
                                             {diagnose_plan_verb(), run_diagnose_plan},
                                             {diagnose_catalogue_verb(), run_diagnose_catalogue},
                                             {dataset_plan_verb(), run_dataset_plan},
                                             {dataset_run_verb(), run_dataset_run},
                                             {dataset_table_verb(), run_dataset_table},
                                             {dataset_verify_verb(), run_dataset_verify},
                                             {dataset_join_verb(), run_dataset_join},
                                             {dataset_workflow_verb(), run_dataset_workflow},
                                             {info_verb(), run_info},
                                             {import_verb(), run_import},
                                             {export_verb(), run_export},
                                             {report_verb(), run_report},
                                             {plot_verb(), run_plot},
                                             {completion_verb(), run_completion},
                                             {man_verb(), run_man}};
    return all;
}

std::vector<Verb> all_verbs() {
    std::vector<Verb> verbs;
    std::ranges::transform(commands(), std::back_inserter(verbs), [](const Command& command) { return command.verb; });
    return verbs;
}

}  // namespace coagula::tools
