// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/common/cell_list.hpp>
#include <coagula/common/random.hpp>
#include <coagula/common/surface_distance.hpp>

#include <algorithm>

namespace coagula::characterize {

SampledPores sample_pores(const Packing& packing, const Eigen::VectorXd& radius, Index points, std::uint64_t seed) {
    check(packing);
    require(packing.cell.is_periodic(), "pores are sampled in periodic packings only, and this one has a free surface");
    require(points > 0, "the number of sample points is " + std::to_string(points) + ", but must be positive");
    require(radius.size() > 0 && radius.allFinite() && radius[0] >= 0 && std::is_sorted(radius.begin(), radius.end()),
            "the radii at which pores are sampled must be finite, not negative and ascending");
    const CellList cells(packing.cell, packing.positions, radius[radius.size() - 1] + packing.radii.maxCoeff());
    const Index bins = radius.size() + 1;
    std::vector<Index> histogram(static_cast<std::size_t>(bins), 0);  // void points by the number of radii they exceed
    Index* const counts = histogram.data();
#pragma omp parallel for schedule(static) reduction(+ : counts[:bins])
    for (Index point = 0; point < points; ++point) {
        const Eigen::Vector3d uniform = random_uniform(seed, RandomPurpose::pore_sample, 0, static_cast<std::uint64_t>(point));
        const Eigen::Vector3d position = packing.cell.place(uniform);
        const double distance = surface_distance(cells, packing, position);
        if (distance > 0) {
            ++counts[std::lower_bound(radius.begin(), radius.end(), distance) - radius.begin()];
        }
    }
    SampledPores pores;
    pores.exclusion_probability.resize(radius.size());
    Index farther = 0;
    for (Index k = radius.size(); k-- > 0;) {
        farther += counts[k + 1];
        pores.exclusion_probability[k] = static_cast<double>(farther);
    }
    pores.void_points = farther + counts[0];
    require(pores.void_points > 0, "none of the " + std::to_string(points) + " sample points fell into the void space");
    pores.exclusion_probability /= static_cast<double>(pores.void_points);
    return pores;
}

SampledCheck compare_with_samples(const Packing& packing, const PoreSizes& exact, Index points, std::uint64_t seed) {
    SampledCheck check;
    check.sampled = sample_pores(packing, exact.radius, points, seed);
    check.largest_z = 0;
    const auto trials = static_cast<double>(check.sampled.void_points);
    for (Index k = 0; k < exact.radius.size(); ++k) {
        const double p = exact.exclusion_probability[k];
        if (trials * p * (1 - p) >= 25) {
            const double z = (check.sampled.exclusion_probability[k] - p) / std::sqrt(p * (1 - p) / trials);
            check.largest_z = std::max(check.largest_z, std::abs(z));
            ++check.radii;
        }
    }
    return check;
}

}  // namespace coagula::characterize
