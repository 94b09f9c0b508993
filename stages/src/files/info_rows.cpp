// SPDX-License-Identifier: GPL-3.0-or-later
#include "info_rows.hpp"

#include <coagula/common/contact_network.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/recorded_options.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::stages {

namespace {

std::string number_text(double value) {
    return std::isfinite(value) ? to_text(value) : std::string{};
}

std::string cell_text(const io::Dataset& dataset) {
    if (const auto* text = std::get_if<std::string>(&dataset.values)) {
        return *text;
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&dataset.values)) {
        return number_text(numbers->front());
    }
    return std::to_string(std::get<std::vector<std::int64_t>>(dataset.values).front());
}

/// Whether an option says what structure comes out, not where it goes or how it is shown.
bool is_recipe(const Option& option) {
    const std::vector<std::string> others = {"output",          "force",   "checkpoint",   "checkpoint-interval",
                                             "potential-curve", "picture", "heterogeneity"};
    return std::find(others.begin(), others.end(), option.name) == others.end();
}

std::string option_text(const Json& value) {
    if (value.is_string()) {
        return value.get<std::string>();
    }
    return value.is_number_float() ? number_text(value.get<double>()) : value.dump();
}

}  // namespace

void InfoRows::put(const std::string& heading, const std::string& unit, const std::string& text) {
    const std::string name = unit.empty() || unit == "1" ? heading : heading + " [" + unit + "]";
    const auto found = std::find(headings_.begin(), headings_.end(), name);
    const auto column = static_cast<std::size_t>(found - headings_.begin());
    if (found == headings_.end()) {
        headings_.push_back(name);
    }
    rows_.back().resize(std::max(rows_.back().size(), column + 1));
    rows_.back()[column] = text;
}

void InfoRows::put_recipe(const std::string& path, const io::Contents& contents) {
    if (contents.history.empty()) {
        return;
    }
    const io::Provenance& first = contents.history.front();
    const std::string prefix = "generate ";
    put("generator", "", first.stage.starts_with(prefix) ? first.stage.substr(prefix.size()) : first.stage);
    const Json options = recorded_options(path, first.options);
    for (const Verb& verb : {generate_vem_verb(), generate_brownian_verb()}) {
        for (const Option& option : verb.options) {
            if (verb.name == first.stage && options.contains(option.name) && is_recipe(option)) {
                put(option.name, option.unit, option_text(options[option.name]));
            }
        }
    }
    if (first.stage == generate_vem_verb().name && !options.contains("voids")) {  // half of the particles when not given
        put("voids", "1", std::to_string(contents.structure.packing.size() / 2));
    }
}

void InfoRows::add(const std::string& path, const io::Contents& contents) {
    const io::Structure& structure = contents.structure;
    const Packing& packing = structure.packing;
    rows_.emplace_back();
    put("file", "", path);
    put("particles", "1", std::to_string(packing.size()));
    put("periodic", "", packing.cell.is_periodic() ? "true" : "false");
    for (int axis = 0; axis < 3; ++axis) {
        put(std::string("box_") + "xyz"[axis], "m", number_text(packing.cell.edge_lengths()[axis]));
    }
    put("volume_fraction", "1", number_text(volume_fraction(packing)));
    put("radius_mean", "m", number_text(mean_radius(packing)));
    put("bonds", "1", structure.bonds ? std::to_string(structure.bonds->size()) : std::string{});
    put_recipe(path, contents);
    for (const io::Dataset& dataset : contents.results) {
        const bool is_scalar = dataset.shape.empty();
        if (is_scalar) {
            put(dataset.path.substr(1), dataset.unit, cell_text(dataset));
        }
    }
}

std::vector<std::vector<std::string>> InfoRows::with_header() const {
    std::vector<std::vector<std::string>> table = {headings_};
    for (const std::vector<std::string>& row : rows_) {
        table.push_back(row);
        table.back().resize(headings_.size());
    }
    return table;
}

std::vector<std::vector<std::string>> table_of_files(const std::vector<std::string>& paths) {
    InfoRows rows;
    for (const std::string& path : paths) {
        rows.add(path, io::read_contents(path));
    }
    return rows.with_header();
}

}  // namespace coagula::stages
