// Old Excel workbooks (.xls, BIFF), as TRIOS exports them and spreadsheets save them.
#pragma once

#include <coagula/io/measured_file.hpp>

#include <string>

namespace coagula::io {

/// Whether the bytes begin as a workbook of that kind does.
bool is_workbook(const std::string& bytes);

/// Every sheet with a table is read as a CSV of its own; a sheet of two columns, such as "Details" of TRIOS, holds metadata. FreeXL
/// reads the cells in a child process. Throws InputError.
MeasuredFile read_workbook(const std::string& path);

}  // namespace coagula::io
