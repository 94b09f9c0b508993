// SPDX-License-Identifier: GPL-3.0-or-later
// Selection of rows and columns of a measured table, and its clock.
#pragma once

#include "toml_keys.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/io/measured_file.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace coagula::experiment {

/// The tables of a file, or the waveforms of them, that the keys table, test, result, section and points name. Throws InputError.
std::vector<const io::PlainTable*> chosen_tables(TomlKeys& keys, const io::MeasuredFile& file, diagnose::MeasurementKind kind);

/// Names a table in messages: "sweep.csv, section 2", or "sweep.csv, table 7" where several have this section.
std::string label_of(const io::MeasuredFile& file, const io::PlainTable& table, const std::string& name);

struct TableSelection {
    std::int64_t first = 1;  ///< row
    std::int64_t last = std::numeric_limits<std::int64_t>::max();
    std::int64_t step = 1;
    std::vector<std::string> without = {};  ///< columns not to be used
    double time_per_row = unset;            ///< [s] where the table has no time; the first row ends after the first of them
    double time_zero = 0;                   ///< [s] on the clock of the table
};

/// Takes the keys rows, without, time_per_row and time_zero. Throws InputError.
TableSelection read_selection(TomlKeys& keys);

/// Takes away rows and columns that are not meant, and sets the clock. Cells left out are listed by the rows that remain. Throws
/// InputError naming the table when nothing remains or a column is missing.
void select(diagnose::Measurement& table, const TableSelection& selection);

/// Columns to do without that a table was left with, or without, before its moduli were derived.
struct ColumnsToDrop {
    std::vector<std::string> names;
    std::vector<std::string> missing;  ///< of these, what the table did not have
};

/// Takes columns away of which nothing else is derived; the strain stays as long as moduli may be those of stress and strain.
ColumnsToDrop drop_given_columns(diagnose::Measurement& table, const std::vector<std::string>& names);

/// Takes the same away once more after moduli and strain have been derived. Throws InputError naming a column that was there
/// neither time.
void drop_derived_columns(diagnose::Measurement& table, const ColumnsToDrop& columns);

}  // namespace coagula::experiment
