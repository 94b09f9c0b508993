// SPDX-License-Identifier: GPL-3.0-or-later
#include "pore_curves.hpp"

#include "data/table_cells.hpp"

#include <coagula/common/checks.hpp>

#include <cmath>

namespace coagula::diagnose {

namespace {

constexpr double rarest = 0.01;                   ///< probability; below, one largest pore decides
constexpr double unstated_error_of_curve = 2e-3;  ///< of a row, sampled in a hundred thousand points

}  // namespace

std::vector<Observation> pores_in(const Experiment& experiment, std::size_t number) {
    const Measurement& table = experiment.measurements[number];
    const Column& column = *find_column(table, "exclusion_probability");
    std::vector<Observation> all;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double value = column.values[row];
        const double radius = cell(table, "pore_radius", row);
        const double stated = column.standard_errors.empty() ? unset : column.standard_errors[row];
        if (value > rarest && value < 1 && radius > 0) {
            all.push_back({{}, number, row, Pore{radius}, value, std::isnan(stated) ? unstated_error_of_curve : stated});
        }
    }
    return all;
}

}  // namespace coagula::diagnose
