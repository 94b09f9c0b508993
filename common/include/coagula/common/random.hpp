// SPDX-License-Identifier: GPL-3.0-or-later
// Counter-based random numbers (Philox 4x64-10 of Random123): noise is a function of (seed, purpose, step, particle) and so
// does not depend on the number of threads or on the order of evaluation.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>

namespace coagula {

/// What a random number is for; different purposes never share a number.
enum class RandomPurpose : std::uint64_t {
    initial_position = 1,
    radius = 2,
    pore_sample = 3,
    brownian_force = 4,
    perturbation = 5,
    diagnosis = 6,
    brownian_observation = 7,
    equilibration = 8,
    brownian_rotation = 9,
    rotation_observation = 10,
    floppy_motion = 12,
    position_noise = 13,
    thinned_contacts = 14,
    gelb_gubbins_sample = 21,
    test = 100,
};

/// Four independent 64-bit words for one (seed, purpose, step, particle).
std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint64_t particle);

/// Three independent numbers, uniform in (0, 1).
Eigen::Vector3d random_uniform(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint64_t particle);

/// Three independent standard normal numbers (Box-Muller).
Eigen::Vector3d random_normal(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint64_t particle);

/// Three independent standard normal numbers for each of many particles, much faster than one by one, and other numbers: Philox
/// 4x32-10 and Box-Muller, 32 random bits per uniform number (so at most 6.7 standard deviations). The same bits on every
/// processor.
/// @param particles their numbers, which key the noise. @param normals four for each: the three numbers and a zero.
/// @param uniforms null, or the same of three numbers that cost next to nothing more: of 1024 equally probable and equally spaced
/// values each, with mean 0 and variance 1, from the last bits of the words of the angles. The upper bits alone spread the angles
/// over 4096 equal turns, so that normal numbers are the same in distribution whatever these are.
void random_normals(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::span<const std::int32_t> particles,
                    double* normals, double* uniforms = nullptr);

}  // namespace coagula
