// SPDX-License-Identifier: GPL-3.0-or-later
// coagula dataset: many structures as one sweep file says.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/table.hpp>
#include <coagula/stages/dataset.hpp>
#include <coagula/stages/output_file.hpp>

#include <iostream>

namespace coagula::tools {

void run_dataset_plan(const Arguments& arguments) {
    const Printed found =
        plan_sweep(stages::read_sweep(arguments.input()), stages::set_run(arguments), make_progress(arguments.flag("quiet")));
    report(arguments, found.json, found.table);
}

void run_dataset_run(const Arguments& arguments) {
    const stages::Sweep sweep = stages::read_sweep(arguments.input());
    const Printed found = run_sweep(sweep, stages::set_run(arguments), make_progress(arguments.flag("quiet")));
    report(arguments, found.json, found.table);
}

void run_dataset_table(const Arguments& arguments) {
    const auto rows = stages::table_of_set(io::read_set(arguments.input()));
    if (!arguments.has("output")) {
        std::cout << io::csv_text(rows);
        flush_output();
        return;
    }
    check_output(arguments, arguments.text("output"));
    io::write_rows(arguments.text("output"), rows, arguments.flag("force"));
    report(arguments, {{"rows", rows.size() - 1}, {"columns", rows.front().size()}, {"output", arguments.text("output")}},
           {{"structures", std::to_string(rows.size() - 1)},
            {"columns", std::to_string(rows.front().size())},
            {"written to", arguments.text("output")}});
}

void run_dataset_verify(const Arguments& arguments) {
    const Printed found = stages::verify_set(arguments.input(), arguments.count("sample"), make_progress(arguments.flag("quiet")));
    report(arguments, found.json, found.table);
}

void run_dataset_join(const Arguments& arguments) {
    check_output(arguments, arguments.text("output"));
    const Printed found = stages::join_sets(arguments.inputs(), arguments.text("output"), arguments.flag("force"));
    report(arguments, found.json, found.table);
}

void run_dataset_workflow(const Arguments& arguments) {
    const Printed found = write_workflow(stages::read_sweep(arguments.input()), arguments.text("output"), arguments.count("chunks"),
                                         arguments.flag("force"));
    report(arguments, found.json, found.table);
}

}  // namespace coagula::tools
