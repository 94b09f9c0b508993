// SPDX-License-Identifier: GPL-3.0-or-later
// Text in any of the encodings that instruments and spreadsheets write.
#pragma once

#include <string>
#include <string_view>

namespace coagula::io {

/// The contents in UTF-8. What they are is told by a byte order mark (UTF-8, UTF-16), by escape sequences (ISO-2022-JP) and by the
/// bytes themselves: UTF-8 where they are valid, else Shift-JIS where most of what is not ASCII are its pairs of bytes, else
/// Windows-1252.
std::string to_utf8(std::string_view bytes);

}  // namespace coagula::io
