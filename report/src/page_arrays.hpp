// SPDX-License-Identifier: GPL-3.0-or-later
// Long arrays inside a page: all in one block of bytes, deflated, in base64.
#pragma once

#include <coagula/report/results.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace coagula::report {

/// Collects arrays; each is named by where it lies in the block.
class PageArrays {
public:
    /// @return {"type": "f32", "at": first byte, "count": numbers}. In single precision.
    Json reals(const std::vector<double>& values);
    /// "u32"; negative numbers are refused.
    Json integers(const std::vector<std::int64_t>& values);
    /// "u8"
    Json flags(const std::vector<std::int64_t>& values);

    /// The block: zlib's format (RFC 1950), which browsers inflate, in base64.
    std::string base64() const;

private:
    template <class Number, class Value>
    Json append(const char* type, const std::vector<Value>& values);

    std::string bytes_;
};

}  // namespace coagula::report
