// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/printable.hpp>

#include <cstddef>

namespace coagula::io {

namespace {

/// Number of bytes of the sequence that begins so; 0 if none does.
std::size_t length_after(unsigned char lead) {
    if (lead < 0x80) {
        return 1;
    }
    if (lead < 0xc2 || lead >= 0xf5) {
        return 0;
    }
    return lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
}

/// Whether a byte can be the second of a sequence (Unicode 15, table 3-7: it is narrower after some leads, which excludes overlong
/// forms, surrogates and what lies beyond U+10FFFF).
bool can_follow(unsigned char lead, unsigned char second) {
    const int low = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
    const int high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
    return second >= low && second <= high;
}

/// Number of bytes of the UTF-8 sequence at `i`; 0 when it is none.
std::size_t sequence_length(std::string_view bytes, std::size_t i) {
    const auto lead = static_cast<unsigned char>(bytes[i]);
    const std::size_t length = length_after(lead);
    if (length == 0 || i + length > bytes.size()) {
        return 0;
    }
    if (length > 1 && !can_follow(lead, static_cast<unsigned char>(bytes[i + 1]))) {
        return 0;
    }
    for (std::size_t k = 2; k < length; ++k) {
        const auto next = static_cast<unsigned char>(bytes[i + k]);
        if (next < 0x80 || next > 0xbf) {
            return 0;
        }
    }
    return length;
}

}  // namespace

bool is_utf8(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size();) {
        const std::size_t length = sequence_length(bytes, i);
        if (length == 0) {
            return false;
        }
        i += length;
    }
    return true;
}

}  // namespace coagula::io
