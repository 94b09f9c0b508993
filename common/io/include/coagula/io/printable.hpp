// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that somebody else wrote: names of files, what stands in files.
#pragma once

#include <string>
#include <string_view>

namespace coagula::io {

bool is_utf8(std::string_view bytes);

/// The text on one line as a terminal may show it: control characters, which a terminal would obey, become spaces, and bytes that
/// are no UTF-8 the replacement character.
std::string printable(const std::string& text);

}  // namespace coagula::io
