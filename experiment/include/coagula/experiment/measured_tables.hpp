// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a table from a file into a measurement in SI units.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/io/measured_file.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace coagula::experiment {

/// Choice of columns of a table for a measurement.
struct ColumnRules {
    std::map<std::string, std::string> headings;  ///< quantity -> heading in the file, "G'" or, where that has no unit, "G' [Pa]"
    std::map<std::string, std::string> standard_errors;  ///< quantity -> heading of its standard error
    std::map<std::string, double> constants;             ///< quantity -> SI value for a column that the file lacks
    std::vector<std::string> names;                      ///< of the columns of a file without headings, "" for one not meant
};

/// Converts units, lists unreadable cells as left out, fills in constants, the angular frequency from the frequency and, for a
/// waveform without a clock, the time: its samples cover one period. Columns of unknown meaning are dropped; of columns with one
/// meaning the most special with a number is taken, and those that ignored_columns() lists are not. Throws InputError, naming file
/// and column, for a unit that is missing or of the wrong dimension, or a heading that is not in the file.
diagnose::Measurement to_measurement(const io::PlainTable& table, diagnose::MeasurementKind kind, const std::string& label,
                                     const ColumnRules& rules);

/// Columns with numbers that nobody has a meaning for, as "'heading [unit]'".
std::vector<std::string> not_understood(const io::PlainTable& table, const ColumnRules& rules);

/// Columns of known meaning without a unit that serve checks only, such as a temperature, or a torque beside moduli, as
/// "'heading'".
std::vector<std::string> ignored_columns(const io::PlainTable& table, diagnose::MeasurementKind kind, const ColumnRules& rules);

/// Whether both have the same length and, in each place, the same number or none.
bool same_values(const std::vector<double>& one, const std::vector<double>& other);

}  // namespace coagula::experiment
