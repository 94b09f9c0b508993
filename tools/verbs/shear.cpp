// SPDX-License-Identifier: GPL-3.0-or-later
// coagula shear: elastic response of the bonded packing, or its response to harmonic strain.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/conditions.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/over_structures.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/shear.hpp>

#include <filesystem>
#include <iterator>
#include <set>

namespace coagula::tools {

namespace {

using stages::ShearRun;

/// The run for a file, whose bonds may say how stiff they are.
ShearRun run_for(const Arguments& arguments, const std::string& file) {
    return stages::shear_run(arguments, {file, stages::bond_potential_of(file)});
}

/// Adds the response of the file `source` to `target`.
Printed shear_file(const Arguments& arguments, const ShearRun& run, const std::string& source, const std::string& target,
                   const Packing& packing, const Progress& progress) {
    const Stopwatch clock;
    auto [bonds, found] = stages::shear(run, packing, progress);
    progress.update("writing", 1.0);
    Json json = to_json(found.results, found.group);
    std::move(found.bond_results.begin(), found.bond_results.end(), std::back_inserter(found.results));
    io::add_results(source, target,
                    {replaced_groups(found), bonds, found.fields, found.results,
                     describe_call(arguments, &packing, clock, found.engine), found.bond_fields},
                    arguments.flag("force"));
    if (json.value("floppy_modes", 0) < 0) {
        json["floppy_modes"] = nullptr;
    }
    json["output"] = target;
    json["seconds"] = clock.seconds();
    found.table.emplace_back("written to", target);
    return {std::move(json), std::move(found.table)};
}

/// Results of the same method in the file itself are replaced by those of the same conditions only.
void check_replaced(const Arguments& arguments, const std::string& file, const ShearRun& run) {
    if (!arguments.has("output") && !arguments.flag("force")) {
        io::check_conditions(file, run.group(), run.conditions);
    }
}

/// Everything about the files that can be wrong is found before the first is sheared. @return the run for each.
std::vector<ShearRun> check_files(const Arguments& arguments, const std::vector<std::string>& files) {
    for (const char* name : {"output", "checkpoint"}) {
        if (arguments.has(name)) {
            throw InputError(std::string("--") + name + " is for one file, but " + std::to_string(files.size()) +
                             " are given: without it each gets its own results");
        }
    }
    std::vector<ShearRun> runs;
    std::set<std::filesystem::path> seen;
    for (const std::string& file : files) {
        stages::check_updatable(file);
        if (!seen.insert(std::filesystem::canonical(file)).second) {
            throw InputError(file + " is given twice, but the scatter of the structures is that of different ones");
        }
        runs.push_back(run_for(arguments, file));
        check_replaced(arguments, file, runs.back());
    }
    return runs;
}

std::string how_to_have_it_faster(const Arguments& arguments) {
    const std::string& method = arguments.text("method");
    if (method == "linear") {
        return {};
    }
    if (arguments.text("engine") != "builtin") {
        return arguments.text("orientation") == "all" ? "--orientation xy takes a third of it" : "";
    }
    const std::string shorter = method == "dem"               ? "--oscillations and --steps-per-oscillation"
                                : arguments.has("amplitudes") ? "amplitudes, of which the largest take most, and --steps-per-cycle"
                                                              : "--ramp-steps";
    return (arguments.text("orientation") == "all" ? "--orientation xy takes a sixth of it, and fewer " : "fewer ") + shorter +
           " take less";
}

void shear_files(const Arguments& arguments, const std::vector<std::string>& files) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"), how_to_have_it_faster(arguments));
    const std::vector<ShearRun> runs = check_files(arguments, files);
    std::vector<Json> structures;
    for (std::size_t number = 0; number < files.size(); ++number) {
        const std::string& file = files[number];
        Json json = {{"file", file}};
        json.update(shear_file(arguments, runs[number], file, file, io::read_structure(file).packing, progress).json);
        structures.push_back(std::move(json));
    }
    const Json json = {{"method", structures.front().at("method")},
                       {"structures", structures},
                       {"over_structures", stages::over_structures(structures)},
                       {"seconds", clock.seconds()}};
    report(arguments, json, stages::table_over_structures(structures));
}

}  // namespace

void run_shear(const Arguments& arguments) {
    stages::shear_run(arguments);  // what is wrong of the options, before a file is read
    const std::vector<std::string> files = arguments.inputs();
    if (files.size() > 1) {
        shear_files(arguments, files);
        return;
    }
    const Progress progress = make_progress(arguments.flag("quiet"), how_to_have_it_faster(arguments));
    const std::string target = checked_target(arguments);
    const Packing packing = io::read_structure(files.front()).packing;
    const ShearRun run = run_for(arguments, files.front());
    check_replaced(arguments, files.front(), run);
    const Printed shown = shear_file(arguments, run, files.front(), target, packing, progress);
    report(arguments, shown.json, shown.table);
}

}  // namespace coagula::tools
