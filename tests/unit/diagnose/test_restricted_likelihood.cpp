// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/restricted_likelihood.hpp"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace coagula::diagnose {
namespace {

/// Five conditions, three samples, one of them measured twice, two cells missing.
ReplicatedValues example() {
    ReplicatedValues data;
    data.conditions = 5;
    data.samples = 3;
    data.floor_weights = (Eigen::VectorXd(5) << 3, 1, 0.5, 2, 1).finished();
    std::vector<double> values;
    constexpr std::array<Eigen::Index, 4> sample_of_table = {0, 1, 1, 2};
    for (Eigen::Index c = 0; c < 5; ++c) {
        for (std::size_t table = 0; table < 4; ++table) {
            if ((c == 1 && table == 2) || (c == 4 && table == 0)) {
                continue;
            }
            values.push_back((10.0 + 7.0 * static_cast<double>(c)) *
                             (1 + 0.1 * std::sin(3.7 * static_cast<double>(c) + 1.3 * static_cast<double>(table))));
            data.condition.push_back(c);
            data.sample.push_back(sample_of_table[table]);
        }
    }
    data.values = Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
    return data;
}

/// The textbook formulas with full matrices: V, X, P = V^-1 - V^-1 X (X^T V^-1 X)^-1 X^T V^-1.
TEST(RestrictedLikelihood, AgreesWithFullMatrices) {
    const ReplicatedValues data = example();
    const Eigen::Index n = data.values.size();
    const Eigen::VectorXd levels = (Eigen::VectorXd(5) << 11, 16, 25, 30, 39).finished();
    const Eigen::VectorXd own = (Eigen::VectorXd(3) << 0.3, -0.1, 0).finished();
    for (const Deviations& deviations : {Deviations{0.7, 0.05, 0.2}, Deviations{0.1, 0.1, 0}, Deviations{0.4, 0, 1.5}}) {
        Eigen::MatrixXd v = Eigen::MatrixXd::Zero(n, n);
        Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, 5);
        Eigen::MatrixXd z = Eigen::MatrixXd::Zero(n, 3);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Eigen::Index c = data.condition[static_cast<std::size_t>(i)];
            x(i, c) = 1;
            const Eigen::Index s = data.sample[static_cast<std::size_t>(i)];
            z(i, s) = levels[c];
            v(i, i) = std::pow(deviations[0] * data.floor_weights[c], 2) + std::pow(deviations[1] * levels[c] * (1 + own[s]), 2);
        }
        v += deviations[2] * deviations[2] * z * z.transpose();
        const Eigen::MatrixXd w = v.inverse();
        const Eigen::MatrixXd normal = x.transpose() * w * x;
        const Eigen::VectorXd mean = normal.inverse() * x.transpose() * w * data.values;
        const Eigen::VectorXd rest = data.values - x * mean;
        const double expected = 0.5 * (std::log(v.determinant()) + std::log(normal.determinant()) + rest.dot(w * rest));
        const Eigen::VectorXd effects = deviations[2] * deviations[2] * z.transpose() * w * rest;

        const RestrictedFit fit = restricted_fit(data, levels, own, deviations);
        EXPECT_NEAR(fit.minus_log_likelihood, expected, 1e-9 * std::abs(expected));
        EXPECT_LT((fit.levels - mean).norm(), 1e-9 * mean.norm());
        EXPECT_LT((fit.effects - effects).norm(), 1e-9 * (1 + effects.norm()));
    }
}

}  // namespace
}  // namespace coagula::diagnose
