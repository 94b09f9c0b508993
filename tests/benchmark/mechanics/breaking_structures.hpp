// SPDX-License-Identifier: GPL-3.0-or-later
// Structures whose bonds break, for explicit sweeps.
#pragma once

#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <Eigen/Core>

#include <cstdint>

namespace coagula {

constexpr double radius = 0.25e-6;
constexpr double critical_strain = 1e-4;  ///< strength over normal contact stiffness times radius

inline Packing structure(Index particles, std::uint64_t seed) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = particles / 2;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(particles, radius);
    options.seed = seed;
    return generators::expand_voids(options).packing;
}

/// A sweep in a sheared cell up to this load over the critical strain, its course still to be given.
inline mechanics::RheometerOptions breaking_sweep(double largest_load) {
    mechanics::RheometerOptions run;
    run.model = {.normal_stiffness = 100, .shear_stiffness = 10};
    run.model.normal_strength = run.model.shear_strength = critical_strain * 50 * radius;
    run.boundary = mechanics::RheometerBoundary::periodic;
    run.amplitude = largest_load * critical_strain;
    run.compare_with_rest = false;
    return run;
}

}  // namespace coagula
