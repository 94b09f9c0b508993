// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of exports of instruments ask of a file.
#pragma once

#include <coagula/io/measured_file.hpp>
#include <coagula/io/units.hpp>

#include "temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace coagula::io {

/// The column with the lowest rank of a quantity, or of a heading, in SI units.
inline std::vector<double> values(const PlainTable& table, const std::string& name, const std::string& unit) {
    const PlainColumn* best = nullptr;
    for (const PlainColumn& column : table.columns) {
        if ((column.quantity == name || column.heading == name) && (best == nullptr || column.rank < best->rank)) {
            best = &column;
        }
    }
    if (best == nullptr) {
        throw std::runtime_error("no column " + name);
    }
    return convert(best->values, best->unit.empty() ? "1" : best->unit, unit);
}

inline std::size_t numbers_in(const std::vector<double>& column) {
    return static_cast<std::size_t>(std::count_if(column.begin(), column.end(), [](double value) { return !std::isnan(value); }));
}

inline double value_of(const MeasuredFile& file, const std::string& name) {
    for (const InstrumentValue& value : instrument_values(file)) {
        if (value.name == name) {
            return value.value;
        }
    }
    return unset;
}

inline std::string geometry_of(const MeasuredFile& file) {
    for (const InstrumentValue& value : instrument_values(file)) {
        if (value.name == "geometry") {
            return value.text;
        }
    }
    return "";
}

}  // namespace coagula::io
