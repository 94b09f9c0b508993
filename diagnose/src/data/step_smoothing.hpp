// SPDX-License-Identifier: GPL-3.0-or-later
// Scatter of a sampled curve about itself, and a smoother that leaves what is more than scatter.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace coagula::diagnose {

/// Standard deviation of each value: a floor and a part in proportion to the value, the most probable ones of the distances from
/// the cubics through the four neighbours, where outliers count less. Needs five rows.
Eigen::VectorXd scatter_of(const Eigen::ArrayXd& times, const Eigen::VectorXd& values);

/// Cholesky factor of a symmetric positive definite matrix with three diagonals below the main one.
class BandedFactor {
public:
    /// @param bands row d holds the entries (i, i - d), d = 0 .. 3; those before the first column are not read.
    explicit BandedFactor(Eigen::Matrix<double, 4, Eigen::Dynamic> bands);
    Eigen::VectorXd solve(Eigen::VectorXd right) const;

private:
    Eigen::Matrix<double, 4, Eigen::Dynamic> bands_;
};

/// Whittaker's smoother: least squares to the values plus third differences from row to row (Eilers 2003, Anal. Chem. 75, 3631),
/// both over about the standard deviations of the values.
/// It smooths a thirtieth of what the scatter allows, in every stretch of 15 rows, so that its own error is below the scatter.
class Smoother {
public:
    Smoother(const Eigen::VectorXd& values, const Eigen::VectorXd& deviations);

    Eigen::VectorXd smoothed(const Eigen::VectorXd& values) const;
    /// Turns weights of the smoothed values into weights of the values themselves.
    Eigen::VectorXcd on_values(const Eigen::VectorXcd& weights) const;

private:
    BandedFactor factor(double strength) const;

    Eigen::VectorXd scales_;              ///< of the values, over which third differences are small
    Eigen::VectorXd precision_;           ///< of the values over the scales
    std::optional<BandedFactor> factor_;  ///< none: the values stay as they are
};

}  // namespace coagula::diagnose
