// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/pore_sizes.hpp>

#include "coverage_curve.hpp"
#include "pores_of_diagram.hpp"

#include <cmath>

namespace coagula::characterize {

namespace {

/// Simpson's rule for equally spaced values; his 3/8 rule for the last three intervals if their number is odd.
double integrate(const Eigen::ArrayXd& values, double step) {
    Index intervals = values.size() - 1;
    double sum = 0;
    if (intervals % 2 == 1) {
        intervals -= 3;
        sum = 0.375 * (values[intervals] + 3 * values[intervals + 1] + 3 * values[intervals + 2] + values[intervals + 3]);
    }
    for (Index k = 0; k < intervals; k += 2) {
        sum += (values[k] + 4 * values[k + 1] + values[k + 2]) / 3;
    }
    return sum * step;
}

/// Radius where the curve passes 1/2, from the parabola r(P) through the three nearest points.
double find_median(const Eigen::ArrayXd& probability, const Eigen::ArrayXd& radius) {
    Index middle = 1;
    while (middle + 2 < probability.size() && probability[middle] > 0.5) {
        ++middle;
    }
    const Eigen::Array3d p = probability.segment(middle - 1, 3) - 0.5;
    const Eigen::Array3d r = radius.segment(middle - 1, 3);
    const double first = (r[1] - r[0]) / (p[1] - p[0]);
    const double second = (r[2] - r[1]) / (p[2] - p[1]);
    return r[0] - p[0] * first + p[0] * p[1] * (second - first) / (p[2] - p[0]);
}

/// Intervals of the curve that is computed, per interval of the one that is returned: the moments are to be exact to 1e-6.
Index refinement(Index radii) {
    constexpr Index enough = 160;
    return (enough + radii - 2) / (radii - 1);
}

/// One block of all counted particles.
Blocks single_block(const PowerDiagram& diagram) {
    Blocks blocks{Eigen::VectorXi::Constant(static_cast<Index>(diagram.counted.size()), -1), 1};
    for (Index site = 0; site < blocks.of_particle.size(); ++site) {
        blocks.of_particle[site] = diagram.counted[static_cast<std::size_t>(site)] != 0 ? 0 : -1;
    }
    return blocks;
}

/// @param volume of the periodic cell; NaN if open: the cells then move with the growth.
PoreSizes summarize(const CoverageCurve& curve, Index radii, double unit, double volume) {
    const Eigen::ArrayXd cells = std::isnan(volume) ? Eigen::ArrayXd(curve.coverage.cells.rowwise().sum())
                                                    : Eigen::ArrayXd::Constant(curve.coverage.cells.rows(), volume);
    const Eigen::ArrayXd open = 1 - curve.coverage.covered.rowwise().sum().array() / cells;
    Eigen::ArrayXd probability = (open / open[0]).max(0.0).min(1.0);
    const Index intervals = probability.size() - 1;
    probability[intervals] = 0;
    const Eigen::ArrayXd radius = unit * Eigen::ArrayXd::LinSpaced(intervals + 1, 0.0, curve.largest);
    const double step = unit * curve.largest / static_cast<double>(intervals);
    const Index stride = intervals / (radii - 1);
    const auto chosen = Eigen::seqN(0, radii, stride);
    PoreSizes pores;
    pores.radius = radius(chosen);
    pores.exclusion_probability = probability(chosen);
    pores.mean = integrate(probability, step);
    pores.second_moment = integrate(2 * radius * probability, step);
    pores.median = find_median(probability, radius);
    pores.max = unit * curve.largest;
    pores.void_fraction = open[0];
    pores.volume = unit * unit * unit * cells[0];
    const double cubic = unit * unit * unit;
    pores.void_by_block = cubic * (curve.coverage.cells - curve.coverage.covered)(chosen, Eigen::all);
    pores.volume_by_block = cubic * curve.coverage.cells(chosen, Eigen::all);
    return pores;
}

}  // namespace

PoreSizes measure_pores(const ReducedDiagram& reduced, const PoreOptions& options, const Blocks& given_blocks,
                        const Progress& progress) {
    require(options.radii >= 4, "the pore curve was asked for " + std::to_string(options.radii) + " radii, but needs at least 4");
    require_non_negative(options.tolerance, "the tolerance of the pore-size curve");
    require_inner(reduced);
    const Index intervals = refinement(options.radii) * (options.radii - 1);
    const bool periodic = reduced.packing.cell.is_periodic();
    const double volume = periodic ? reduced.packing.cell.volume() : unset;
    const Blocks blocks = given_blocks.count > 0 ? given_blocks : single_block(reduced.diagram);
    const CoverageCurve curve = cover_curve(reduced, intervals, options.tolerance, blocks, progress);
    PoreSizes pores = summarize(curve, options.radii, reduced.unit, volume);
    if (periodic) {
        pores.cell_volume_defect = (curve.coverage.cells.rowwise().sum().array() / volume - 1).abs().maxCoeff();
    }
    pores.inner_particles = reduced.inner_count();
    pores.curve_error = curve.error;
    return pores;
}

PoreSizes measure_pores(const Packing& packing, const PoreOptions& options, const Progress& progress) {
    check(packing);
    progress.update("pore sizes", 0);
    return measure_pores(reduced_diagram(packing), options, {}, progress);
}

}  // namespace coagula::characterize
