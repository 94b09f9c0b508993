#include "info_rows.hpp"

#include <coagula/common/contact_network.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::tools {

namespace {

std::string number(double value) {
    return std::isfinite(value) ? to_text(value) : std::string{};
}

std::string cell_text(const io::Dataset& dataset) {
    if (const auto* text = std::get_if<std::string>(&dataset.values)) {
        return *text;
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&dataset.values)) {
        return number(numbers->front());
    }
    return std::to_string(std::get<std::vector<std::int64_t>>(dataset.values).front());
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

void InfoRows::add(const std::string& path, const io::Structure& structure, const Results& results) {
    const Packing& packing = structure.packing;
    rows_.emplace_back();
    put("file", "", path);
    put("particles", "1", std::to_string(packing.size()));
    put("periodic", "", packing.cell.is_periodic() ? "true" : "false");
    for (int axis = 0; axis < 3; ++axis) {
        put(std::string("box_") + "xyz"[axis], "m", number(packing.cell.lengths()[axis]));
    }
    put("volume_fraction", "1", number(volume_fraction(packing)));
    put("radius_mean", "m", number(mean_radius(packing)));
    put("bonds", "1", structure.bonds ? std::to_string(structure.bonds->size()) : std::string{});
    for (const io::Dataset& dataset : results) {
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

}  // namespace coagula::tools
