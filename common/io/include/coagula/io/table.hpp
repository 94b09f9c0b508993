// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of numbers as CSV: columns with their units in the header.
#pragma once

#include <coagula/common/checks.hpp>

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace coagula::io {

/// A column to read.
struct TableColumn {
    std::string name;                                    ///< in any case; without the unit
    std::string unit;                                    ///< the values are converted to it; "1" for pure numbers
    std::optional<double> default_unit = {};             ///< worth of the values, in `unit`, where the header names no unit
    bool required = true;                                ///< otherwise the values are empty when there is no such column
    double low = std::numeric_limits<double>::lowest();  ///< the range of the values, in `unit`, ends included
    double high = std::numeric_limits<double>::max();
};

/// Reads columns of a CSV file whose header names them with their units in brackets ("modulus [MPa]"; pure numbers need none);
/// lines before the header that begin with # and other columns are ignored. One vector for each of `columns`, one number per line.
/// Throws InputError that names file, line and rule.
std::vector<Eigen::VectorXd> read_table(const std::string& path, const std::vector<TableColumn>& columns);

/// The fields of one column of such a file as they stand, one per line. Throws InputError where there is no such column.
std::vector<std::string> read_text_column(const std::string& path, const std::string& name);

/// Rows of fields as CSV; fields with separators or quotes are quoted. A text that a spreadsheet would run as a formula ("=...",
/// "+...", "-...", "@...") has an apostrophe in front; numbers stay as they are.
std::string csv_text(const std::vector<std::vector<std::string>>& rows);

/// Writes them through a temporary file and a rename. Throws as write_structure does.
void write_rows(const std::string& path, const std::vector<std::vector<std::string>>& rows, bool overwrite);

}  // namespace coagula::io
