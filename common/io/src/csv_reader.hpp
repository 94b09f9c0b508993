// SPDX-License-Identifier: GPL-3.0-or-later
// A table in a text file: its columns by name, its lines as fields. Columns are separated by commas, semicolons, tabs or blanks.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text_reader.hpp"

namespace coagula::io {

class CsvReader {
public:
    /// Reads up to the header: the first line that is filled and does not begin with #. Where that line has numbers only, the
    /// header is a comment above it with as many headings, if there is one. Throws InputError for a file without lines.
    explicit CsvReader(LineReader& file);

    /// A column of the header, such as "x [um]" or "radius (nm)".
    struct Column {
        std::string name;   ///< in lower case
        std::string unit;   ///< empty when none is named
        std::size_t index;  ///< of its fields
    };

    /// The first column of this name (in lower case).
    std::optional<Column> find(std::string_view name) const;

    /// Names of all columns, in lower case.
    std::vector<std::string> names() const;

    /// Moves to the next filled line; false at the end. Throws InputError when it has not as many fields as the header.
    bool next();
    /// The field as a finite number, with a decimal comma where the numbers of the file have one and commas do not separate.
    double number(const Column& column);
    std::string_view text(const Column& column) const { return fields_[column.index]; }
    const LineReader& file() const { return *file_; }

private:
    void read_header();

    LineReader* file_;
    char separator_ = ',';
    bool commas_ = false;  ///< whether numbers have had decimal commas
    bool points_ = false;  ///< the same of decimal points
    std::vector<Column> columns_;
    std::vector<std::string_view> fields_;
};

}  // namespace coagula::io
