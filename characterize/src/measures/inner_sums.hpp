// Means over the particles that count.
#pragma once

#include <coagula/characterize/measure.hpp>

#include <algorithm>

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

}  // namespace coagula::characterize
