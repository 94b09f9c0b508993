// SPDX-License-Identifier: GPL-3.0-or-later
// coagula fit power-law: G' = c (a - a0)^beta through a table of moduli, and what the table says about a0.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/table.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/shear.hpp>

namespace coagula::tools {

namespace {

mechanics::PowerLawData read_data(const Arguments& arguments) {
    const std::optional<double> unit = arguments.optional_quantity("modulus-unit");
    const bool error_named = arguments.has("standard-error");
    const std::vector<Eigen::VectorXd> columns =
        io::read_table(arguments.input(), {{.name = arguments.text("a"), .unit = "1"},
                                           {.name = arguments.text("modulus"), .unit = "Pa", .default_unit = unit},
                                           {.name = arguments.text("standard-error", "standard_error"),
                                            .unit = "Pa",
                                            .default_unit = unit,
                                            .required = error_named}});
    return {columns[0], columns[1], columns[2]};
}

stages::FittedPowerLaw fit_file(const Arguments& arguments, const mechanics::PowerLawData& data) {
    try {
        return stages::fit_power_law(stages::power_law_options(arguments), data, make_progress(arguments.flag("quiet")));
    } catch (const std::invalid_argument& error) {
        throw InputError(arguments.input() + ": " + error.what());
    }
}

}  // namespace

void run_fit_power_law(const Arguments& arguments) {
    const Stopwatch clock;
    if (arguments.has("output")) {
        check_output(arguments, arguments.text("output"));
    }
    stages::FittedPowerLaw found = fit_file(arguments, read_data(arguments));
    auto& [json, table] = found.printed;
    if (arguments.has("output")) {
        io::write_rows(arguments.text("output"), found.rows, arguments.flag("force"));
        json["output"] = arguments.text("output");
        table.emplace_back("profile written to", arguments.text("output"));
    }
    json["seconds"] = clock.seconds();
    report(arguments, json, table);
}

}  // namespace coagula::tools
