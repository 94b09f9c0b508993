// SPDX-License-Identifier: GPL-3.0-or-later
// The sheets of a workbook as one text, which a child process that reads the workbook can send.
#pragma once

#include <string>
#include <string_view>

namespace coagula::io {

constexpr char sheet_mark = '\x1e';  ///< begins the line above a sheet, on which its name may stand; no cell holds it

/// A cell for a line of cells parted by tabs: without control characters and double quotes.
std::string plain_cell(std::string_view text);

/// All sheets of a workbook (.xlsx, Office Open XML): cells parted by tabs, one blank line where rows are left out. To be called in
/// a child process, which bounds time and memory; what the archive holds is bounded here, too. Throws InputError.
std::string text_of_xlsx(const std::string& path);

}  // namespace coagula::io
