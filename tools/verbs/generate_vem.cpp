// SPDX-License-Identifier: GPL-3.0-or-later
// coagula generate vem: a packing of chosen heterogeneity by the void expansion method.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>

namespace coagula::tools {

void run_generate_vem(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    const std::string output = arguments.text("output");
    const bool force = arguments.flag("force");
    check_output(arguments, output);
    Generated made = generate(stages::vem_run(arguments), progress);
    progress.update("writing", 1.0);
    io::write_structure(output, made.structure, {}, {}, describe_call(arguments, nullptr, clock), force);

    Json json = to_json(made.findings.results, made.findings.group);
    json["output"] = output;
    json["seconds"] = clock.seconds();
    json["notes"] = made.findings.notes;
    Table& table = made.findings.table;
    table.emplace_back("time", with_unit(clock.seconds(), "s"));
    table.emplace_back("written to", output);
    for (const std::string& note : made.findings.notes) {
        table.emplace_back("note", note);
    }
    report(arguments, json, table);
}

}  // namespace coagula::tools
