// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: bond-orientational order.
#include <coagula/characterize/bond_order.hpp>

#include "distribution.hpp"
#include "inner_sums.hpp"
#include "optional_results.hpp"

namespace coagula::characterize {

Measure bond_order_measure();

namespace {

/// Standard error of the standard deviation of a value per particle; NaN for those that do not count.
double spread_error(const MeasureInput& input, const Eigen::VectorXd& values) {
    Eigen::MatrixXd moments(3, values.size());
    for (Index i = 0; i < values.size(); ++i) {
        const double value = values[i];
        moments.col(i) = std::isfinite(value) ? Eigen::Vector3d(1, value, value * value) : Eigen::Vector3d::Zero();
    }
    return errors_of_means(input, moments, [](const Eigen::VectorXd& sum) {
        const double mean = sum[1] / sum[0];
        return Eigen::VectorXd::Constant(1, std::sqrt(std::max(0.0, sum[2] / sum[0] - mean * mean)));
    })[0];
}

MeasureResult run_bond_order(const MeasureInput& input) {
    const BondOrder found =
        if_applicable([&] { return measure_bond_order(input.packing(), input.voronoi_faces(), input.inner()); });
    MeasureResult result;
    result.add("bond_order/q4", found.q4_mean, "1", "mean q4 of the Voronoi cells, facets weighted by area", found.q4_mean_stderr);
    result.add("bond_order/q6", found.q6_mean, "1", "mean q6 of the Voronoi cells, facets weighted by area", found.q6_mean_stderr);
    result.add("bond_order/q4_spread", found.q4_spread, "1", "standard deviation of q4", spread_error(input, found.q4));
    result.add("bond_order/q6_spread", found.q6_spread, "1", "standard deviation of q6", spread_error(input, found.q6));
    result.add("bond_order/facets", found.facets, "1", "mean number of facets of a Voronoi cell", found.facets_stderr);
    constexpr Index bins = 50;
    result.add_vector("bond_order/value", middles_of_bins(0, 1, bins), "1", "middles of the bins of q4 and q6");
    result.add_vector("bond_order/q4_density", density_in_bins(found.q4, 0, 1, bins), "1", "probability density of q4");
    result.add_vector("bond_order/q6_density", density_in_bins(found.q6, 0, 1, bins), "1", "probability density of q6");
    if (found.q6.allFinite()) {
        result.add_field("q4", found.q4.transpose(), "1", "q4 of the particle's Voronoi cell");
        result.add_field("q6", found.q6.transpose(), "1", "q6 of the particle's Voronoi cell");
    }
    result.add_line("bond order", "q4 " + with_unit(found.q4_mean, "1") + ", q6 " + with_unit(found.q6_mean, "1"));
    return result;
}

}  // namespace

Measure bond_order_measure() {
    return {.name = "bond_order",
            .summary = "bond-orientational order q4, q6, weighted by the facets of the Voronoi cells",
            .run = run_bond_order};
}

}  // namespace coagula::characterize
