// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_structures.hpp"

#include <cmath>

namespace coagula::stages {

namespace {

using characterize::Agreement;
using characterize::ComparedMeasure;
using characterize::HeterogeneityComparison;
using Files = std::array<std::string, 2>;

Json finite_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json file_or_null(const std::optional<std::size_t>& which, const Files& files) {
    return which ? Json(files.at(*which)) : Json(nullptr);
}

Json json_of(const ComparedMeasure& measure, const Files& files) {
    return {{"meaning", measure.meaning},
            {"values", {finite_or_null(measure.value[0]), finite_or_null(measure.value[1])}},
            {"standard_errors", {finite_or_null(measure.error[0]), finite_or_null(measure.error[1])}},
            {"difference", finite_or_null(measure.difference())},
            {"difference_error", finite_or_null(measure.difference_error())},
            {"more_heterogeneous", file_or_null(measure.more_heterogeneous(), files)}};
}

std::string one_decimal(double value) {
    return with_unit(std::round(10 * value) / 10, "1");
}

std::string readable(const std::string& name) {
    std::string words = name;
    for (char& letter : words) {
        letter = letter == '_' ? ' ' : letter;
    }
    return words;
}

/// "pore sizes and density fluctuations": the measures that name this structure, or that do not tell.
std::string names_of(const HeterogeneityComparison& comparison, const std::optional<std::size_t>& which) {
    std::string names;
    for (const ComparedMeasure& measure : comparison.measures) {
        if (measure.more_heterogeneous() == which) {
            names += (names.empty() ? "" : " and ") + readable(measure.name);
        }
    }
    return names;
}

std::string row(const ComparedMeasure& measure, const Files& files) {
    const auto which = measure.more_heterogeneous();
    const bool known = std::isfinite(measure.difference_error());
    return with_error(measure.value[0], measure.error[0]) + ", " + with_error(measure.value[1], measure.error[1]) + ": " +
           (which ? files.at(*which) + " is more heterogeneous, by " +
                        one_decimal(std::abs(measure.difference()) / measure.difference_error()) + " standard errors"
            : known ? "less than two standard errors apart"
                    : "no standard error, because a structure is too small for sub-volumes");
}

const char* name_of(Agreement agreement) {
    switch (agreement) {
        case Agreement::all:
            return "all";
        case Agreement::some:
            return "some";
        case Agreement::none:
            return "none";
        case Agreement::disagree:
            break;
    }
    return "disagree";
}

}  // namespace

std::string verdict(const HeterogeneityComparison& comparison, const Files& files) {
    const std::string count = comparison.measures.size() == 3 ? "three" : std::to_string(comparison.measures.size());
    switch (comparison.agreement()) {
        case Agreement::all:
            return files.at(*comparison.more_heterogeneous()) + " is more heterogeneous by all " + count + " measures";
        case Agreement::some:
            return files.at(*comparison.more_heterogeneous()) + " is more heterogeneous by " +
                   names_of(comparison, comparison.more_heterogeneous()) + "; " + names_of(comparison, std::nullopt) +
                   " do not tell the structures apart";
        case Agreement::none:
            return "none of the " + count + " measures separates the structures";
        case Agreement::disagree:
            break;
    }
    return "the measures disagree: " + files[0] + " is more heterogeneous by " + names_of(comparison, 0) + ", " + files[1] +
           " by " + names_of(comparison, 1);
}

Json to_json(const HeterogeneityComparison& comparison, const Files& files) {
    Json measures = Json::object();
    for (const ComparedMeasure& measure : comparison.measures) {
        measures[measure.name] = json_of(measure, files);
    }
    const auto& largest = comparison.fluctuations;
    return {{"files", files},
            {"measures", measures},
            {"left_out", comparison.left_out},
            {"pore_sizes_main_part", json_of(comparison.main_part, files)},
            {"largest_density_difference",
             {{"window_over_r0", finite_or_null(largest.edge)},
              {"difference", finite_or_null(largest.difference)},
              {"standard_error", finite_or_null(largest.error)}}},
            {"more_heterogeneous", file_or_null(comparison.more_heterogeneous(), files)},
            {"agreement", name_of(comparison.agreement())},
            {"fair", comparison.unfair.empty()},
            {"unfair", comparison.unfair},
            {"verdict", verdict(comparison, files)}};
}

Table table_of(const HeterogeneityComparison& comparison, const Files& files) {
    Table table = {{"structures", files[0] + ", " + files[1]}};
    for (const ComparedMeasure& measure : comparison.measures) {
        table.emplace_back(readable(measure.name), row(measure, files));
        table.emplace_back("", measure.meaning);
        if (measure.name == "pore_sizes" && std::isfinite(comparison.main_part.difference())) {
            table.emplace_back("  fit to P >= 0.1 only", row(comparison.main_part, files));
        }
    }
    for (const std::string& reason : comparison.left_out) {
        table.emplace_back("left out", reason);
    }
    if (const auto& largest = comparison.fluctuations; std::isfinite(largest.edge)) {
        table.emplace_back("density differs most", "in windows of " + with_unit(largest.edge, "r0") +
                                                       ": deviation of the second - first " +
                                                       with_error(largest.difference, largest.error));
    }
    table.emplace_back("verdict", verdict(comparison, files));
    for (const std::string& reason : comparison.unfair) {
        table.emplace_back("not a fair comparison", reason);
    }
    return table;
}

}  // namespace coagula::stages
