// SPDX-License-Identifier: GPL-3.0-or-later
// What the tables of an export are, told by their columns.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/experiment/measured_tables.hpp>
#include <coagula/io/measured_file.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace coagula::experiment {

/// A step of the shear rate.
struct RateStep {
    double rate_before = 0;    ///< [1/s]; 0: from rest
    double rate = 0;           ///< [1/s]
    double stress_before = 0;  ///< steady, at the rate before [Pa]
    double time_zero = 0;      ///< of the step, on the clock of the table [s]
};

/// What a table of an export is, or some rows of it.
struct RecognisedTable {
    std::optional<diagnose::MeasurementKind> kind;  ///< none: nothing that a diagnosis could use
    std::string reason;                             ///< why, such as "angular_frequency goes from 0.1 to 100 rad/s"
    std::size_t place = 0;                          ///< of the table in its file
    ColumnRules rules = {};                         ///< the units that are assumed where the table names none
    std::size_t first = 0;                          ///< row, counted from 1; 0: all rows are meant
    std::size_t last = 0;                           ///< row
    std::optional<RateStep> step = {};              ///< that the rows follow
    bool yields = false;                            ///< the sample softens while the strain grows, or thins while it flows
};

/// An export and what its tables are, in their order. A table that is no waveform has one entry, or, where it holds several sweeps
/// or rates one below the other, one for each of them.
struct RecognisedFile {
    io::MeasuredFile file;
    std::vector<RecognisedTable> tables;
};

/// Reads a file and tells its tables by which of their columns vary. What would not pass `diagnose check` has no kind.
RecognisedFile recognise(const std::string& path);

/// The quantities of the columns with numbers.
std::vector<std::string> understood(const io::PlainTable& table);

/// The rows of an entry.
std::size_t rows_of(const io::PlainTable& table, const RecognisedTable& what);

}  // namespace coagula::experiment
