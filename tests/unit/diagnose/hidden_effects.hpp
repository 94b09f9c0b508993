// Structures, tables and noise for tests that hide an effect: what the diagnosis is given and what it is not.
#pragma once

#include <coagula/common/logarithmic_steps.hpp>
#include <coagula/common/random.hpp>
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/generators/void_expansion.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace coagula::diagnose {

inline Packing structure(Index particles, std::uint64_t seed, double target_coordination = unset, double volume_fraction = 0.4) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = particles / 2;
    options.volume_fraction = volume_fraction;
    options.radii = Eigen::VectorXd::Constant(particles, 0.25e-6);
    options.seed = seed;
    if (std::isfinite(target_coordination)) {
        options.target_coordination = target_coordination;
    }
    return generators::expand_voids(options).packing;
}

/// Two structures that the diagnosis knows, and what it has simulated of them.
inline Simulator& simulator() {
    static SimulationCache cache;
    static Simulator made({structure(200, 1), structure(200, 2)}, {"first", "second"}, cache);
    return made;
}

inline double drawn_normal(std::uint64_t seed, std::uint64_t number, std::uint64_t step = 3) {
    const auto u = random_uniform(seed, RandomPurpose::test, step, number);
    return std::sqrt(-2 * std::log(1 - u[0])) * std::cos(2 * std::numbers::pi * u[1]);
}

}  // namespace coagula::diagnose
