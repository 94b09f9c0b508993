// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/data_notes.hpp>

#include "verdict_sentences.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/readable.hpp>
#include <coagula/diagnose/observable.hpp>

#include <cmath>
#include <numbers>
#include <variant>

namespace coagula::report {

namespace {

using diagnose::DoubtfulClock;
using diagnose::GroupedBy;
using diagnose::LoneTable;
using diagnose::Outlier;
using diagnose::ReplicateGroups;
using diagnose::StepConversion;
using experiment::CheckedExperiment;

std::string count_text(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// A number that is not zero, to three digits.
std::string to_three_digits(double value) {
    const double digit = std::pow(10, std::floor(std::log10(value)) - 2);
    return to_text(std::round(value / digit) * digit);
}

std::string tenths_of_percent(double share) {
    return to_text(std::round(1000 * share) / 10) + " %";
}

/// "'A', 'B' and 'C'".
std::string list_of_names(const std::vector<std::string>& names) {
    std::vector<std::string> quoted;
    for (const std::string& name : names) {
        quoted.push_back("'" + name + "'");
    }
    return joined(quoted, " and ");
}

std::string subject_of(const ReplicateGroups& groups) {
    switch (groups.by) {
        case GroupedBy::instrument:
            return "tables from the instruments " + list_of_names(groups.names);
        case GroupedBy::day:
            return "tables of different days";
        case GroupedBy::sample:
            return "the samples " + list_of_names(groups.names);
        case GroupedBy::single_sample:
            break;
    }
    return "sample " + list_of_names(groups.names) + " and the others";
}

std::string sentence(const CheckedExperiment& /*checked*/, const std::string& text) {
    return text;
}

std::string assumption_of(const StepConversion& found) {
    if (!std::isfinite(found.largest_strain)) {
        return "";
    }
    return found.kind == diagnose::MeasurementKind::start_up
               ? "; the flow is taken for linear: its stress for proportional to the rate"
               : "; the sample is taken for linear up to a strain of " + with_unit(100 * found.largest_strain, "%");
}

std::string sentence(const CheckedExperiment& /*checked*/, const StepConversion& found) {
    const bool relaxation = found.kind == diagnose::MeasurementKind::stress_relaxation;
    return found.label + ", sample '" + found.sample + "': " + std::to_string(found.rows_used) + " rows of the " +
           (relaxation ? "stress relaxation" : std::string(diagnose::name_of(found.kind))) + ", from " +
           with_unit(found.first_time, "s") + " to " + with_unit(found.last_time, "s") + ", are compared as G* at " +
           std::to_string(found.frequencies) + " angular frequencies from " + with_unit(found.lowest_frequency, "rad/s") + " to " +
           with_unit(found.highest_frequency, "rad/s") + ", where their transform has an error below 10 %" + assumption_of(found);
}

std::string sentence(const CheckedExperiment& /*checked*/, const DoubtfulClock& clock) {
    const std::string table = clock.label + ", sample '" + clock.sample + "': ";
    if (clock.runs_on_from.empty()) {
        return table +
               "neither run_order nor start says which of the runs on the sample came first, so that ageing cannot be told from "
               "noise there; causes that act in time leave this table out";
    }
    return table + "its times run on from those of " + clock.runs_on_from +
           " and are taken as those of one clock; if they are not, say clock = \"run\"";
}

std::string sentence(const CheckedExperiment& checked, const Outlier& outlier) {
    const diagnose::Measurement& table = checked.tables[outlier.measurement].measurement;
    return outlier.row ? table.label + ", sample '" + table.sample + "': row " + std::to_string(*outlier.row + 1) +
                             " is left out as an outlier, |G*| is " + outlier.size + " in the rows beside it"
                       : table.label + ": sample '" + table.sample + "' is left out as an outlier, its |G*| is " + outlier.size +
                             " that of the others";
}

std::string sentence(const CheckedExperiment& /*checked*/, const LoneTable& lone) {
    const std::string table = lone.label + (lone.sample.empty() ? "" : ", sample '" + lone.sample + "'");
    std::string text = table + ": " + std::string(diagnose::observable_named(lone.observable).phrase);
    if (lone.observable == "phase") {
        text += " lies " + to_three_digits(std::abs(lone.difference) * 180 / std::numbers::pi) + " degrees " +
                (lone.difference < 0 ? "below" : "above");
    } else {
        const double factor = lone.difference < 1 ? 1 / lone.difference : lone.difference;
        text += " is " + to_three_digits(factor) + " times " + (lone.difference < 1 ? "smaller" : "larger") + " than";
    }
    text += lone.one_of_two ? " that of its replicate, " + lone.other : " that of its replicates, which agree with each other";
    return text +
           "; that is no noise, but it counts as noise and hides causes: look for a wrong unit, sample or geometry, and "
           "diagnose again without " +
           (lone.one_of_two ? "the wrong one" : "this table");
}

std::string sentence(const CheckedExperiment& /*checked*/, const ReplicateGroups& groups) {
    return "replicates of kind " + groups.kind + ": in their course, beside their level, " + subject_of(groups) + " differ by " +
           tenths_of_percent(groups.between) + ", tables that belong together only by " + tenths_of_percent(groups.within) +
           "; that is no noise, but it counts as noise and hides causes as long as both are diagnosed together: find " +
           "out why, or diagnose them one by one";
}

}  // namespace

std::string source_of(const diagnose::NoiseModel& noise) {
    if (noise.borrowed_from) {
        return "there are no replicates: taken from the replicates of the " + std::string(diagnose::name_of(*noise.borrowed_from));
    }
    if (!noise.rows_estimated) {
        return noise.averages_to_zero ? "stated, not measured: replicates average to zero or below"
                                      : "stated, not measured: there are no replicates";
    }
    return "restricted maximum likelihood from " + count_text(noise.tables, "table") + " on " +
           count_text(noise.samples, "sample") + ", " + std::to_string(noise.values) + " values" +
           (noise.floor_is_told ? "" : "; the levels are too similar to separate a floor from the relative part") +
           (noise.sample_estimated || is_of_phase(noise)
                ? ""
                : "; differences between samples are stated, not measured, because there is only one sample");
}

std::vector<std::string> notes_on(const CheckedExperiment& checked) {
    std::vector<std::string> notes = checked.file.notes;
    for (const experiment::Finding& finding : checked.findings) {
        notes.push_back(std::visit([&](const auto& fact) { return sentence(checked, fact); }, finding));
    }
    return notes;
}

}  // namespace coagula::report
