// SPDX-License-Identifier: GPL-3.0-or-later
// Normal and uniform random numbers for many particles at a time. The loops run over blocks of particles and hold no calls and no
// branches, so that the compiler turns them into vector instructions; without fused multiply-add every variant gives the same bits.
#include <coagula/common/random.hpp>
#include <coagula/common/vector_variants.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace coagula {

namespace {

constexpr std::size_t block = 64;

/// The counters of one block of particles. Encryption turns them into random words.
struct Words {
    alignas(64) std::array<std::array<std::uint32_t, block>, 4> word{};
};

/// Philox 4x32-10: Salmon, Moraes, Dror, Shaw, Proc. SC11 (2011), doi:10.1145/2063384.2063405.
inline __attribute__((always_inline)) void encrypt(Words& words, std::uint64_t seed) {
    constexpr std::uint64_t first_multiplier = 0xD2511F53;
    constexpr std::uint64_t second_multiplier = 0xCD9E8D57;
    auto first_key = static_cast<std::uint32_t>(seed);
    auto second_key = static_cast<std::uint32_t>(seed >> 32U);
    for (int round = 0; round < 10; ++round) {
        for (std::size_t entry = 0; entry < block; ++entry) {
            const std::uint64_t first = first_multiplier * words.word[0][entry];
            const std::uint64_t second = second_multiplier * words.word[2][entry];
            words.word[0][entry] = static_cast<std::uint32_t>(second >> 32U) ^ words.word[1][entry] ^ first_key;
            words.word[1][entry] = static_cast<std::uint32_t>(second);
            words.word[2][entry] = static_cast<std::uint32_t>(first >> 32U) ^ words.word[3][entry] ^ second_key;
            words.word[3][entry] = static_cast<std::uint32_t>(first);
        }
        first_key += 0x9E3779B9;
        second_key += 0xBB67AE85;
    }
}

/// The middle of the interval of width 2^-32 that the word names. Through the bits of a number in [1, 2).
inline __attribute__((always_inline)) double to_unit_interval(std::uint32_t word) {
    const std::uint64_t bits = 0x3FF0000000000000U | (static_cast<std::uint64_t>(word) << 20U) | (std::uint64_t{1} << 19U);
    return std::bit_cast<double>(bits) - 1;
}

/// Natural logarithm of 0 < x < 1 to a few units in the last place: x = 2^e m with m in [sqrt(1/2), sqrt(2)), and
/// ln m = 2 artanh((m - 1)/(m + 1)).
inline __attribute__((always_inline)) double logarithm(double x) {
    constexpr std::uint64_t root_half = 0x3FE6A09E667F3BCDU;
    const std::uint64_t shifted = std::bit_cast<std::uint64_t>(x) - root_half;
    // The exponent as a floating-point number, again through the bits: 2^52 + (e + 1024).
    const std::uint64_t biased = (shifted >> 52U) ^ 0x800U;
    const double exponent = std::bit_cast<double>(0x4330000000000000U | (biased & 0xFFFU)) - (0x1.0p52 + 0x800);
    const auto mantissa = std::bit_cast<double>((shifted & 0x000FFFFFFFFFFFFFU) + root_half);
    const double ratio = (mantissa - 1) / (mantissa + 1);
    const double square = ratio * ratio;
    double series = 1.0 / 19;
    series = series * square + 1.0 / 17;
    series = series * square + 1.0 / 15;
    series = series * square + 1.0 / 13;
    series = series * square + 1.0 / 11;
    series = series * square + 1.0 / 9;
    series = series * square + 1.0 / 7;
    series = series * square + 1.0 / 5;
    series = series * square + 1.0 / 3;
    series = series * square + 1.0;
    return exponent * std::numbers::ln2 + 2 * ratio * series;
}

struct Turn {
    double cosine;
    double sine;
};

/// Cosine and sine of 2 pi x for 0 < x < 1 from the Taylor series in the nearest quarter turn.
inline __attribute__((always_inline)) Turn turn(double x) {
    const double quarters = 4 * x;
    const double rounded = quarters + 0x1.8p52;  // its last bits are the number of quarter turns
    const double angle = (quarters - (rounded - 0x1.8p52)) * (std::numbers::pi / 2);
    const double square = angle * angle;
    double sine = 1.0 / 6227020800;
    sine = sine * square - 1.0 / 39916800;
    sine = sine * square + 1.0 / 362880;
    sine = sine * square - 1.0 / 5040;
    sine = sine * square + 1.0 / 120;
    sine = sine * square - 1.0 / 6;
    sine = angle + angle * square * sine;
    double cosine = -1.0 / 87178291200;
    cosine = cosine * square + 1.0 / 479001600;
    cosine = cosine * square - 1.0 / 3628800;
    cosine = cosine * square + 1.0 / 40320;
    cosine = cosine * square - 1.0 / 720;
    cosine = cosine * square + 1.0 / 24;
    cosine = 1 - 0.5 * square + square * square * cosine;
    // Odd quarter turns exchange cosine and sine; the cosine is negative after 1 and 2 of them, the sine after 2 and 3.
    const auto quarter = std::bit_cast<std::uint64_t>(rounded);
    const std::uint64_t exchange =
        (std::bit_cast<std::uint64_t>(cosine) ^ std::bit_cast<std::uint64_t>(sine)) & (0 - (quarter & 1U));
    const std::uint64_t cosine_sign = ((quarter + 1) & 2U) << 62U;
    const std::uint64_t sine_sign = (quarter & 2U) << 62U;
    return {std::bit_cast<double>(std::bit_cast<std::uint64_t>(cosine) ^ exchange ^ cosine_sign),
            std::bit_cast<double>(std::bit_cast<std::uint64_t>(sine) ^ exchange ^ sine_sign)};
}

COAGULA_VARIANTS void fill_block(Words& words, std::uint64_t seed, double* x, double* y, double* z) {
    encrypt(words, seed);
    for (std::size_t entry = 0; entry < block; ++entry) {
        const double first_radius = std::sqrt(-2 * logarithm(to_unit_interval(words.word[0][entry])));
        const Turn first = turn(to_unit_interval(words.word[1][entry]));
        x[entry] = first_radius * first.cosine;
        y[entry] = first_radius * first.sine;
    }
    for (std::size_t entry = 0; entry < block; ++entry) {
        const double second_radius = std::sqrt(-2 * logarithm(to_unit_interval(words.word[2][entry])));
        z[entry] = second_radius * turn(to_unit_interval(words.word[3][entry])).cosine;
    }
}

/// A uniform number of zero mean and unit variance, from the last ten bits of a word.
inline __attribute__((always_inline)) double to_uniform(std::uint32_t word) {
    constexpr double levels = 1024;
    const double scale = std::sqrt(12 / (levels * levels - 1));
    return scale * (static_cast<double>(static_cast<std::int32_t>(word & 1023U)) - 0.5 * (levels - 1));
}

COAGULA_VARIANTS void spread_block(const Words& words, double* x, double* y, double* z) {
    for (std::size_t entry = 0; entry < block; ++entry) {
        x[entry] = to_uniform(words.word[1][entry]);
        y[entry] = to_uniform(words.word[1][entry] >> 10U);
        z[entry] = to_uniform(words.word[3][entry]);
    }
}

/// Numbers of one block of particles.
struct Triples {
    using Column = std::array<double, block>;
    alignas(64) Column x{};
    alignas(64) Column y{};
    alignas(64) Column z{};

