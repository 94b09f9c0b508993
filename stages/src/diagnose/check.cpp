// SPDX-License-Identifier: GPL-3.0-or-later
// diagnose check: the data of an experiment and their noise.
#include <coagula/common/checks.hpp>
#include <coagula/diagnose/step_test.hpp>
#include <coagula/diagnose/waveform.hpp>
#include <coagula/experiment/checked_experiment.hpp>
#include <coagula/report/data_notes.hpp>
#include <coagula/report/diagnosis_results.hpp>
#include <coagula/stages/diagnose.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace coagula::stages {

namespace {

using diagnose::CheckedMeasurement;
using diagnose::NoiseModel;
using namespace experiment;

Json number_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json column_json(const diagnose::Column& column) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    std::size_t readable = 0;
    for (const double value : column.values) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
            ++readable;
        }
    }
    return {{"name", column.name},        {"unit", column.unit},         {"readable", readable},
            {"min", number_or_null(low)}, {"max", number_or_null(high)}, {"standard_errors", !column.standard_errors.empty()}};
}

std::optional<diagnose::WaveformHarmonics> harmonics_in(const diagnose::Measurement& table) {
    return table.kind == diagnose::MeasurementKind::waveform ? diagnose::harmonics_of(table) : std::nullopt;
}

Json measurement_json(const CheckedMeasurement& checked, const TableFacts& facts) {
    const diagnose::Measurement& table = checked.measurement;
    Json json = {{"label", table.label},      {"kind", diagnose::name_of(table.kind)},
                 {"sample", table.sample},    {"run_order", table.run_order},
                 {"rows", table.rows()},      {"columns", Json::array()},
                 {"left_out", Json::array()}, {"relations", Json::array()}};
    for (const diagnose::Column& column : table.columns) {
        json["columns"].push_back(column_json(column));
    }
    for (const diagnose::LeftOutCell& cell : table.left_out) {
        json["left_out"].push_back(
            {{"column", cell.column}, {"row", cell.row + 1}, {"value", cell.value}, {"reason", cell.reason}});
    }
    for (const diagnose::RelationResult& relation : checked.relations) {
        json["relations"].push_back({{"name", relation.name}, {"rows", relation.rows}, {"failed", relation.failed}});
    }
    json["not_understood"] = facts.not_understood;
    json["flags"] = Json::object();
    for (const auto& [flag, rows] : facts.flags) {
        json["flags"][flag] = rows;
    }
    if (const auto harmonics = harmonics_in(table)) {
        json["harmonics"] = {{"strain", harmonics->strain},
                             {"angular_frequency", harmonics->angular_frequency},
                             {"storage_modulus", harmonics->storage_modulus},
                             {"loss_modulus", harmonics->loss_modulus},
                             {"third_harmonic", harmonics->third_harmonic},
                             {"third_harmonic_storage", harmonics->third_harmonic_storage},
                             {"third_harmonic_loss", harmonics->third_harmonic_loss},
                             {"error", harmonics->error}};
    }
    return json;
}

/// The conversion of the table at this place; null where there is none.
const diagnose::StepConversion* conversion_of(const CheckedExperiment& found, std::size_t place) {
    const auto conversion = std::find_if(found.conversions.begin(), found.conversions.end(),
                                         [&](const diagnose::StepConversion& one) { return one.measurement == place; });
    return conversion == found.conversions.end() ? nullptr : &*conversion;
}

Json conversion_json(const diagnose::StepConversion& conversion) {
    return {{"kind", diagnose::name_of(diagnose::MeasurementKind::frequency_sweep)},
            {"rows_used", conversion.rows_used},
            {"rows", conversion.frequencies},
            {"lowest_frequency", conversion.lowest_frequency},
            {"highest_frequency", conversion.highest_frequency},
            {"largest_strain", number_or_null(conversion.largest_strain)}};
}

/// "1-3, 7".
std::string row_list(const std::vector<std::size_t>& rows) {
    std::string text;
    for (std::size_t i = 0; i < rows.size();) {
        std::size_t end = i;
        while (end + 1 < rows.size() && rows[end + 1] == rows[end] + 1) {
            ++end;
        }
        text += (text.empty() ? "" : ", ") + std::to_string(rows[i] + 1) + (end > i ? "-" + std::to_string(rows[end] + 1) : "");
        i = end + 1;
    }
    return text;
}

/// Three digits.
std::string percent(double value) {
    std::ostringstream text;
    text << std::setprecision(3) << 100 * value << " %";
    return text.str();
}

void add_measurement_lines(Table& lines, const CheckedMeasurement& checked) {
    const diagnose::Measurement& table = checked.measurement;
    lines.emplace_back(std::string(diagnose::name_of(table.kind)),
                       table.label + ", sample '" + table.sample + "', " + std::to_string(table.rows()) + " rows");
    std::string names;
    for (const diagnose::Column& column : table.columns) {
        names += (names.empty() ? "" : ", ") + column.name + (column.unit == "1" ? "" : " [" + column.unit + "]");
    }
    lines.emplace_back("  columns", names);
    if (const auto harmonics = harmonics_in(table)) {
        lines.emplace_back("  harmonics", "G' " + with_unit(harmonics->storage_modulus, "Pa") + ", G'' " +
                                              with_unit(harmonics->loss_modulus, "Pa") + ", I3/I1 " +
                                              percent(harmonics->third_harmonic) + " at a strain of " + percent(harmonics->strain));
    }
    std::map<std::string, std::vector<std::size_t>> rows;
    std::map<std::string, std::string> reasons;
    for (const diagnose::LeftOutCell& cell : table.left_out) {
        rows[cell.column].push_back(cell.row);
        reasons.emplace(cell.column, "'" + cell.value + "' " + cell.reason);
    }
    for (auto& [column, list] : rows) {
        std::sort(list.begin(), list.end());
        lines.emplace_back("  left out", column + ": " + std::to_string(list.size()) + (list.size() == 1 ? " cell" : " cells") +
                                             ", rows " + row_list(list) + " (first: " + reasons[column] + ")");
    }
}

