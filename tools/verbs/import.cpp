// SPDX-License-Identifier: GPL-3.0-or-later
// coagula import: coordinates that somebody measured or made with another program.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/characterize/plausibility.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>

#include <cmath>

namespace coagula::tools {

namespace {

/// A single particle has no distance to another; JSON has no NaN.
Json json_of_distance(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// The values that show a wrong length unit, and a warning for each that no packing has.
Table plausibility_rows(const characterize::Plausibility& found) {
    Table rows = {{"volume fraction", with_unit(found.volume_fraction, "1")}};
    if (std::isfinite(found.smallest)) {
        rows.push_back(
            {"nearest centres", with_unit(found.smallest, "1") + " diameters apart, median " + with_unit(found.median, "1")});
    }
    rows.push_back({"contacts", std::to_string(found.contacts) + ", " + with_unit(found.coordination, "1") +
                                    " per particle   (within 1.01 diameters)"});
    for (const std::string& warning : found.warnings) {
        rows.push_back({"warning", warning});
    }
    return rows;
}

void report_import(const Arguments& arguments, const io::Structure& structure, const characterize::Plausibility& found) {
    const Packing& packing = structure.packing;
    const std::size_t frames = structure.earlier.size() + 1;
    const std::string output = arguments.text("output");
    const Json json = {
        {"particles", packing.size()},
        {"frames", frames},
        {"box", box_lengths(packing.cell)},
        {"edges", box_edges(packing.cell)},
        {"periodic", packing.cell.is_periodic()},
        {"periodic_edges", packing.cell.periodicity()},
        {"volume_fraction", found.volume_fraction},
        {"radius_mean", mean_radius(packing)},
        {"contacts", found.contacts},
        {"coordination", found.coordination},
        {"nearest_distance", {{"smallest", json_of_distance(found.smallest)}, {"median", json_of_distance(found.median)}}},
        {"warnings", found.warnings},
        {"output", output}};
    Table table = {{"particles", std::to_string(packing.size())}};
    if (frames > 1) {
        table.emplace_back("frames", std::to_string(frames));
    }
    table.emplace_back("box", describe(packing.cell));
    table.emplace_back("mean radius", with_unit(mean_radius(packing), "m"));
    const Table rows = plausibility_rows(found);
    table.insert(table.end(), rows.begin(), rows.end());
    table.emplace_back("written to", output);
    report(arguments, json, table);
}

}  // namespace

void run_import(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    const std::string output = arguments.text("output");
    const bool force = arguments.flag("force");
    check_output(arguments, output);
    const io::Structure structure = stages::import_structure(arguments);
    const Packing& packing = structure.packing;
    progress.update("writing", 1.0);
    io::write_structure(output, structure, {}, {}, describe_call(arguments, nullptr, clock), force);

    report_import(arguments, structure, characterize::judge_plausibility(packing));
}

}  // namespace coagula::tools
