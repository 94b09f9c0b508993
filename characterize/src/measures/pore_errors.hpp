// SPDX-License-Identifier: GPL-3.0-or-later
// Standard errors of what follows from the pore-size curve.
#pragma once

#include <coagula/characterize/blocks.hpp>
#include <coagula/characterize/pore_sizes.hpp>

namespace coagula::characterize {

/// Standard errors of what `estimate` makes of a pore-size curve; structures of the same kind have the same void fraction. NaN if
/// the curve is not known by sub-volumes.
inline Eigen::VectorXd pore_errors(const PoreSizes& pores, const std::function<Eigen::VectorXd(const PoreSizes&)>& estimate) {
    const Index radii = pores.radius.size();
    Eigen::MatrixXd sums(2 * radii, pores.void_by_block.cols());
    sums << pores.void_by_block, pores.volume_by_block;
    const auto curve = [&](const Eigen::VectorXd& sum) {
        PoreSizes part = pores;
        const Eigen::ArrayXd open = (sum.head(radii).array() / sum.tail(radii).array()).max(0.0);
        part.exclusion_probability = open / open[0];
        return estimate(part);
    };
    return block_errors(sums, curve, [radii](const Eigen::VectorXd& sum) { return sum[0] / sum[radii]; });
}

/// Standard error of the radius of the largest pore [m], from the largest radius with a void in each sub-volume.
inline double largest_pore_error(const PoreSizes& pores) {
    constexpr double rounding = 1e-12;
    const Index blocks = pores.void_by_block.cols();
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(blocks);
    for (Index block = 0; block < blocks; ++block) {
        for (Index k = 0; k < pores.radius.size(); ++k) {
            if (pores.void_by_block(k, block) > rounding * pores.volume_by_block(k, block)) {
                largest[block] = pores.radius[k];
            }
        }
    }
    return extreme_error(largest);
}

}  // namespace coagula::characterize
