// SPDX-License-Identifier: GPL-3.0-or-later
#include "resisted_strains.hpp"

#include <coagula/common/percolation.hpp>

#include <iterator>
#include <utility>

namespace coagula::mechanics {

std::array<bool, 6> resisted_strains(const Packing& packing, const ContactNetwork& bonds) {
    constexpr std::array<std::pair<int, int>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
    constexpr double rounding = 1e-9;
    std::array<bool, 6> resisted{};
    for (const Cluster& cluster : find_clusters(packing, bonds)) {
        Eigen::Matrix3Xd ways(3, std::ssize(cluster.windings));  // around the box, in space
        for (Index way = 0; way < ways.cols(); ++way) {
            ways.col(way) = packing.cell.edges() * cluster.windings[static_cast<std::size_t>(way)].cast<double>();
        }
        for (std::size_t strain = 0; strain < axes.size(); ++strain) {
            const auto [a, b] = axes[strain];
            const Eigen::MatrixXd stretch = ways.row(a).transpose() * ways.row(b) + ways.row(b).transpose() * ways.row(a);
            resisted[strain] |= stretch.size() > 0 && stretch.cwiseAbs().maxCoeff() > rounding * ways.squaredNorm();
        }
    }
    return resisted;
}

}  // namespace coagula::mechanics
