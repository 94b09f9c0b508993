// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/blocks.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace coagula::characterize {

namespace {

/// The part of the box that holds all particles that count, in fractions of its edges.
struct Bounds {
    Eigen::Array3d lower = Eigen::Array3d::Zero();
    Eigen::Array3d span = Eigen::Array3d::Ones();
};

Bounds find_bounds(const Packing& packing, const std::vector<bool>& counted) {
    Eigen::Array3d lower = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d upper = -lower;
    for (Index i = 0; i < packing.size(); ++i) {
        if (counted.empty() || counted[static_cast<std::size_t>(i)]) {
            const Eigen::Array3d place = packing.cell.fraction(packing.positions.col(i));
            lower = lower.min(place);
            upper = upper.max(place);
        }
    }
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        if (!packing.cell.is_periodic(axis)) {
            bounds.lower[axis] = lower[axis];
            bounds.span[axis] = std::max(upper[axis] - lower[axis], 1e-6 * mean_radius(packing) / packing.cell.widths()[axis]);
        }
    }
    return bounds;
}

Index wanted_blocks(Index particles) {
    constexpr Index enough_for_27 = 4320;
    constexpr Index enough_for_8 = 64;
    return particles >= enough_for_27 ? 27 : (particles >= enough_for_8 ? 8 : 0);
}

}  // namespace

Blocks make_blocks(const Packing& packing, const std::vector<bool>& counted) {
    const Index particles = counted.empty() ? packing.size() : std::count(counted.begin(), counted.end(), true);
    const Index wanted = wanted_blocks(particles);
    Blocks blocks{Eigen::VectorXi::Constant(packing.size(), -1), 0};
    if (wanted == 0) {
        return blocks;
    }
    const Bounds bounds = find_bounds(packing, counted);
    const Eigen::Array3d lengths = bounds.span * packing.cell.edge_lengths().array();
    const double edge = std::cbrt(lengths.prod() / static_cast<double>(wanted));
    const Eigen::Array3i along = (lengths / edge).round().max(1.0).min(static_cast<double>(wanted)).cast<int>();
    std::vector<int> number(static_cast<std::size_t>(along.prod()), -1);  // of the blocks that hold particles
    for (Index i = 0; i < packing.size(); ++i) {
        if (!counted.empty() && !counted[static_cast<std::size_t>(i)]) {
            continue;
        }
        const Eigen::Vector3d inside = packing.cell.wrap(packing.positions.col(i));
        const Eigen::Array3d place = (packing.cell.fraction(inside).array() - bounds.lower) / bounds.span;
        const Eigen::Array3i box = (place * along.cast<double>()).floor().cast<int>().max(0).min(along - 1);
        const int place_of_box = (box[2] * along[1] + box[1]) * along[0] + box[0];
        int& block = number[static_cast<std::size_t>(place_of_box)];
        block = block < 0 ? static_cast<int>(blocks.count++) : block;
        blocks.of_particle[i] = block;
    }
    return blocks;
}

Eigen::MatrixXd sum_by_block(const Blocks& blocks, const Eigen::MatrixXd& values) {
    require(values.cols() == blocks.of_particle.size(), "sums by block need one column of values per particle");
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(values.rows(), blocks.count);
    for (Index i = 0; i < values.cols(); ++i) {
        if (blocks.of_particle[i] >= 0) {
            sums.col(blocks.of_particle[i]) += values.col(i);
        }
    }
    return sums;
}

double extreme_error(const Eigen::VectorXd& extremes) {
    constexpr Index fewest = 4;
    if (extremes.size() < fewest) {
        return unset;
    }
    return std::sqrt((extremes.array() - extremes.mean()).square().sum() / static_cast<double>(extremes.size() - 1));
}

Eigen::VectorXd largest_by_block(const Blocks& blocks, const Eigen::VectorXd& values) {
    Eigen::VectorXd largest = Eigen::VectorXd::Constant(blocks.count, -std::numeric_limits<double>::infinity());
    for (Index i = 0; i < values.size(); ++i) {
        if (blocks.of_particle[i] >= 0) {
            double& found = largest[blocks.of_particle[i]];
            found = std::max(found, values[i]);
        }
    }
    return largest;
}

Eigen::VectorXd block_errors(const Eigen::MatrixXd& sums, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& estimate,
                             const std::function<double(const Eigen::VectorXd&)>& held_fixed) {
    constexpr Index fewest = 4;
    const Index blocks = sums.cols();
    const Eigen::VectorXd total = sums.rowwise().sum();
    if (blocks < fewest) {
        return Eigen::VectorXd::Constant(estimate(total).size(), unset);
    }
    Eigen::MatrixXd without(estimate(total - sums.col(0)).size(), blocks);
    Eigen::RowVectorXd fixed = Eigen::RowVectorXd::Zero(blocks);
    for (Index block = 0; block < blocks; ++block) {
        const Eigen::VectorXd rest = total - sums.col(block);
        without.col(block) = estimate(rest);
        fixed[block] = held_fixed ? held_fixed(rest) : 0.0;
    }
    Eigen::MatrixXd deviations = without.colwise() - without.rowwise().mean();
    auto freedom = static_cast<double>(blocks - 1);
    fixed.array() -= fixed.mean();
    if (const double squares = fixed.squaredNorm(); squares > 0) {
        deviations -= deviations * fixed.transpose() / squares * fixed;
        freedom -= 1;
    }
    const auto count = static_cast<double>(blocks);
    return (deviations.rowwise().squaredNorm() * (count - 1) * (count - 1) / (count * freedom)).cwiseSqrt();
}

}  // namespace coagula::characterize