/// Empty cells, flags of the instrument and columns that nobody has a meaning for.
void add_fact_lines(Table& lines, const diagnose::Measurement& table, const TableFacts& facts) {
    for (const diagnose::Column& column : table.columns) {
        const auto without =
            std::count_if(column.values.begin(), column.values.end(), [](double value) { return std::isnan(value); });
        const auto left_out = std::count_if(table.left_out.begin(), table.left_out.end(),
                                            [&](const diagnose::LeftOutCell& cell) { return cell.column == column.name; });
        if (without > left_out) {
            lines.emplace_back("  empty", column.name + ": " + std::to_string(without - left_out) + " of " +
                                              std::to_string(column.values.size()) + " cells");
        }
    }
    std::string flags;
    for (const auto& [flag, rows] : facts.flags) {
        flags += (flags.empty() ? "" : ", ") + flag + " in " + std::to_string(rows) + (rows == 1 ? " row" : " rows");
    }
    if (!flags.empty()) {
        lines.emplace_back("  flags", flags);
    }
    if (!facts.not_understood.empty()) {
        lines.emplace_back("  not used", list_of(facts.not_understood) +
                                             ": not understood; if one is needed: columns = { quantity = \"heading\" }");
    }
}

void add_noise_lines(Table& lines, const NoiseModel& noise) {
    const auto interval = [](const diagnose::Estimate& estimate, auto text) {
        return text(estimate.value) +
               (estimate.low < estimate.high ? " (" + text(estimate.low) + " to " + text(estimate.high) + ")" : "");
    };
    const auto in_unit = [&](double value) { return with_unit(value, diagnose::floor_unit(noise)); };
    const std::string floor = noise.floor_of_stress ? " and a floor of the stress of " : " and a floor of ";
    lines.emplace_back("noise",
                       noise.observable + " of " + std::string(diagnose::name_of(noise.kind)) + ": " + report::source_of(noise));
    const bool of_phase = diagnose::is_of_phase(noise);
    const auto in_radians = [](double value) { return with_unit(value, "rad"); };
    lines.emplace_back("  per row", (of_phase ? interval(noise.relative, in_radians) : interval(noise.relative, percent)) +
                                        (noise.floor.high > 0 ? floor + interval(noise.floor, in_unit) : ""));
    std::string effects;
    for (const diagnose::SampleEffect& effect : noise.sample_effects) {
        effects += (effects.empty() ? ": " : ", ") + effect.sample + " " + percent(effect.effect);
    }
    if (!of_phase) {  // in which samples do not differ
        lines.emplace_back("  per sample", interval(noise.sample, percent) + effects);
    }
    if (noise.rows_estimated) {
        lines.emplace_back("  neighbours", "residuals in neighbouring rows correlate by " + with_unit(noise.autocorrelation, "1"));
    }
}

}  // namespace

Printed check_data(const std::string& experiment) {
    const CheckedExperiment found = check_experiment(experiment);
    Json json = {{"title", found.file.experiment.title},
                 {"taken_over", Json::array()},
                 {"measurements", Json::array()},
                 {"noise", Json::array()},
                 {"notes", report::notes_on(found)}};
    Table lines;
    for (const TakenOver& value : found.file.taken_over) {
        const bool is_number = value.text.empty();
        json["taken_over"].push_back({{"name", value.name},
                                      {"value", is_number ? Json(value.value) : Json(value.text)},
                                      {"unit", value.unit},
                                      {"source", value.source},
                                      {"fate", value.fate}});
        lines.emplace_back(value.name, (is_number ? with_unit(value.value, value.unit) : value.text) + ", from " + value.source +
                                           " (" + value.fate + ")");
    }
    for (std::size_t i = 0; i < found.tables.size(); ++i) {
        const TableFacts& facts = found.file.facts[i];
        json["measurements"].push_back(measurement_json(found.tables[i], facts));
        add_measurement_lines(lines, found.tables[i]);
        if (const diagnose::StepConversion* conversion = conversion_of(found, i)) {
            json["measurements"].back()["compared_as"] = conversion_json(*conversion);
            lines.emplace_back("  compared", "as G* at " + std::to_string(conversion->frequencies) + " angular frequencies from " +
                                                 with_unit(conversion->lowest_frequency, "rad/s") + " to " +
                                                 with_unit(conversion->highest_frequency, "rad/s"));
        }
        add_fact_lines(lines, found.tables[i].measurement, facts);
    }
    for (const NoiseModel& noise : found.noise) {
        json["noise"].push_back(report::noise_json(noise));
        add_noise_lines(lines, noise);
    }
    for (const std::string& note : report::notes_on(found)) {
        lines.emplace_back("note", note);
    }
    return {std::move(json), std::move(lines)};
}

Verb diagnose_check_verb() {
    return {.name = "diagnose check",
            .summary = "columns, replicates, cells left out with reasons, and noise of the data of an experiment",
            .input = "EXPERIMENT.toml",
            .options = {}};
}

}  // namespace coagula::stages
