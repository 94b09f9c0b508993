// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_parts.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace coagula::experiment {

namespace {

constexpr std::size_t shortest_sweep = 5;  // of one of several sweeps in a table

/// Where a column runs in one direction.
std::vector<RowRange> runs_of(const std::vector<double>& values) {
    std::vector<RowRange> runs;
    double last = std::numeric_limits<double>::quiet_NaN();
    double direction = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
        const double step = values[row] - last;
        const bool goes_on = std::isnan(step) || (step != 0 && (direction == 0 || step * direction > 0));
        if (runs.empty() || !goes_on) {
            runs.emplace_back(row, row);
            direction = 0;
        } else {
            runs.back().second = row;
            direction = std::isnan(step) ? direction : step;
        }
        last = std::isnan(values[row]) ? last : values[row];
    }
    return runs;
}

}  // namespace

std::vector<RowRange> sweeps_in(const io::PlainTable& table) {
    std::vector<RowRange> fewest;
    for (const io::PlainColumn& column : table.columns) {
        if (column.quantity == "angular_frequency" || column.quantity == "frequency" || column.quantity == "strain") {
            std::vector<RowRange> runs = runs_of(column.values);
            fewest = fewest.empty() || runs.size() < fewest.size() ? std::move(runs) : fewest;
        }
    }
    std::size_t rows = 0;
    for (const auto& [first, last] : fewest) {
        rows += last - first + 1 >= shortest_sweep ? last - first + 1 : 0;
    }
    return fewest.size() > 1 && 5 * rows >= 4 * table.rows() ? fewest : std::vector<RowRange>{};
}

io::PlainTable part_of(const io::PlainTable& table, const RowRange& rows) {
    io::PlainTable part = table;
    for (io::PlainColumn& column : part.columns) {
        column.values = {column.values.begin() + static_cast<std::ptrdiff_t>(rows.first),
                         column.values.begin() + static_cast<std::ptrdiff_t>(rows.second) + 1};
    }
    std::erase_if(part.unreadable, [&](const io::UnreadableCell& cell) { return cell.row < rows.first || cell.row > rows.second; });
    for (io::UnreadableCell& cell : part.unreadable) {
        cell.row -= rows.first;
    }
    return part;
}

}  // namespace coagula::experiment
