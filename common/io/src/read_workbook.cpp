// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_workbook.hpp"

#include "child_process.hpp"
#include "measured_readers.hpp"
#include "workbook_text.hpp"

#include <coagula/io/input_file.hpp>

#include <freexl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace coagula::io {

namespace {

std::string text_of(double number) {
    std::array<char, 32> digits{};
    char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return {digits.data(), end};
}

std::string text_of(const FreeXL_CellValue& cell) {
    switch (cell.type) {
        case FREEXL_CELL_INT:
            return std::to_string(cell.value.int_value);  // NOLINT: a union of FreeXL
        case FREEXL_CELL_DOUBLE:
            return text_of(cell.value.double_value);  // NOLINT
        case FREEXL_CELL_TEXT:
        case FREEXL_CELL_SST_TEXT:
        case FREEXL_CELL_DATE:
        case FREEXL_CELL_DATETIME:
        case FREEXL_CELL_TIME:
            return plain_cell(cell.value.text_value == nullptr ? "" : cell.value.text_value);  // NOLINT
        default:
            return "";
    }
}

/// An open workbook.
class Workbook {
public:
    explicit Workbook(const std::string& path) : path_(path) { check(freexl_open(path.c_str(), &handle_)); }
    ~Workbook() { freexl_close(handle_); }
    Workbook(const Workbook&) = delete;
    Workbook& operator=(const Workbook&) = delete;

    /// All sheets, cells parted by tabs; a line that begins with the mark stands above each.
    std::string text() const {
        unsigned int sheets = 0;
        check(freexl_get_info(handle_, FREEXL_BIFF_SHEET_COUNT, &sheets));
        std::string text;
        for (unsigned int sheet = 0; sheet < sheets; ++sheet) {
            check(freexl_select_active_worksheet(handle_, static_cast<unsigned short>(sheet)));
            text += sheet_mark;
            text += '\n' + rows();
        }
        return text;
    }

private:
    void check(int result) const {
        if (result != FREEXL_OK) {
            throw InputError(path_ + " is an old Excel workbook (.xls) that cannot be read (FreeXL error " +
                             std::to_string(result) + "): save each sheet as CSV");
        }
    }

    std::string rows() const {
        unsigned int rows = 0;
        unsigned short columns = 0;
        check(freexl_worksheet_dimensions(handle_, &rows, &columns));
        std::string text;
        for (unsigned int row = 0; row < rows; ++row) {
            std::string line;
            for (unsigned short column = 0; column < columns; ++column) {
                FreeXL_CellValue cell{};
                check(freexl_get_cell_value(handle_, row, column, &cell));
                line += (column > 0 ? "\t" : "") + text_of(cell);
            }
            line.erase(line.find_last_not_of('\t') + 1);
            text += line + '\n';
        }
        return text;
    }

    const std::string& path_;
    const void* handle_ = nullptr;
};

/// A sheet is a CSV, or what RheoCompass or RheoPlus exports.
const MeasuredReader& reader_of_sheet(const MeasuredText& text) {
    for (const MeasuredReader* reader : {&rheocompass_reader, &rheoplus_reader, &units_line_reader}) {
        if (reader->recognises(text)) {
            return *reader;
        }
    }
    return csv_reader;
}

std::size_t filled(const std::vector<std::string>& cells) {
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [](const std::string& cell) { return !cell.empty(); }));
}

/// A sheet with lines of three cells holds a table, another one metadata.
void add_sheet(const std::string& name, const std::vector<std::string>& lines, MeasuredFile& file) {
    const bool is_table =
        std::any_of(lines.begin(), lines.end(), [](const std::string& line) { return filled(split_cells(line, '\t')) > 2; });
    if (is_table) {
        const MeasuredText text{file.path, lines};
        MeasuredFile sheet = reader_of_sheet(text).read(text);
        for (PlainTable& table : sheet.tables) {
            table.title = table.title.empty() ? name : table.title;
            table.section = static_cast<int>(file.tables.size()) + 1;
            table.first_line = 0;  // lines of a sheet, not of the file
            file.tables.push_back(std::move(table));
        }
        std::move(sheet.metadata.begin(), sheet.metadata.end(), std::back_inserter(file.metadata));
        return;
    }
    for (const std::string& line : lines) {
        const std::vector<std::string> cells = split_cells(line, '\t');
        if (cells.size() == 2 && !cells[0].empty() && !cells[1].empty()) {
            file.metadata.push_back({"", cells[0], cells[1]});
        }
    }
}

bool is_xlsx(const std::string& bytes) {
    return bytes.starts_with("PK\x03\x04");
}

}  // namespace

std::string plain_cell(std::string_view text) {
    std::string cell;
    for (const char c : text) {
        const bool control = static_cast<unsigned char>(c) < 0x20;
        cell += c == '"' ? "''" : std::string(1, control ? ' ' : c);
    }
    return cell;
}

bool is_workbook(const std::string& bytes) {
    return bytes.starts_with("\xd0\xcf\x11\xe0") || is_xlsx(bytes);
}

MeasuredFile read_workbook(const std::string& path) {
    const bool xlsx = is_xlsx(read_file(path));
    const std::string text =
        run_in_child(path, [&](ReadingLimits& /*limits*/) { return xlsx ? text_of_xlsx(path) : Workbook(path).text(); });
    MeasuredFile file{path, MeasuredFormat::workbook, false, {}, {}};
    std::string name;
    std::vector<std::string> sheet;
    for (std::string& line : split_lines(text)) {
        if (line.starts_with(sheet_mark)) {
            add_sheet(name, sheet, file);
            name = line.substr(1);
            sheet.clear();
        } else {
            sheet.push_back(std::move(line));
        }
    }
    add_sheet(name, sheet, file);
    if (file.tables.empty()) {
        throw InputError(path + " is a workbook whose sheets hold no table of three columns or more");
    }
    return file;
}

}  // namespace coagula::io
