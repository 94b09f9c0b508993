// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnosis_data_page.hpp"

#include "diagnosis_charts.hpp"
#include "html.hpp"

#include <coagula/report/data_notes.hpp>

#include <map>
#include <set>

namespace coagula::report {

namespace {

std::string interval(const diagnose::Estimate& estimate, double unit, const std::string& name) {
    const auto text = [&](double value) { return name == "%" ? printed(value / unit) + " %" : printed(value, name); };
    return text(estimate.value) +
           (estimate.low < estimate.high ? " (" + text(estimate.low) + " to " + text(estimate.high) + ")" : std::string{});
}

/// Row numbers as "1–3, 7".
std::string row_list(const std::set<std::size_t>& rows) {
    std::string text;
    for (auto row = rows.begin(); row != rows.end();) {
        const std::size_t first = *row;
        std::size_t last = first;
        while (++row != rows.end() && *row == last + 1) {
            last = *row;
        }
        text += (text.empty() ? "" : ", ") + std::to_string(first + 1) + (last > first ? "–" + std::to_string(last + 1) : "");
    }
    return text;
}

}  // namespace

std::string noise_section(const std::vector<diagnose::NoiseModel>& noise) {
    if (noise.empty()) {
        return {};
    }
    std::string html = heading("Noise and samples");
    std::vector<std::vector<std::string>> rows;
    std::map<std::string, std::vector<std::string>> effects;
    for (const diagnose::NoiseModel& model : noise) {
        rows.push_back({symbol_of(model.observable) + ", " + std::string(diagnose::name_of(model.kind)),
                        is_of_phase(model) ? interval(model.relative, 1, "rad") : interval(model.relative, 0.01, "%"),
                        interval(model.floor, 1, diagnose::floor_unit(model)) + (model.floor_of_stress ? " of the stress" : ""),
                        is_of_phase(model) ? "" : interval(model.sample, 0.01, "%"), printed(model.autocorrelation),
                        escaped(source_of(model))});
        for (const diagnose::SampleEffect& effect : model.sample_effects) {
            effects[effect.sample].push_back(symbol_of(model.observable) + " " + signed_percent(effect.effect));
        }
    }
    html += html_table({"observable", "per row", "floor", "per sample", "neighbours correlate by", "source"}, rows);
    if (!effects.empty()) {
        html += paragraph(
            "Replicates differ by an effect of each sample, whatever the model (a model that is fitted may ask for others):");
        html += "<ul class=\"findings\">\n";
        for (const auto& [sample, values] : effects) {
            std::string text;
            for (const std::string& value : values) {
                text += (text.empty() ? "" : ", ") + value;
            }
            html += "<li>" + escaped(sample) + ": " + text + "</li>\n";
        }
        html += "</ul>\n";
    }
    return html;
}

std::string left_out_section(const diagnose::Experiment& experiment) {
    std::string html = heading("Cells left out");
    std::vector<std::vector<std::string>> rows;
    for (const diagnose::Measurement& table : experiment.measurements) {
        std::map<std::string, std::set<std::size_t>> cells;
        std::map<std::string, std::string> reasons;
        for (const diagnose::LeftOutCell& cell : table.left_out) {
            cells[cell.column].insert(cell.row);
            reasons.emplace(cell.column, "‘" + cell.value + "’ " + cell.reason);
        }
        for (const auto& [column, numbers] : cells) {
            rows.push_back({escaped(table.label), readable(column), std::to_string(numbers.size()), row_list(numbers),
                            escaped(reasons[column])});
        }
    }
    if (rows.empty()) {
        return html + paragraph("None: every cell is readable, possible and agrees with the others of its row.");
    }
    return html +
           paragraph(
               "Cells that cannot be read, are impossible or contradict the others of their row are not used and never "
               "repaired.") +
           html_table({"table", "column", "cells", "rows", "the first and why"}, rows);
}

}  // namespace coagula::report
