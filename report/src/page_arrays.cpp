// SPDX-License-Identifier: GPL-3.0-or-later
#include "page_arrays.hpp"

#include <coagula/common/checks.hpp>

#include <zlib.h>

#include <bit>
#include <stdexcept>

namespace coagula::report {

namespace {

static_assert(std::endian::native == std::endian::little, "browsers read the arrays in the order of their own processor");

// NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the bytes of numbers, and those of zlib, which are unsigned
std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION) != Z_OK) {
        throw std::runtime_error("the arrays of the page could not be deflated");
    }
    packed.resize(size);
    return packed;
}

}  // namespace

template <class Number, class Value>
Json PageArrays::append(const char* type, const std::vector<Value>& values) {
    while (bytes_.size() % sizeof(Number) != 0) {
        bytes_.push_back('\0');
    }
    const std::size_t at = bytes_.size();
    for (const Value& value : values) {
        const auto number = static_cast<Number>(value);
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return {{"type", type}, {"at", at}, {"count", values.size()}};
}
// NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)

Json PageArrays::reals(const std::vector<double>& values) {
    return append<float>("f32", values);
}

Json PageArrays::integers(const std::vector<std::int64_t>& values) {
    for (const std::int64_t value : values) {
        require(value >= 0 && value <= UINT32_MAX, "an array of the page holds " + std::to_string(value));
    }
    return append<std::uint32_t>("u32", values);
}

Json PageArrays::flags(const std::vector<std::int64_t>& values) {
    return append<std::uint8_t>("u8", values);
}

std::string PageArrays::base64() const {
    static constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::string packed = deflated(bytes_);
    std::string text;
    text.reserve(4 * (packed.size() / 3 + 1));
    for (std::size_t at = 0; at < packed.size(); at += 3) {
        const auto byte = [&](std::size_t k) {
            return at + k < packed.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(packed[at + k])) : 0U;
        };
        const std::uint32_t group = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (std::size_t k = 0; k < 4; ++k) {
            text += at + k > packed.size() ? '=' : digits[group >> (18U - 6U * k) & 63U];
        }
    }
    return text;
}

}  // namespace coagula::report
