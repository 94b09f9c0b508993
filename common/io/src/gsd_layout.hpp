// SPDX-License-Identifier: GPL-3.0-or-later
// What stands where in a GSD file of version 1 or 2 (https://gsd.readthedocs.io, "File layer"). Numbers are little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace coagula::io::gsd {

inline constexpr std::uint64_t magic = 0x65DF65DF65DF65DF;
inline constexpr std::size_t name_slot = 64;  ///< bytes of a name in version 1; in version 2 the unit of the room for all names

struct Header {
    std::uint64_t magic;
    std::uint64_t index_location;
    std::uint64_t index_allocated;  ///< entries
    std::uint64_t names_location;
    std::uint64_t names_allocated;  ///< slots
    std::uint32_t schema_version;   ///< major * 65536 + minor
    std::uint32_t version;
    std::array<char, 64> application;
    std::array<char, 64> schema;
    std::array<char, 80> reserved;
};
static_assert(sizeof(Header) == 256);

/// One chunk: an array of rows x columns. Entries without a location are not used.
struct Entry {
    std::uint64_t frame;
    std::uint64_t rows;
    std::int64_t location;
    std::uint32_t columns;
    std::uint16_t name;
    std::uint8_t type;
    std::uint8_t flags;
};
static_assert(sizeof(Entry) == 32);

/// Type of the numbers of a chunk.
enum class Type : std::uint8_t { u8 = 1, u16, u32, u64, i8, i16, i32, i64, f32, f64 };

}  // namespace coagula::io::gsd
