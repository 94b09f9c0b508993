#include "text_encoding.hpp"

#include "utf8.hpp"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace coagula::io {

namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // of a byte that means nothing

/// A converter of the C library into UTF-8.
class Converter {
public:
    explicit Converter(const char* encoding) : handle_(iconv_open("UTF-8", encoding)) {}
    ~Converter() {
        if (known()) {
            iconv_close(handle_);
        }
    }
    Converter(const Converter&) = delete;
    Converter& operator=(const Converter&) = delete;

    bool known() const { return handle_ != reinterpret_cast<iconv_t>(-1); }

    /// Appends as many bytes as can be converted and returns how many remain.
    std::size_t convert(std::string_view bytes, std::string& text) {
        char* input = const_cast<char*>(bytes.data());  // iconv reads it only
        std::size_t left = bytes.size();
        for (bool more = true; more;) {
            char* output = buffer_.data();
            std::size_t room = buffer_.size();
            const std::size_t before = left;
            const std::size_t result = iconv(handle_, &input, &left, &output, &room);
            text.append(buffer_.data(), buffer_.size() - room);
            more = result == static_cast<std::size_t>(-1) && left < before && left > 0;
        }
        return left;
    }

private:
    iconv_t handle_;
    std::array<char, 4096> buffer_{};
};

/// Everything, or nothing where a byte does not fit.
std::optional<std::string> converted(std::string_view bytes, const char* encoding) {
    Converter converter(encoding);
    std::string text;
    return converter.known() && converter.convert(bytes, text) == 0 ? std::optional(text) : std::nullopt;
}

/// Everything; what does not fit is replaced, `width` bytes at a time.
std::string converted_in_part(std::string_view bytes, const char* encoding, std::size_t width) {
    Converter converter(encoding);
    std::string text;
    while (converter.known() && !bytes.empty()) {
        bytes.remove_prefix(bytes.size() - converter.convert(bytes, text));
        if (!bytes.empty()) {
            text += replacement;
            bytes.remove_prefix(std::min(width, bytes.size()));
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
    return bytes.find("\x1b$B") != bytes.npos || bytes.find("\x1b$@") != bytes.npos;
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
