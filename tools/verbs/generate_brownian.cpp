// SPDX-License-Identifier: GPL-3.0-or-later
// coagula generate brownian: coagulation of a stabilised suspension by Brownian dynamics.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"
#include "potential_curve.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>

#include <cmath>
#include <optional>

namespace coagula::tools {

void run_generate_brownian(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    std::optional<Packing> start;
    if (arguments.has("start")) {
        start = io::read_structure(arguments.text("start")).packing;
    }
    const double radius = start ? mean_radius(*start) : arguments.optional_quantity("radius").value_or(unset);
    if (arguments.flag("potential-curve")) {
        if (std::isnan(radius)) {
            throw InputError("--potential-curve needs --radius");
        }
        report_potential(arguments, stages::make_potential(stages::pair_forces(arguments), radius), radius);
        return;
    }
    if (!arguments.has("output")) {
        throw InputError("coagula generate brownian needs --output (see 'coagula generate brownian --help')");
    }
    const std::string output = arguments.text("output");
    check_output(arguments, output);
    const Packing* first = start ? &*start : nullptr;
    Generated made = generate(stages::brownian_run(arguments, first), first, progress);
    progress.update("writing", 1.0);
    const Results& results = made.findings.results;
    io::write_structure(output, made.structure, {}, results, describe_call(arguments, first, clock, made.findings.engine),
                        arguments.flag("force"));
    Json json = to_json(results, made.findings.group);
    json["particles"] = made.structure.packing.size();
    json["volume_fraction"] = volume_fraction(made.structure.packing);
    json["seed"] = arguments.count("seed");
    json["output"] = output;
    json["seconds"] = clock.seconds();
    Table& table = made.findings.table;
    table.emplace_back("time", with_unit(clock.seconds(), "s"));
    table.emplace_back("written to", output);
    report(arguments, json, table);
}

}  // namespace coagula::tools
