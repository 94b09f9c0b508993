// SPDX-License-Identifier: GPL-3.0-or-later
// One axis of a chart in gnuplot's words: range, ticks and label in a unit that suits the values.
#pragma once

#include <coagula/report/chart.hpp>

#include <string>
#include <vector>

namespace coagula::report {

/// An axis whose range and unit are settled.
struct SettledAxis {
    ChartAxis axis;
    double scale = 1;  ///< data over this is what is shown
    std::string unit;  ///< as shown; empty: a pure number
    double low = 0;    ///< as shown
    double high = 1;
    bool powers = false;  ///< its numbers are powers of ten, if it is logarithmic over a decade or more
};

/// Throws InputError where the ends that are asked for leave no range, or one that is not above zero on a logarithmic axis.
/// @param values all that the axis must hold, in the unit of the data.
SettledAxis settle(const ChartAxis& axis, const std::vector<double>& values);

/// Whether the numbers of a logarithmic axis are easier to read as powers of ten.
bool wants_powers(const SettledAxis& axis);

/// Range, scale, ticks and label of axis "x", "y" or "y2".
std::string axis_commands(const SettledAxis& axis, const std::string& name);

/// The text in quotes, on one line: gnuplot shows it and carries nothing out.
std::string quoted_text(const std::string& text);

}  // namespace coagula::report
