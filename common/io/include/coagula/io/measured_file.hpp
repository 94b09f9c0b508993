// Tables that somebody measured: CSV with a header, and what the two common rheometer programs export.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coagula::io {

/// A column as the file has it.
struct PlainColumn {
    std::string heading;         ///< as written there
    std::string quantity;        ///< what it means, such as "storage_modulus"; empty when the heading is not known
    std::string unit;            ///< UDUNITS text as written there ("%", "mN·m"); empty when none is named
    std::vector<double> values;  ///< in that unit, one per row; NaN where the cell is empty or unreadable
};

/// A cell with something in it that is not a number.
struct UnreadableCell {
    std::size_t column;
    std::size_t row;
    std::string text;
    std::string reason;
};

struct PlainTable {
    std::string title;         ///< name of test, result or step; may be empty
    int section = 1;           ///< position in the file from 1; RheoCompass: number of the interval within its result
    int point = 0;             ///< > 0: this is the waveform of that point of the section
    int announced_points = 0;  ///< how many the file says there are; 0: it does not say
    std::vector<PlainColumn> columns;
    std::vector<UnreadableCell> unreadable;

    std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

enum class MeasuredFormat { csv, rheocompass, trios };
std::string_view name_of(MeasuredFormat format);

struct MeasuredFile {
    std::string path;
    MeasuredFormat format = MeasuredFormat::csv;
    bool decimal_comma = false;
    std::vector<std::pair<std::string, std::string>> metadata;  ///< lines "key, value" outside the tables, in their order
    std::vector<PlainTable> tables;
};

/// Reads a file whose format is recognised by its content. UTF-8, UTF-16 with a byte order mark, or Windows-1252.
///
/// CSV: one table; the first line that is not blank and does not begin with # is the header, each heading with its unit in
/// brackets, "strain [%]"; fields separated by comma, semicolon or tab. Anton Paar RheoCompass, CSV export, English or German: a
/// table per interval, and one per point that comes with its waveform. TA Instruments TRIOS, text export (plain or for a LIMS): a
/// table per [step].
///
/// A decimal comma is recognised for the file as a whole; thousands separators (1.234,5, 1 234,5, 1,234.5) are understood where
/// they group three digits. A cell that fits neither, such as 7.67E-01 in a file with decimal commas, is listed as unreadable and
/// never guessed. Columns without any number and without a known heading (status texts) are dropped. Throws InputError, naming
/// file, line and rule, when there is no table in the file.
MeasuredFile read_measured_file(const std::string& path);

/// What a heading means: "Speichermodul", "Storage Modulus", "G'" and "storage_modulus" are all "storage_modulus"; empty: not
/// known.
std::string quantity_of_heading(std::string_view heading);

}  // namespace coagula::io
