#include "resisted_strains.hpp"

#include <coagula/common/percolation.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace coagula::mechanics {

std::array<bool, 6> resisted_strains(const Packing& packing, const ContactNetwork& bonds) {
    constexpr std::array<std::pair<int, int>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
    const std::vector<Cluster> clusters = find_clusters(packing, bonds);
    std::array<bool, 6> resisted{};
    std::transform(axes.begin(), axes.end(), resisted.begin(), [&](const std::pair<int, int>& axis) {
        return std::any_of(clusters.begin(), clusters.end(), [&](const Cluster& cluster) {
            return cluster.percolates(axis.first) && cluster.percolates(axis.second);
        });
    });
    return resisted;
}

}  // namespace coagula::mechanics
