// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_scatter.hpp"

#include <coagula/common/dense.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

// tests/benchmark/drag_scatter.py measures what the next constants state.
constexpr double particles_of_scatter = 400;  ///< number of particles of a structure with the scatter below
constexpr double least_scatter = 0.02;        ///< standard deviation of the logarithm where all particles are dragged along
constexpr double slow_scatter = 0.1;          ///< added to it at a reduced drag of 1e-3; it grows towards weaker drag
constexpr double largest_scatter = 1.5;       ///< upper limit of what is added, where even the slowest motions follow
constexpr double decades = 2.2;               ///< decades of drag over which errors are correlated
/// Weight of the stated scale in degrees of freedom. It is small, because other coordinations scatter by up to 1.5 times as much.
constexpr double stated_degrees = 6;
constexpr double least_share = 1e-2;  ///< errors with a smaller share of the largest eigenvalue are dropped

/// Standard deviation of the logarithm of the mean reduced viscosity of structures with so many particles together.
ArrayXd stated_scatter(const ArrayXd& drags, double particles) {
    const ArrayXd slow = slow_scatter * (drags / 1e-3).pow(-1.0 / 3);
    const ArrayXd one = least_scatter + slow.min(largest_scatter);
    return (one.square().expm1() * (particles_of_scatter / particles)).log1p().sqrt();
}

/// Matern correlation of order 3/2: 0.94, 0.81 and 0.53 over a half, one and two decades. A smoother correlation would claim to
/// know the shape of the curve better than it is known.
MatrixXd correlation(const ArrayXd& drags) {
    const ArrayXd places = drags.log10() / decades;
    const Index count = places.size();
    const Eigen::ArrayXXd distance = std::sqrt(3.0) * (places.replicate(1, count) - places.transpose().replicate(count, 1)).abs();
    return (1 + distance) * (-distance).exp();
}

}  // namespace

DragScatter drag_scatter(const ArrayXd& drags, double particles, const MatrixXd& logarithms, Index means, Index averaged) {
    const ArrayXd scatter = stated_scatter(drags, particles);
    const MatrixXd alike = correlation(drags);
    const auto nodes = static_cast<double>(drags.size());
    // Degrees of freedom of a mean square over correlated nodes (Satterthwaite).
    const double independent = nodes * nodes / alike.squaredNorm();
    const double degrees = independent * static_cast<double>(logarithms.cols() - means);
    const double mean_square = (logarithms.array().colwise() / scatter).square().sum() / nodes;
    const double variance = (stated_degrees + independent * mean_square) / (stated_degrees + degrees);

    const dense::SymmetricModes axes(alike);
    const ArrayXd shares = axes.values.array() / axes.values.maxCoeff();
    const auto kept = std::count_if(shares.begin(), shares.end(), [](double share) { return share > least_share; });
    const ArrayXd of_mean = stated_scatter(drags, particles * static_cast<double>(averaged));
    const ArrayXd deviation = std::sqrt(variance) * of_mean;
    return {0.5 * of_mean.square(),
            deviation.matrix().asDiagonal() * axes.vectors.rightCols(kept) * axes.values.tail(kept).cwiseSqrt().asDiagonal(),
            stated_degrees + degrees};
}

}  // namespace coagula::diagnose
