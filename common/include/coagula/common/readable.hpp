// SPDX-License-Identifier: GPL-3.0-or-later
// Values as people read them: with unit, SI prefix and standard error.
#pragma once

#include <coagula/common/cell.hpp>

#include <string>
#include <utility>
#include <vector>

namespace coagula {

/// Label and text of each line of a short table.
using Table = std::vector<std::pair<std::string, std::string>>;

/// A physical value: five digits, SI prefix for metres, pascals and newtons, "1.4123 MPa".
std::string with_unit(double value, const std::string& unit);

/// "0.4566 +- 0.0014": as many decimals as the error has with two digits. Without an error that is finite and positive, five
/// decimals; one that is not finite is not shown.
std::string with_error(double value, double error);

/// "periodic", "open" or "periodic along x and y"; a tilted box has the edges a, b, c.
std::string describe_periodicity(const Cell& cell);

/// "10.9 x 10.9 x 10.9 um, periodic"; "10.9 x 11.3 x 10.9 um, tilted, periodic".
std::string describe(const Cell& cell);

}  // namespace coagula
