// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_encoding.hpp"

#include <coagula/io/printable.hpp>

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace coagula::io {

namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // of a byte that means nothing

/// Conversion of a text into UTF-8 by the C library.
class Conversion {
public:
    Conversion(std::string_view bytes, const char* encoding) : handle_(iconv_open("UTF-8", encoding)), bytes_(bytes) {}
    ~Conversion() {
        if (known()) {
            iconv_close(handle_);
        }
    }
    Conversion(const Conversion&) = delete;
    Conversion& operator=(const Conversion&) = delete;

    bool known() const { return handle_ != reinterpret_cast<iconv_t>(-1); }  // NOLINT: what iconv_open() returns when it fails
    bool done() const { return at_ == bytes_.size(); }

    /// Appends as much as can be converted.
    void convert(std::string& text) {
        for (bool more = true; more && !done();) {
            char* input = bytes_.data() + at_;
            std::size_t left = bytes_.size() - at_;
            char* output = buffer_.data();
            std::size_t room = buffer_.size();
            iconv(handle_, &input, &left, &output, &room);
            more = bytes_.size() - left > at_;
            at_ = bytes_.size() - left;
            text.append(buffer_.data(), buffer_.size() - room);
        }
    }

    void skip(std::size_t width) { at_ = std::min(at_ + width, bytes_.size()); }

private:
    iconv_t handle_;
    std::string bytes_;
    std::size_t at_ = 0;
    std::array<char, 4096> buffer_{};
};

/// Everything, or nothing where a byte does not fit.
std::optional<std::string> converted(std::string_view bytes, const char* encoding) {
    Conversion conversion(bytes, encoding);
    std::string text;
    if (conversion.known()) {
        conversion.convert(text);
    }
    return conversion.known() && conversion.done() ? std::optional(text) : std::nullopt;
}

/// Everything; what does not fit is replaced, `width` bytes at a time.
std::string converted_in_part(std::string_view bytes, const char* encoding, std::size_t width) {
    Conversion conversion(bytes, encoding);
    std::string text;
    while (conversion.known() && !conversion.done()) {
        conversion.convert(text);
        if (!conversion.done()) {
            text += replacement;
            conversion.skip(width);
        }
    }
    return text;
}

/// Whether most bytes beyond ASCII belong to pairs of Shift-JIS with a lead byte from 0x81 to 0x9f, which western text hardly has.
bool looks_like_shift_jis(std::string_view bytes) {
    std::size_t in_pairs = 0;
    std::size_t beyond_ascii = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto lead = static_cast<unsigned char>(bytes[i]);
        const auto trail = i + 1 < bytes.size() ? static_cast<unsigned char>(bytes[i + 1]) : 0;
        beyond_ascii += lead >= 0x80 ? 1 : 0;
        if (lead >= 0x81 && lead <= 0x9f && trail >= 0x40 && trail <= 0xfc && trail != 0x7f) {
            beyond_ascii += trail >= 0x80 ? 1 : 0;
            in_pairs += trail >= 0x80 ? 2 : 1;
            ++i;
        }
    }
    return in_pairs >= 4 && 2 * in_pairs > beyond_ascii;
}

bool has_japanese_escapes(std::string_view bytes) {
    return bytes.find("\x1b$B") != std::string_view::npos || bytes.find("\x1b$@") != std::string_view::npos;
}

}  // namespace

std::string to_utf8(std::string_view bytes) {
    if (bytes.starts_with("\xff\xfe")) {
        return converted_in_part(bytes.substr(2), "UTF-16LE", 2);
    }
    if (bytes.starts_with("\xfe\xff")) {
        return converted_in_part(bytes.substr(2), "UTF-16BE", 2);
    }
    if (bytes.starts_with("\xef\xbb\xbf")) {
        bytes.remove_prefix(3);
    }
    if (has_japanese_escapes(bytes)) {
        if (auto text = converted(bytes, "ISO-2022-JP")) {
            return std::move(*text);
        }
    }
    if (is_utf8(bytes)) {
        return std::string(bytes);
    }
    if (looks_like_shift_jis(bytes)) {
        if (auto text = converted(bytes, "CP932")) {
            return std::move(*text);
        }
    }
    return converted_in_part(bytes, "WINDOWS-1252", 1);
}

}  // namespace coagula::io
