// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_parts.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

namespace coagula::report {

namespace {

/// What makes the results below a group, FILE for the file. The first group that fits counts.
struct Maker {
    const char* group;
    const char* command;
};
constexpr std::array<Maker, 9> makers{
    {{"/characterization/rigidity", "coagula characterize FILE --only rigidity"},
     {"/characterization", "coagula characterize FILE"},
     {"/mechanics/linear", "coagula shear FILE"},
     {"/mechanics/frequency", "coagula shear FILE --frequency-sweep 0.1Hz:1kHz:20 --model MODEL.toml"},
     {"/mechanics/quasistatic/ramp", "coagula shear FILE --method quasistatic --ramp 0.01 --orientation zx"},
     {"/mechanics/quasistatic", "coagula shear FILE --method quasistatic --amplitudes 1e-4:1e-2:10 --orientation zx"},
     {"/mechanics/compression",
      "coagula shear FILE --method quasistatic --strain uniaxial --ramp 0.1 --orientation zz --model MODEL.toml"},
     {"/mechanics/dem", "coagula shear FILE --method dem"},
     {"/", "coagula info FILE"}}};

}  // namespace

const io::Contents& FigureSource::structure() const {
    if (!contents) {
        throw InputError(file + " is a table, but this figure is drawn from structures (.h5)");
    }
    return *contents;
}

const io::Dataset* FigureSource::find(const std::string& path) const {
    const std::vector<io::Dataset>& results = structure().results;
    const auto found =
        std::find_if(results.begin(), results.end(), [&](const io::Dataset& dataset) { return dataset.path == path; });
    return found == results.end() ? nullptr : &*found;
}

std::string FigureSource::command_for(const std::string& path) const {
    const auto maker = std::find_if(makers.begin(), makers.end(), [&](const Maker& one) { return path.starts_with(one.group); });
    std::string command = maker->command;
    return command.replace(command.find("FILE"), 4, file);
}

std::vector<double> FigureSource::numbers(const std::string& path) const {
    const io::Dataset* dataset = find(path);
    if (dataset == nullptr) {
        throw InputError(file + " has no " + path + ", which the figure shows: '" + command_for(path) + "' computes it");
    }
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&dataset->values)) {
        return {whole->begin(), whole->end()};
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&dataset->values)) {
        return *numbers;
    }
    throw InputError(file + ": " + path + " is a text, but the figure is drawn of numbers");
}

double FigureSource::number(const std::string& path) const {
    const std::vector<double> all = numbers(path);
    if (all.size() != 1) {
        throw InputError(file + ": " + path + " has " + std::to_string(all.size()) + " numbers, but the figure needs one");
    }
    return all.front();
}

const std::string& FigureSource::unit(const std::string& path) const {
    static const std::string none = "1";
    const io::Dataset* dataset = find(path);
    return dataset == nullptr ? none : dataset->unit;
}

FigureSource read_figure_source(const std::string& file, const std::string& label) {
    FigureSource source{
        .file = file, .label = label.empty() ? std::filesystem::path(file).stem().string() : label, .labelled = !label.empty()};
    if (!file.ends_with(".csv")) {
        source.contents = io::read_contents(file);
    }
    return source;
}

std::string legend_name(const Sources& sources, std::size_t k) {
    return sources.size() > 1 || sources[k].labelled ? sources[k].label : "";
}

std::string with_digits(double value, int digits) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    return buffer.data();
}

}  // namespace coagula::report
