// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that stand side by side in one sheet: the same headings again for each temperature or sample.
#pragma once

#include "rheometer_headings.hpp"

#include <coagula/io/measured_file.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace coagula::io {

struct SideBySide {
    std::size_t shared = 0;  ///< columns in front, such as one axis, that belong to each table
    std::size_t width = 0;   ///< columns that a table has besides
    std::size_t count = 0;   ///< of tables, 2 or more

    /// The columns of one table: those that are shared, then its own.
    std::vector<std::size_t> columns_of(std::size_t table) const;
};

/// How headings repeat, "ω, G', G'', G', G''" or "ω, G', ω, G'", with or without empty columns between the tables; nothing where
/// they do not. A single heading that repeats needs labels above it, which say what differs: else it may be a mistake.
std::optional<SideBySide> side_by_side(const std::vector<HeadingWithUnit>& headings, bool labelled);

/// A column of the temperature that a label such as "20 °C" or "T = 293 K" says; nothing where it says none.
std::optional<PlainColumn> temperature_of_label(const std::string& label, std::size_t rows);

}  // namespace coagula::io
