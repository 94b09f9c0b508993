// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the pore-size curve and its moments.
#include "measure_options.hpp"
#include "optional_results.hpp"
#include "pore_errors.hpp"

namespace coagula::characterize {

Measure pores_measure();

namespace {

/// Standard errors of mean, mean square and median by the trapezium rule on the curve [m, m2, m].
Eigen::VectorXd size_errors(const PoreSizes& pores) {
    return pore_errors(pores, [](const PoreSizes& curve) {
        const Eigen::VectorXd& p = curve.exclusion_probability;
        const double step = curve.radius[1] - curve.radius[0];
        const double mean = step * (p.sum() - 0.5 * p[0]);
        const double square = 2 * step * p.dot(curve.radius);
        Index k = 1;
        while (k + 1 < p.size() && p[k] > 0.5) {
            ++k;
        }
        const double median = curve.radius[k - 1] + step * (p[k - 1] - 0.5) / (p[k - 1] - p[k]);
        return Eigen::VectorXd{{mean, square, median}};
    });
}

void add_sizes(const PoreSizes& pores, double r0, MeasureResult& result) {
    const Eigen::VectorXd error = size_errors(pores);
    const double largest_error = largest_pore_error(pores);
    result.add("pore_size/mean", pores.mean / r0, "1", "mean pore radius over r0", error[0] / r0);
    result.add("pore_size/second_moment", pores.second_moment / (r0 * r0), "1", "mean square of the pore radius over r0^2",
               error[1] / (r0 * r0));
    result.add("pore_size/median", pores.median / r0, "1", "median pore radius over r0", error[2] / r0);
    result.add("pore_size/max", pores.max / r0, "1", "radius of the largest pore over r0", largest_error / r0);
    result.add("pore_size/mean_m", pores.mean, "m", "mean pore radius", error[0]);
    result.add("pore_size/second_moment_m2", pores.second_moment, "m2", "mean square of the pore radius", error[1]);
    result.add("pore_size/median_m", pores.median, "m", "median pore radius", error[2]);
    result.add("pore_size/max_m", pores.max, "m", "radius of the largest pore", largest_error);
}

/// Standard error of the void fraction; periodic packings of the same kind have the same number of particles.
double void_fraction_error(const MeasureInput& input) {
    const PoreSizes& pores = input.pores();
    const Blocks& blocks = input.blocks();
    if (blocks.count == 0) {
        return unset;
    }
    Eigen::MatrixXd sums(3, blocks.count);
    sums << pores.void_by_block.row(0), pores.volume_by_block.row(0),
        sum_by_block(blocks, Eigen::RowVectorXd::Ones(input.packing().size()));
    const auto fraction = [](const Eigen::VectorXd& sum) { return Eigen::VectorXd::Constant(1, sum[0] / sum[1]); };
    const auto density = [](const Eigen::VectorXd& sum) { return sum[2] / sum[1]; };
    return input.packing().cell.is_periodic() ? block_errors(sums, fraction, density)[0] : block_errors(sums, fraction)[0];
}

void add_space(const MeasureInput& input, MeasureResult& result) {
    const PoreSizes& pores = input.pores();
    result.add("pore_space/void_fraction", pores.void_fraction, "1", "void volume over the volume measured",
               void_fraction_error(input));
    result.add("pore_space/volume", pores.volume, "m3",
               "volume measured: the periodic box, or the inner Voronoi cells of an open packing");
    result.add_count("pore_space/inner_particles", pores.inner_particles, "particles whose Voronoi cells were measured");
    result.add("pore_space/curve_error", pores.curve_error, "1",
               "estimate of the largest error of P by interpolation between radii; 0: every radius was computed");
    if (std::isfinite(pores.cell_volume_defect)) {
        result.add("pore_space/cell_volume_defect", pores.cell_volume_defect, "1",
                   "|sum of the Voronoi cell volumes / box volume - 1|");
    }
}

MeasureResult run_pores(const MeasureInput& input) {
    const PoreSizes& pores = known_pores(input);
    const double r0 = input.r0();
    MeasureResult result;
    add_sizes(pores, r0, result);
    add_space(input, result);
    result.add_vector("pore_curve/radius", pores.radius, "m", "radius r");
    result.add_vector("pore_curve/exclusion_probability", pores.exclusion_probability, "1",
                      "P(r_P > r): probability that a point of the void space is farther than r from every surface");
    result.add_line("mean pore radius", with_unit(pores.mean, "m") + " = " + with_unit(pores.mean / r0, "r0"));
    result.add_line("largest pore radius", with_unit(pores.max, "m") + " = " + with_unit(pores.max / r0, "r0"));
    return result;
}

}  // namespace

Measure pores_measure() {
    return {.name = "pores",
            .summary = "exact pore-size curve (distance of void points to the nearest surface) and its moments",
            .run = run_pores,
            .options = {radii_option(), pore_tolerance_option()}};
}

}  // namespace coagula::characterize
