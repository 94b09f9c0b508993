#include <vector>

#include "csv_reader.hpp"

namespace coagula::io {

namespace {

/// A column of lengths and how many of its unit are in a metre.
struct LengthColumn {
    CsvReader::Column column;
    double divisor;
};

/// The first of `names` among the headings.
std::optional<LengthColumn> find_column(const CsvReader& table, const std::vector<std::string_view>& names,
                                        const ImportOptions& options) {
    for (const std::string_view name : names) {
        if (const auto column = table.find(name)) {
            return LengthColumn{*column, per_metre(table.file(), "column " + column->name, column->unit, options)};
        }
    }
    return std::nullopt;
}

std::vector<LengthColumn> find_columns(const CsvReader& table, const ImportOptions& options) {
    std::vector<LengthColumn> columns;
    for (const char* name : {"x", "y", "z"}) {
        const auto column = find_column(table, {name}, options);
        if (!column) {
            table.file().fail(std::string("there is no column ") + name +
                              "; the first line must be a header that names x, y and z");
        }
        columns.push_back(*column);
    }
    if (!options.radius) {
        if (const auto radius = find_column(table, {"radius", "rad", "r"}, options)) {
            columns.push_back(*radius);
        }
    }
    return columns;
}

}  // namespace

RawPacking read_csv(LineReader& file, const ImportOptions& options) {
    CsvReader table(file);
    const std::vector<LengthColumn> columns = find_columns(table, options);
    RawPacking raw;
    while (table.next()) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double value = table.number(columns[i].column) / columns[i].divisor;
            (i < 3 ? raw.coordinates : raw.radii).push_back(value);
        }
        raw.lines.push_back(file.number());
    }
    return raw;
}

}  // namespace coagula::io
