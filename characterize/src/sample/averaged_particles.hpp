// SPDX-License-Identifier: GPL-3.0-or-later
// The particles over which a mean is taken, and its standard error from blocks of space (blocks.hpp). Internal.
#pragma once

#include <coagula/characterize/blocks.hpp>
#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::characterize {

/// The block of each particle (N), all of them counted; all 0 if the packing is too small for an error to be told.
struct SpaceBlocks {
    std::vector<int> of_particle;
    Index count = 1;
};
SpaceBlocks space_blocks(const Packing& packing);

/// The inner particles, or all if none is inner, and their blocks.
struct AveragedParticles {
    explicit AveragedParticles(const Packing& packing);

    std::vector<Index> particles;
    std::vector<int> block;  ///< of each of the above
    Index blocks = 1;
};

/// Standard error of sum(numerators) / sum(denominators), one of each per block; NaN with fewer than four blocks.
double ratio_stderr(const Eigen::VectorXd& numerators, const Eigen::VectorXd& denominators);

/// Sums of a quantity and of its weights by block: mean and standard error of their ratio.
class BlockSums {
public:
    explicit BlockSums(Index blocks) : values_(Eigen::VectorXd::Zero(blocks)), weights_(Eigen::VectorXd::Zero(blocks)) {}

    void add(int block, double value, double weight = 1) {
        values_[block] += value;
        weights_[block] += weight;
    }
    double weight() const { return weights_.sum(); }
    /// 0 without any weight.
    double mean() const { return weight() > 0 ? values_.sum() / weight() : 0.0; }
    double mean_stderr() const { return ratio_stderr(values_, weights_); }

private:
    Eigen::VectorXd values_;
    Eigen::VectorXd weights_;
};

}  // namespace coagula::characterize
