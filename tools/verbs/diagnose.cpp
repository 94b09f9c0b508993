// SPDX-License-Identifier: GPL-3.0-or-later
// coagula diagnose: an experiment file is checked, planned or diagnosed.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/report/diagnosis_catalogue.hpp>
#include <coagula/stages/diagnose.hpp>
#include <coagula/stages/output_file.hpp>

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace coagula::tools {

void run_diagnose_catalogue(const Arguments& arguments) {
    if (!arguments.flag("quiet")) {
        std::cout << (arguments.flag("json") ? report::catalogue_json().dump(2) + "\n" : report::catalogue_table());
    }
    flush_output();
}

void run_diagnose_check(const Arguments& arguments) {
    const Printed found = stages::check_data(arguments.input());
    report(arguments, found.json, found.table);
}

void run_diagnose_plan(const Arguments& arguments) {
    const Printed found = plan_experiment(stages::plan_run(arguments), make_progress(arguments.flag("quiet")));
    report(arguments, found.json, found.table);
}

void run_diagnose_new(const Arguments& arguments) {
    const std::string path = arguments.text("output", "");
    if (!path.empty()) {
        check_output(arguments, path);
    }
    stages::NewExperiment found = stages::experiment_from_exports(arguments.inputs(), path);
    if (path.empty()) {
        if (arguments.flag("json")) {
            report(arguments, found.json, {});
        } else {
            std::cout << found.text;
            flush_output();
        }
        return;
    }
    io::write_file(path, found.text, arguments.flag("force"));
    Table& table = found.table;
    table.insert(table.begin(), {"experiment", path});
    table.emplace_back("next", "coagula diagnose check " + path);
    report(arguments, found.json, table);
}

void run_diagnose(const Arguments& arguments) {
    struct OldSpelling {
        std::string flag;
        std::string verb;
        void (*run)(const Arguments&);
    };
    static const std::vector<OldSpelling> spellings = {{"catalogue", "catalogue", &run_diagnose_catalogue},
                                                       {"new", "new", &run_diagnose_new},
                                                       {"power", "plan", &run_diagnose_plan},
                                                       {"check", "check", &run_diagnose_check}};
    for (const auto& [name, verb, run] : spellings) {
        if (arguments.flag(name)) {
            run(arguments);
            std::cerr << "coagula: 'diagnose --" << name << "' is called 'diagnose " << verb
                      << "' now; the old spelling works until version 2" << std::endl;
            return;
        }
    }
    if (!arguments.has("output")) {
        throw InputError("diagnose needs a folder for its results, --output FOLDER, or 'diagnose check' to look at the data only");
    }
    const stages::DiagnoseRun run = stages::diagnose_run(arguments, arguments.text("output"));
    const Printed found = diagnose_experiment(run, make_progress(arguments.flag("quiet")));
    report(arguments, found.json, found.table);
}

}  // namespace coagula::tools
