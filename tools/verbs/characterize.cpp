// coagula characterize: what the table of measures offers for a packing.
#include "cli/output_file.hpp"
#include "cli/progress_bar.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"
#include "compare_structures.hpp"
#include "stages.hpp"

#include <coagula/characterize/measure.hpp>
#include <coagula/characterize/position_noise.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/structure_file.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>

namespace coagula::tools {

namespace {

using characterize::MeasureOption;

/// The measures asked for by name; empty: those of a default run.
std::vector<std::string> chosen_measures(const Arguments& arguments) {
    if (!arguments.has("only")) {
        return {};
    }
    const std::vector<std::string> names = characterize::measure_names();
    std::vector<std::string> chosen = split(arguments.text("only"));
    for (const std::string& name : chosen) {
        if (name != "all" && std::find(names.begin(), names.end(), name) == names.end()) {
            throw InputError("--only: '" + name + "' is not one of " + list_of(names) + ", all" + did_you_mean(name, names));
        }
    }
    return chosen;
}

/// The values of the options that are given. Each is read by one of the measures.
std::map<std::string, double> option_values(const Arguments& arguments, const std::vector<std::string>& only) {
    std::map<std::string, double> values;
    for (const MeasureOption& option : characterize::measure_options()) {
        if (arguments.given(option.name)) {
            values[option.name] =
                option.unit.empty() ? static_cast<double>(arguments.count(option.name)) : arguments.quantity(option.name);
        }
    }
    std::vector<std::string> given;
    std::ranges::transform(values, std::back_inserter(given), [](const auto& entry) { return entry.first; });
    try {
        characterize::check_options(given, only);
    } catch (const std::invalid_argument& reason) {
        throw InputError(std::string("--") + reason.what());
    }
    return values;
}

/// "40nm" or "40nm,40nm,80nm".
Eigen::Vector3d parse_noise(const std::string& text) {
    const std::vector<std::string> words = split(text);
    if (words.size() != 1 && words.size() != 3) {
        throw InputError("'" + text + "' must be one length or three, X,Y,Z");
    }
    Eigen::Vector3d noise;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        noise[static_cast<Index>(axis)] = parse_quantity(words.size() == 1 ? words[0] : words[axis], "m", within(0, 1), 1e-3);
    }
    return noise;
}

void add_noise_shifts(const Arguments& arguments, const Packing& packing, const std::vector<std::string>& only,
                      const Progress& progress, characterize::MeasureResult& found) {
    const characterize::PositionNoise noise{arguments.parsed("position-noise", parse_noise), arguments.count("noise-replicas")};
    found.append(characterize::measure_noise_shifts(packing, found, noise, option_values(arguments, only), only,
                                                    static_cast<std::uint64_t>(arguments.count("seed")), progress));
}

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

characterize::HeterogeneityComparison compare(const Arguments& arguments, const std::array<std::string, 2>& names,
                                              const std::array<Packing, 2>& packings, const Progress& progress) {
    const auto input = [&](const Packing& packing) {
        return characterize::MeasureInput(packing, option_values(arguments, {"doh", "voronoi"}),
                                          static_cast<std::uint64_t>(arguments.count("seed")), progress);
    };
    return characterize::compare_heterogeneity(input(packings[0]), input(packings[1]), names);
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
    const auto comparison = compare(arguments, files, packings, make_progress(arguments.flag("quiet")));
    Json json = to_json(comparison, files);
    json["seconds"] = clock.seconds();
    report(arguments, json, table_of(comparison, files));
}

void run_characterize(const Arguments& arguments) {
    if (arguments.flag("compare")) {
        run_comparison(arguments);
        return;
    }
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    option_values(arguments, chosen_measures(arguments));
    const Packing packing = io::read_structure(arguments.input()).packing;
    const std::string target = checked_target(arguments);
    forecast_characterization(arguments, packing.size());

    Findings found = naming(arguments.input(), [&] { return characterize_packing(arguments, packing, progress); });
    progress.update("writing", 1.0);
    io::add_results(arguments.input(), target, replaced_groups(found), std::nullopt, found.fields, found.results,
                    describe_call(arguments, &packing, clock), arguments.flag("force"));

    Json json = to_json(found.results, found.group);
    json["output"] = target;
    json["seconds"] = clock.seconds();
    found.table.emplace_back("written to", target);
    report(arguments, json, found.table);
}

/// An option of a measure as an option of the program.
Option to_option(const MeasureOption& option) {
    const Range range = within(option.low, option.high);
    const std::string fallback = option.fallback ? to_text(*option.fallback) : "";
    return option.unit.empty() ? count(option.name, option.meaning, fallback, range)
                               : quantity(option.name, option.unit, option.meaning, fallback, range);
}

std::vector<Option> all_options() {
    std::vector<Option> options;
    for (const MeasureOption& option : characterize::measure_options()) {
        options.push_back(to_option(option));
    }
    options.push_back(text("only", "LIST", "take only these measures (see below), such as doh,overlap; all: every measure"));
    options.push_back(text("position-noise", "X|X,Y,Z",
                           "add noise of this standard deviation to the coordinates, measure again and say what changes"));
    options.push_back(count("noise-replicas", "number of packings with noise", "4", within(2, 1000)));
    options.push_back(flag("compare", "say which of two files is more heterogeneous, by three measures; nothing is written"));
    options.push_back(count("seed", "seed of the random numbers", "1", at_least(0)));
    options.push_back(output("write to a new file; results are added to the input file when not given"));
    options.push_back(flag("force", "replace an existing output file"));
    read_only_with(options, {"noise-replicas"}, "position-noise");
    return options;
}

/// One line per measure for the help text.
std::vector<std::string> measure_notes() {
    std::vector<std::string> notes = {"Measures (those with * only with --only or with an option of theirs):"};
    std::size_t width = 0;
    for (const characterize::Measure& measure : characterize::measures()) {
        width = std::max(width, measure.name.size());
    }
    for (const characterize::Measure& measure : characterize::measures()) {
        notes.push_back((measure.by_default ? "    " : "  * ") + measure.name + std::string(width + 2 - measure.name.size(), ' ') +
                        measure.summary);
    }
    return notes;
}

}  // namespace

Findings characterize_packing(const Arguments& arguments, const Packing& packing, const Progress& progress) {
    const std::vector<std::string> only = chosen_measures(arguments);
    const characterize::MeasureInput input(packing, option_values(arguments, only),
                                           static_cast<std::uint64_t>(arguments.count("seed")), progress);
    characterize::MeasureResult found = characterize::run_measures(input, only);
    if (arguments.has("position-noise")) {
        add_noise_shifts(arguments, packing, only, progress, found);
    }
    check_finite(found.datasets);
    return {.group = "/characterization",
            .results = std::move(found.datasets),
            .fields = std::move(found.fields),
            .table = std::move(found.lines)};
}

Json compare_packings(const Arguments& arguments, const std::array<std::string, 2>& names, const std::array<Packing, 2>& packings,
                      const Progress& progress) {
    return to_json(compare(arguments, names, packings, progress), names);
}

Verb characterize_verb() {
    return {.name = "characterize",
            .summary = "coordination number, pore sizes, degree of heterogeneity and other measures of a packing",
            .input = "FILE.h5",
            .options = all_options(),
            .run = run_characterize,
            .notes = measure_notes(),
            .many_beside = "compare"};
}

}  // namespace coagula::tools
