// SPDX-License-Identifier: GPL-3.0-or-later
// Means over the particles that count.
#pragma once

#include <coagula/characterize/measure.hpp>

#include <algorithm>
#include <functional>
#include <vector>

namespace coagula::characterize {

/// Sums over the inner particles (over all if there are none). @param values Q x N, one column per particle.
inline Eigen::VectorXd sum_inner(const MeasureInput& input, const Eigen::MatrixXd& values) {
    const std::vector<bool>& inner = input.inner();
    const bool all = std::find(inner.begin(), inner.end(), true) == inner.end();
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(values.rows());
    for (Index particle = 0; particle < values.cols(); ++particle) {
        if (all || inner[static_cast<std::size_t>(particle)]) {
            sums += values.col(particle);
        }
    }
    return sums;
}

/// Standard errors of per-particle means over the inner particles, for structures of one number density.
/// @param values Q x N, the first row of ones. @param estimate from sums of them to the quantities.
inline Eigen::VectorXd errors_of_means(const MeasureInput& input, const Eigen::MatrixXd& values,
                                       const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& estimate) {
    Eigen::MatrixXd with_volume(values.rows() + 1, values.cols());
    with_volume << values, input.voronoi_cells().volumes.transpose();
    const Index rows = values.rows();
    return block_errors(
        sum_by_block(input.blocks(), with_volume), [&](const Eigen::VectorXd& sums) { return estimate(sums.head(rows)); },
        [rows](const Eigen::VectorXd& sums) { return sums[0] / sums[rows]; });
}

}  // namespace coagula::characterize
