// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions of one number per particle, for files and figures.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace coagula::characterize {

inline Eigen::VectorXd middles_of_bins(double low, double high, Eigen::Index bins) {
    const double half = (high - low) / static_cast<double>(2 * bins);
    return Eigen::VectorXd::LinSpaced(bins, low + half, high - half);
}

/// Probability density in equal bins from low to high; values outside count in the whole only, NaN not at all.
template <class Values>
Eigen::VectorXd density_in_bins(const Values& values, double low, double high, Eigen::Index bins) {
    const double width = (high - low) / static_cast<double>(bins);
    Eigen::VectorXd density = Eigen::VectorXd::Zero(bins);
    double count = 0;
    for (const double value : values) {
        const double bin = std::floor((value - low) / width);
        if (bin >= 0 && bin < static_cast<double>(bins)) {
            density[static_cast<Eigen::Index>(bin)] += 1;
        }
        count += std::isnan(value) ? 0 : 1;
    }
    return count > 0 ? Eigen::VectorXd(density / (count * width)) : density;
}

}  // namespace coagula::characterize
