// The particles over which a mean is taken, in 27 blocks of space. Internal.
#pragma once

#include <coagula/characterize/inner_particles.hpp>

#include "block_errors.hpp"

#include <algorithm>
#include <vector>

namespace coagula::characterize {

constexpr int blocks_per_axis = 3;
constexpr Index space_blocks = 27;

/// The block of each particle: a third of the box along each axis, or of the box around an open packing.
std::vector<int> block_of_particles(const Packing& packing);

/// The inner particles, or all if none is inner, and their blocks.
struct AveragedParticles {
    explicit AveragedParticles(const Packing& packing);

    std::vector<Index> particles;
    std::vector<int> block;  ///< of each of the above
};

/// Sums of a quantity and of its weights by block: mean and standard error of their ratio.
class BlockSums {
public:
    void add(int block, double value, double weight = 1) {
        values_[block] += value;
        weights_[block] += weight;
    }
    double total() const { return values_.sum(); }
    double weight() const { return weights_.sum(); }
    /// 0 without any weight.
    double mean() const { return weight() > 0 ? total() / weight() : 0.0; }
    double mean_stderr() const { return weight() > 0 ? ratio_stderr(values_, weights_) : std::numeric_limits<double>::quiet_NaN(); }

private:
    Eigen::Matrix<double, space_blocks, 1> values_ = Eigen::Matrix<double, space_blocks, 1>::Zero();
    Eigen::Matrix<double, space_blocks, 1> weights_ = Eigen::Matrix<double, space_blocks, 1>::Zero();
};

}  // namespace coagula::characterize
