// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/random.hpp>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <numbers>

namespace coagula {

namespace {

/// The upper 53 bits, moved to the middle of their interval, so that neither 0 nor 1 occurs.
double to_unit_interval(std::uint64_t bits) {
    return (static_cast<double>(bits >> 11U) + 0.5) * 0x1.0p-53;
}

}  // namespace

std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint64_t particle) {
    r123::Philox4x64 generator;
    const r123::Philox4x64::ctr_type counter{{step, particle, 0, 0}};
    const r123::Philox4x64::key_type key{{seed, static_cast<std::uint64_t>(purpose)}};
    const auto words = generator(counter, key);
    return {words[0], words[1], words[2], words[3]};
}

Eigen::Vector3d random_uniform(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint64_t particle) {
    const auto words = random_bits(seed, purpose, step, particle);
    return {to_unit_interval(words[0]), to_unit_interval(words[1]), to_unit_interval(words[2])};
}

Eigen::Vector3d random_normal(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint64_t particle) {
    const auto words = random_bits(seed, purpose, step, particle);
    const double first_radius = std::sqrt(-2 * std::log(to_unit_interval(words[0])));
    const double first_angle = 2 * std::numbers::pi * to_unit_interval(words[1]);
    const double second_radius = std::sqrt(-2 * std::log(to_unit_interval(words[2])));
    const double second_angle = 2 * std::numbers::pi * to_unit_interval(words[3]);
    return {first_radius * std::cos(first_angle), first_radius * std::sin(first_angle), second_radius * std::cos(second_angle)};
}

}  // namespace coagula