    void copy(std::size_t count, double* target) const {
        for (std::size_t entry = 0; entry < count; ++entry) {
            target[4 * entry] = x[entry];
            target[4 * entry + 1] = y[entry];
            target[4 * entry + 2] = z[entry];
            target[4 * entry + 3] = 0;
        }
    }
};

}  // namespace

void random_normals(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::span<const std::int32_t> particles,
                    double* normals, double* uniforms) {
    Words words;
    Triples numbers;
    for (std::size_t begin = 0; begin < particles.size(); begin += block) {
        const std::size_t count = std::min(block, particles.size() - begin);
        for (std::size_t entry = 0; entry < block; ++entry) {
            words.word[0][entry] = static_cast<std::uint32_t>(step);
            words.word[1][entry] = static_cast<std::uint32_t>(step >> 32U);
            words.word[2][entry] = static_cast<std::uint32_t>(particles[begin + std::min(entry, count - 1)]);
            words.word[3][entry] = static_cast<std::uint32_t>(purpose);
        }
        fill_block(words, seed, numbers.x.data(), numbers.y.data(), numbers.z.data());
        numbers.copy(count, normals + 4 * begin);
        if (uniforms != nullptr) {
            spread_block(words, numbers.x.data(), numbers.y.data(), numbers.z.data());
            numbers.copy(count, uniforms + 4 * begin);
        }
    }
}

}  // namespace coagula
