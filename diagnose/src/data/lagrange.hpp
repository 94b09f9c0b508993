// SPDX-License-Identifier: GPL-3.0-or-later
// The cubic through four points.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace coagula::diagnose {

/// Weights of the values at four of the places in the value of the cubic through them elsewhere.
inline std::array<double, 4> lagrange_weights(const Eigen::ArrayXd& places, const std::array<Eigen::Index, 4>& points,
                                              double where) {
    std::array<double, 4> weights{1, 1, 1, 1};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            if (i != j) {
                weights.at(i) *= (where - places[points.at(j)]) / (places[points.at(i)] - places[points.at(j)]);
            }
        }
    }
    return weights;
}

}  // namespace coagula::diagnose
