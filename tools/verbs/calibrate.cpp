// SPDX-License-Identifier: GPL-3.0-or-later
// coagula calibrate: shear modulus against the stiffness of the particles, and the stiffness that matches measured moduli.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/io/table.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/shear.hpp>

#include <vector>

namespace coagula::tools {

void run_calibrate(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    const stages::CalibrationRun run = stages::calibration_run(arguments, arguments.inputs().size());
    if (arguments.has("output")) {
        check_output(arguments, arguments.text("output"));
    }
    // Every file is read before the first series begins.
    std::vector<Packing> packings;
    for (const std::string& file : arguments.inputs()) {
        packings.push_back(io::read_structure(file).packing);
    }
    stages::Calibrated found = calibrate(run, arguments.inputs(), packings, progress);
    auto& [json, table] = found.printed;
    if (arguments.has("output")) {
        io::write_rows(arguments.text("output"), found.rows, arguments.flag("force"));
        json["output"] = arguments.text("output");
        table.emplace_back("written to", arguments.text("output"));
    }
    json["seconds"] = clock.seconds();
    report(arguments, json, table);
}

}  // namespace coagula::tools
