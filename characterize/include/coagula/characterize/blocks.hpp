// SPDX-License-Identifier: GPL-3.0-or-later
// Standard errors from sub-volumes of one structure, so that two structures can be compared honestly.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace coagula::characterize {

/// Nearly cubic sub-volumes that share out the particles by their centres.
struct Blocks {
    Eigen::VectorXi of_particle;  ///< N: the block, 0 .. count - 1; -1 for particles that do not count (free surface)
    Index count = 0;              ///< 0 if the packing is too small for an error to be told
};

/// About 27 blocks (3 x 3 x 3 of a cube), 8 of fewer than 4320 counted particles, none of fewer than 64.
/// @param counted N flags of the particles that count, such as inner_particles.hpp; empty: all.
Blocks make_blocks(const Packing& packing, const std::vector<bool>& counted = {});

/// Sums over the particles of each block. @param values Q x N, one column per particle. @returns Q x count.
Eigen::MatrixXd sum_by_block(const Blocks& blocks, const Eigen::MatrixXd& values);

/// Standard errors of quantities that follow from sums over blocks, by leaving out one block at a time (jackknife; Künsch, Ann.
/// Stat. 17 (1989) 1217): sqrt((B - 1) / B * sum of squared deviations). Blocks must be larger than the structure's correlation
/// length.
///
/// Blocks vary in density, but structures of the same kind have one volume fraction. What the quantities owe to the density of the
/// block left out, by linear regression, is therefore taken off when `held_fixed` says how the density follows from the sums.
/// @param sums Q x B: sums over each block. @param estimate from a sum over blocks (Q) to the quantities (K).
/// @param held_fixed from a sum over blocks (Q) to the quantity that all structures of the kind share; empty: none.
/// @returns K standard errors; NaN with fewer than four blocks.
Eigen::VectorXd block_errors(const Eigen::MatrixXd& sums, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& estimate,
                             const std::function<double(const Eigen::VectorXd&)>& held_fixed = {});

/// Standard error of the largest (or smallest) value in a structure: the standard deviation of the largest (smallest) values of the
/// blocks. Larger structures have larger extremes, but where tails are exponential their scatter is the same (Gumbel).
/// @param extremes of the blocks. @returns NaN with fewer than four.
double extreme_error(const Eigen::VectorXd& extremes);

/// The largest value in each block. @param values N, one for each particle.
Eigen::VectorXd largest_by_block(const Blocks& blocks, const Eigen::VectorXd& values);

}  // namespace coagula::characterize
