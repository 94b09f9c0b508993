// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of measured numbers that no file states: they stand beside the tables, which stay as they were measured.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::diagnose {

/// Knowledge about the errors of a column besides their size.
struct ErrorLaw {
    double correlation = 0;                                    ///< of neighbouring rows, 0 .. 1
    double correlation_error = 0;                              ///< its standard error
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which their size was estimated
    double tail = std::numeric_limits<double>::infinity();     ///< degrees of freedom of Student's t; infinite: normal
};

/// Errors of one column of a table.
struct ColumnErrors {
    std::string column;
    std::vector<double> deviations = {};  ///< standard deviation of each row, in the unit of the column
    ErrorLaw law = {};
};

enum class ErrorSource {
    noise,      ///< a noise model, fitted to replicates or assumed
    reduction,  ///< the step test or waveform that the table was made from
};

/// Errors of a table.
struct TableErrors {
    ErrorSource source = ErrorSource::noise;
    bool polar = false;  ///< those of storage and loss modulus lie along and across G*
    std::vector<ColumnErrors> columns = {};
};

/// All errors of an experiment but those that its tables state.
struct ErrorSpec {
    std::vector<TableErrors> tables = {};                             ///< one per measurement, or none at all
    double sample = 0.1;                                              ///< standard deviation of the factor of a sample, less 1
    double sample_degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which `sample` was estimated
};

/// Null where the errors of this column are stated in its table, or not known.
const ColumnErrors* find_errors(const ErrorSpec& errors, std::size_t measurement, std::string_view column);

}  // namespace coagula::diagnose
