// SPDX-License-Identifier: GPL-3.0-or-later
// Checksums of texts.
#pragma once

#include <string>
#include <string_view>

namespace coagula::io {

/// SHA-256 of the bytes, hexadecimal. Throws std::runtime_error when OpenSSL cannot compute it.
std::string sha256(std::string_view bytes);

}  // namespace coagula::io
