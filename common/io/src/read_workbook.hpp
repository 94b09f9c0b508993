// SPDX-License-Identifier: GPL-3.0-or-later
// Excel workbooks, as instruments export them and spreadsheets save them: old ones (.xls, BIFF) and those of XML (.xlsx).
#pragma once

#include <coagula/io/measured_file.hpp>

#include <string>

namespace coagula::io {

/// Whether the bytes begin as a workbook of that kind does.
bool is_workbook(const std::string& bytes);

/// Every sheet with a table is read as a text of its own; a sheet of two columns, such as "Details" of TRIOS, holds metadata. The
/// cells are read in a child process, old ones by FreeXL, new ones by minizip and expat. Throws InputError.
MeasuredFile read_workbook(const std::string& path);

}  // namespace coagula::io
