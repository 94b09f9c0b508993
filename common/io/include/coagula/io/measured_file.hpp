// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that somebody measured: CSV, and what the common rheometer programs export.
#pragma once

#include <coagula/common/checks.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coagula::io {

/// A column as the file has it.
struct PlainColumn {
    std::string heading;   ///< as written there; "column 3" where the file has no headings
    std::string quantity;  ///< what it means, such as "storage_modulus"; empty when the heading is not known
    std::string unit;      ///< UDUNITS text ("%", "mN.m"); empty when none is named
    std::size_t rank =
        0;  ///< of columns with one meaning, the one with the lowest rank is meant: "Oscillation torque" before "Torque"
    std::vector<double> values = {};  ///< in that unit, one per row; NaN where the cell is empty or unreadable
};

/// A cell with something in it that is not a number, or a number that stands for none.
struct UnreadableCell {
    std::size_t column;
    std::size_t row;
    std::string text;
    std::string reason;
};

struct PlainTable {
    std::string test;            ///< RheoCompass: name of the test; of tables side by side: name of the sample; may be empty
    std::string title;           ///< name of result, step or series; may be empty
    int number = 1;              ///< position in the file from 1; a waveform has that of the table it belongs to
    int section = 1;             ///< number that the file gives it: interval of its result, series, step
    int point = 0;               ///< > 0: this is the waveform of that point of the section
    int announced_points = 0;    ///< how many the file says there are; 0: it does not say
    double date = unset;         ///< when the export says it began, as seconds_of_date() [s], or by times of day; NaN: unknown
    bool has_headings = true;    ///< otherwise the columns are "column 1", ... until name_columns() names them
    std::size_t first_line = 0;  ///< of its rows in the file, from 1; 0: unknown
    std::vector<PlainColumn> columns;
    std::vector<UnreadableCell> unreadable;
    std::vector<std::pair<std::string, std::size_t>> flags;  ///< of a status column, such as "ME-", and in how many rows

    std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

enum class MeasuredFormat { csv, rheocompass, rheoplus, trios, trios_json, rheowin, workbook };
std::string_view name_of(MeasuredFormat format);

/// A line "key, value" outside the tables.
struct MetadataEntry {
    std::string group;  ///< heading above it, such as "Geometry Parameters"; may be empty
    std::string key;
    std::string value;
};

struct MeasuredFile {
    std::string path;
    MeasuredFormat format = MeasuredFormat::csv;
    bool decimal_comma = false;
    std::vector<MetadataEntry> metadata;  ///< in the order of the file
    std::vector<PlainTable> tables;       ///< never empty
};

/// Reads a file whose format is recognised by its content: Anton Paar RheoCompass and RheoPlus, TA Instruments TRIOS as text (tabs,
/// semicolons or commas; plain or for a LIMS) and as JSON, HAAKE RheoWin, CSV, and Excel workbooks (.xls, .xlsx), each sheet of
/// which is read as a text of its own (docs/reference/instrument-exports.md). Text may be UTF-8,
/// UTF-16 with a byte order mark, Shift-JIS, ISO-2022-JP or Windows-1252.
///
/// A decimal comma is recognised for the file as a whole; thousands separators (1.234,5, 1 234,5, 1,234.5) are understood where
/// they group three digits. A cell that fits neither, such as 7.67E-01 in a file with decimal commas, is listed as unreadable and
/// never guessed, and so are cells that stand for no value ("******", a loss tangent of 20000). Columns without any number and
/// without a known heading (status texts) are dropped. Throws InputError, naming file, line and rule, when there is no table in the
/// file or when its cells do not stand below their headings; XML and PDF are refused with what to export instead.
MeasuredFile read_measured_file(const std::string& path);

/// Gives the columns of a table without headings their names, such as "strain [%]"; columns with an empty name are dropped. Throws
/// InputError when there are not as many names as columns.
void name_columns(PlainTable& table, const std::vector<std::string>& names);

/// What a heading means: "Speichermodul", "Storage Modulus", "G'" and "storage_modulus" are all "storage_modulus"; empty: not
/// known.
std::string quantity_of_heading(std::string_view heading);

/// What the metadata of an export say about the instrument.
struct InstrumentValue {
    std::string name;    ///< key of [instrument] in an experiment file: "plate_radius", "geometry"
    double value;        ///< in `unit`; unset for a geometry
    std::string unit;    ///< SI
    std::string text;    ///< of a geometry: "plate-plate", "cone-plate", "concentric-cylinders"
    std::string source;  ///< as the file has it: "Diameter 25.0 mm"
};
/// At most one value of each name; zeros, which stand for what nobody entered, are none.
std::vector<InstrumentValue> instrument_values(const MeasuredFile& file);

}  // namespace coagula::io
