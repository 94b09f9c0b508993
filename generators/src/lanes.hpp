// SPDX-License-Identifier: GPL-3.0-or-later
// Four or eight numbers at a time, with the vector types of GCC and clang.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#define COAGULA_INLINE inline __attribute__((always_inline))
#define COAGULA_INLINE_LAMBDA __attribute__((always_inline))

namespace coagula::generators {

using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));
using FourWhole = std::int32_t __attribute__((vector_size(16)));
using EightWhole = std::int32_t __attribute__((vector_size(32)));

template <class Lanes>
constexpr std::size_t lanes = sizeof(Lanes) / sizeof(double);

template <class Lanes>
struct WholeOf;
template <>
struct WholeOf<Four> {
    using type = FourWhole;
};
template <>
struct WholeOf<Eight> {
    using type = EightWhole;
};

COAGULA_INLINE void load(const double* source, Four& value) {
    std::memcpy(&value, source, sizeof(Four));
}

COAGULA_INLINE void store(double* target, const Four& value) {
    std::memcpy(target, &value, sizeof(Four));
}

/// Rows become columns.
COAGULA_INLINE void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Four ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Four cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// The same in both halves.
COAGULA_INLINE void transpose(Eight& a, Eight& b, Eight& c, Eight& d) {
    const Eight ab_low = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight ab_high = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight cd_low = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight cd_high = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13);
    b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
    c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
}

COAGULA_INLINE void load_two(const double* low, const double* high, Eight& value) {
    Four one;
    Four other;
    load(low, one);
    load(high, other);
    value = __builtin_shufflevector(one, other, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// The first numbers of the rows of four that are named, the second ones, and so on.
template <class Numbers>
COAGULA_INLINE void gather(const double* rows, const Numbers& number, Four& a, Four& b, Four& c, Four& d) {
    load(rows + 4 * static_cast<std::ptrdiff_t>(number[0]), a);
    load(rows + 4 * static_cast<std::ptrdiff_t>(number[1]), b);
    load(rows + 4 * static_cast<std::ptrdiff_t>(number[2]), c);
    load(rows + 4 * static_cast<std::ptrdiff_t>(number[3]), d);
    transpose(a, b, c, d);
}

template <class Numbers>
COAGULA_INLINE void gather(const double* rows, const Numbers& number, Eight& a, Eight& b, Eight& c, Eight& d) {
    const auto row = [&](int lane) COAGULA_INLINE_LAMBDA { return rows + 4 * static_cast<std::ptrdiff_t>(number[lane]); };
    load_two(row(0), row(4), a);
    load_two(row(1), row(5), b);
    load_two(row(2), row(6), c);
    load_two(row(3), row(7), d);
    transpose(a, b, c, d);
}

}  // namespace coagula::generators
