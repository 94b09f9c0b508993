// A CSV file with a header: its columns by name, its lines as fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text_reader.hpp"

namespace coagula::io {

class CsvReader {
public:
    /// Reads up to the header: the first line that is filled and does not begin with #. Throws InputError when there is none.
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
    /// The field as a finite number.
    double number(const Column& column) const { return file_->number_in(fields_[column.index], column.name); }
    std::string_view text(const Column& column) const { return fields_[column.index]; }
    const LineReader& file() const { return *file_; }

private:
    LineReader* file_;
    char separator_ = ',';
    std::vector<Column> columns_;
    std::vector<std::string_view> fields_;
};

}  // namespace coagula::io
