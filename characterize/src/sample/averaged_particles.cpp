// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaged_particles.hpp"

#include <coagula/characterize/inner_particles.hpp>

#include <algorithm>

namespace coagula::characterize {

SpaceBlocks space_blocks(const Packing& packing) {
    const Blocks blocks = make_blocks(packing);
    SpaceBlocks result{std::vector<int>(static_cast<std::size_t>(packing.size()), 0), std::max<Index>(1, blocks.count)};
    if (blocks.count > 0) {
        result.of_particle.assign(blocks.of_particle.begin(), blocks.of_particle.end());
    }
    return result;
}

AveragedParticles::AveragedParticles(const Packing& packing) {
    std::vector<bool> inner = inner_particles(packing);
    if (std::find(inner.begin(), inner.end(), true) == inner.end()) {
        inner.assign(inner.size(), true);
    }
    const Blocks shares = make_blocks(packing, inner);
    blocks = std::max<Index>(1, shares.count);
    for (Index i = 0; i < packing.size(); ++i) {
        if (inner[static_cast<std::size_t>(i)]) {
            particles.push_back(i);
            block.push_back(std::max(0, shares.of_particle[i]));
        }
    }
}

double ratio_stderr(const Eigen::VectorXd& numerators, const Eigen::VectorXd& denominators) {
    Eigen::MatrixXd sums(2, numerators.size());
    sums << numerators.transpose(), denominators.transpose();
    return block_errors(sums, [](const Eigen::VectorXd& sum) { return Eigen::VectorXd::Constant(1, sum[0] / sum[1]); })[0];
}

}  // namespace coagula::characterize
