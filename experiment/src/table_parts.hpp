// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a table from a file.
#pragma once

#include <coagula/io/measured_file.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace coagula::experiment {

using RowRange = std::pair<std::size_t, std::size_t>;  ///< first and last row, counted from 0

/// The sweeps that a table holds one below the other, by the axis that turns back least often; nothing where hardly any row belongs
/// to one.
std::vector<RowRange> sweeps_in(const io::PlainTable& table);

/// Some rows of a table.
io::PlainTable part_of(const io::PlainTable& table, const RowRange& rows);

}  // namespace coagula::experiment
