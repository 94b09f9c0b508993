// SPDX-License-Identifier: GPL-3.0-or-later
// coagula characterize: what the table of measures offers for a packing.
#include "cli/progress_bar.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/stages/characterize.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>

namespace coagula::tools {

namespace {

/// What the work finds wrong about a packing, with the name of its file.
template <class Work>
auto naming(const std::string& file, Work&& work) {
    try {
        return work();
    } catch (const std::invalid_argument& reason) {
        throw InputError(file + ": " + reason.what());
    }
}

void check_comparison(const Arguments& arguments) {
    if (arguments.inputs().size() != 2) {
        throw InputError("--compare takes two files, but " + std::to_string(arguments.inputs().size()) +
                         (arguments.inputs().size() == 1 ? " is given" : " are given"));
    }
    for (const char* name : {"only", "position-noise", "samples", "output", "force"}) {
        if (arguments.has(name)) {
            throw InputError(std::string("--") + name +
                             " does not go with --compare, which takes the measures of heterogeneity "
                             "only and writes no file");
        }
    }
}

/// What a default run takes, as measured with 512 000 particles; it grows as their number.
constexpr double seconds_per_particle = 5.4e-4;  // of one processor
constexpr double bytes_per_particle = 8.0e3;
constexpr Index many_particles = 100000;

/// Says beforehand what a long run takes, and how to have it faster.
void forecast_characterization(const Arguments& arguments, Index particles) {
    if (particles < many_particles || arguments.has("only") || arguments.flag("quiet")) {
        return;
    }
    const auto rounded = [&](double amount) { return to_text(std::round(10 * amount * static_cast<double>(particles)) / 10); };
    std::cerr << "coagula: the usual measures of " << particles << " particles take about " << rounded(seconds_per_particle / 60)
              << " min of processor time and " << rounded(bytes_per_particle / 1e9)
              << " GB of memory; --only coordination,doh or other names measures less\n";
}

/// Two structures side by side; nothing is written into their files.
void run_comparison(const Arguments& arguments) {
    const Stopwatch clock;
    check_comparison(arguments);
    const std::array<std::string, 2> files = {arguments.inputs()[0], arguments.inputs()[1]};
    const std::array<Packing, 2> packings = {io::read_structure(files[0]).packing, io::read_structure(files[1]).packing};
    Printed found = compare(stages::comparison_run(arguments), files, packings, make_progress(arguments.flag("quiet")));
    found.json["seconds"] = clock.seconds();
    report(arguments, found.json, found.table);
}

}  // namespace

void run_characterize(const Arguments& arguments) {
    if (arguments.flag("compare")) {
        run_comparison(arguments);
        return;
    }
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    stages::characterize_run(arguments);  // what is wrong of the options, before the file is read
    const Packing packing = io::read_structure(arguments.input()).packing;
    const stages::CharacterizeRun run = stages::characterize_run(arguments, stages::bond_potential_of(arguments.input()));
    const std::string target = checked_target(arguments);
    forecast_characterization(arguments, packing.size());

    Findings found = naming(arguments.input(), [&] { return measure(run, packing, progress); });
    progress.update("writing", 1.0);
    Json json = to_json(found.results, found.group);
    std::move(found.bond_results.begin(), found.bond_results.end(), std::back_inserter(found.results));
    io::add_results(arguments.input(), target,
                    {replaced_groups(found), std::nullopt, found.fields, found.results, describe_call(arguments, &packing, clock)},
                    arguments.flag("force"));
    json["output"] = target;
    json["seconds"] = clock.seconds();
    found.table.emplace_back("written to", target);
    report(arguments, json, found.table);
}

}  // namespace coagula::tools
