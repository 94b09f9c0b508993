// SPDX-License-Identifier: GPL-3.0-or-later
// characterize: what the table of measures offers for a packing.
#include "compare_structures.hpp"

#include <coagula/common/spelling.hpp>
#include <coagula/stages/characterize.hpp>

#include <algorithm>
#include <iterator>

namespace coagula::stages {

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
            throw InputError(arguments.spelled("only") + ": '" + name + "' is not one of " + list_of(names) + ", all" +
                             did_you_mean(name, names));
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
        const std::string sentence = reason.what();  // begins with the name of an option
        const std::size_t end = sentence.find(' ');
        throw InputError(arguments.spelled(sentence.substr(0, end)) + sentence.substr(std::min(end, sentence.size())));
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

/// An option of a measure as an option of the program.
Option to_option(const MeasureOption& option) {
    const Range range = within(option.low, option.high);
    const std::string fallback = option.fallback ? to_text(*option.fallback) : "";
    return option.unit.empty() ? count(option.name, option.meaning, fallback, range)
                               : quantity(option.name, option.unit, option.meaning, fallback, range);
}

std::vector<Option> characterize_options() {
    std::vector<Option> options;
    for (const MeasureOption& option : characterize::measure_options()) {
        options.push_back(to_option(option));
    }
    options.push_back(text("only", "LIST", "take only these measures (see below), such as doh,overlap; all: every measure"));
    options.push_back(text("position-noise", "X|X,Y,Z",
                           "add noise of this standard deviation to the coordinates, measure again and say what changes"));
    options.push_back(formerly("noise-replicas", count("realizations", "number of packings with noise", "4", within(2, 1000))));
    options.push_back(flag("compare", "say which of two files is more heterogeneous, by three measures; nothing is written"));
    options.push_back(count("seed", "seed of the random numbers", "1", at_least(0)));
    options.push_back(output("write to a new file; results are added to the input file when not given"));
    options.push_back(flag("force", "replace an existing output file"));
    read_only_with(options, {"realizations"}, "position-noise");
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

CharacterizeRun characterize_run(const Arguments& arguments, const std::optional<BondPotential>& bonds) {
    CharacterizeRun run;
    run.only = chosen_measures(arguments);
    run.options = option_values(arguments, run.only);
    if (bonds) {
        run.options.try_emplace("contact-tolerance", bonds->tolerance);
    }
    run.seed = static_cast<std::uint64_t>(arguments.count("seed"));
    if (arguments.has("position-noise")) {
        run.noise = {arguments.parsed("position-noise", parse_noise), arguments.count("realizations")};
    }
    return run;
}

CharacterizeRun comparison_run(const Arguments& arguments) {
    return {.options = option_values(arguments, {"doh", "voronoi"}), .seed = static_cast<std::uint64_t>(arguments.count("seed"))};
}

Findings measure(const CharacterizeRun& run, const Packing& packing, const Progress& progress) {
    const characterize::MeasureInput input(packing, run.options, run.seed, progress);
    characterize::MeasureResult found = characterize::run_measures(input, run.only);
    if (run.noise) {
        found.append(characterize::measure_noise_shifts(packing, found, *run.noise, run.options, run.only, run.seed, progress));
    }
    check_finite(found.datasets);
    check_finite(found.contact_results);
    return {.group = "/characterization",
            .results = std::move(found.datasets),
            .fields = std::move(found.fields),
            .table = std::move(found.lines),
            .bond_results = std::move(found.contact_results)};
}

Printed compare(const CharacterizeRun& run, const std::array<std::string, 2>& names, const std::array<Packing, 2>& packings,
                const Progress& progress) {
    const auto input = [&](const Packing& packing) { return characterize::MeasureInput(packing, run.options, run.seed, progress); };
    const auto comparison = characterize::compare_heterogeneity(input(packings[0]), input(packings[1]), names);
    return {to_json(comparison, names), table_of(comparison, names)};
}

Verb characterize_verb() {
    return {.name = "characterize",
            .summary = "coordination number, pore sizes, degree of heterogeneity and other measures of a packing",
            .input = "FILE.h5",
            .options = characterize_options(),
            .notes = measure_notes(),
            .many_beside = "compare"};
}

}  // namespace coagula::stages
