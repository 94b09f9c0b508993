// SPDX-License-Identifier: GPL-3.0-or-later
// Noise of drawn data.
#pragma once

#include <coagula/common/random.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace coagula::diagnose {

/// A standard normal number, the same for the same three numbers.
inline double normal_number(std::uint64_t seed, std::uint64_t step, std::uint64_t number) {
    const auto u = random_uniform(seed, RandomPurpose::diagnosis, step, number);
    return std::sqrt(-2 * std::log(1 - u[0])) * std::cos(2 * std::numbers::pi * u[1]);
}

}  // namespace coagula::diagnose
