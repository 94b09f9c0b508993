// SPDX-License-Identifier: GPL-3.0-or-later
// What every reader of measured tables must keep.
#pragma once

#include "measured_readers.hpp"
#include "text_encoding.hpp"

#include "reader_contract.hpp"

namespace coagula::fuzz {

inline void check_table(const io::PlainTable& table) {
    expect(table.point >= 0 && table.announced_points >= 0 && table.section >= 0, "a count of a table is negative");
    for (const io::PlainColumn& column : table.columns) {
        expect(column.values.size() == table.rows(), "a column is not as long as the first");
        for (const double value : column.values) {
            expect(!std::isinf(value), "a number is infinite");
        }
    }
    for (const io::UnreadableCell& cell : table.unreadable) {
        expect(cell.column < table.columns.size() && cell.row < table.rows(), "an unreadable cell lies outside its table");
        expect(std::isnan(table.columns[cell.column].values[cell.row]), "an unreadable cell has a number");
        expect(!cell.reason.empty(), "an unreadable cell has no reason");
    }
}

inline void check_file(const io::MeasuredFile& file) {
    expect(!file.tables.empty(), "there is no table");
    for (const io::PlainTable& table : file.tables) {
        check_table(table);
    }
    for (const io::InstrumentValue& value : io::instrument_values(file)) {
        expect(value.name == "geometry" ? !value.text.empty() : value.value > 0 && std::isfinite(value.value),
               "the value of " + value.name + " is impossible");
    }
}

/// Reads the input by one reader, whether or not it would be recognised.
inline int read_by(const io::MeasuredReader& reader, const std::uint8_t* data, std::size_t size) {
    const io::MeasuredText text{"measured.csv", io::split_lines(io::to_utf8(text_of(data, size)))};
    expect_value_or_sentence(text.path, [&] {
        if (reader.recognises(text)) {
            check_file(reader.read(text));
        }
    });
    return 0;
}

}  // namespace coagula::fuzz
