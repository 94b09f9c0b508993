// SPDX-License-Identifier: GPL-3.0-or-later
#include "coverage_curve.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/parallel.hpp>

#include "geometry/spline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace coagula::characterize {

namespace {

constexpr const char* stage = "pore sizes";

double require_void(double largest_power) {
    require(largest_power > 0, "the spheres cover all space: there are no pores to measure");
    return largest_power;
}

double largest_equal_pore(const PowerDiagram& diagram) {
    const double radius = diagram.radii[0];
    const double power = require_void(largest_vertex_power(diagram));
    return power / (std::sqrt(radius * radius + power) + radius);  // of (radius + largest)^2 - radius^2 = power
}

CoverageCurve cover_equal(const PowerDiagram& diagram, Index intervals, const Blocks& blocks, const Progress& progress) {
    const double largest = largest_equal_pore(diagram);
    const RadialGrid grid{diagram.radii[0], largest / static_cast<double>(intervals), intervals + 1};
    return {largest, cover_equal_spheres(diagram, grid, blocks, progress)};
}

/// Growth at which the power of the point between four sites vanishes: by the secant method from `growth` on.
double closing_growth(const PowerDiagram& diagram, const std::array<int, 4>& sites, double growth) {
    constexpr double step = 1e-3;
    constexpr int most_steps = 60;
    double here = growth;
    double there = growth + step;
    double power_here = power_of_vertex(diagram, sites, 0);
    for (int k = 0; k < most_steps; ++k) {
        const double power_there = power_of_vertex(diagram, sites, there - growth);
        if (power_there == power_here || std::abs(there - here) < 1e-14) {
            break;
        }
        const double next = there - power_there * (there - here) / (power_there - power_here);
        here = there;
        power_here = power_there;
        there = next;
    }
    return std::isfinite(there) ? std::max(there, 0.0) : growth + step;
}

/// Growth at which the largest vertex power vanishes: the last pore is closed. Each diagram names the vertex that is closed last,
/// and where it closes the next diagram is made: a few are enough.
double largest_unequal_pore(const Packing& packing, const PowerDiagram& original, double& margin) {
    constexpr double converged = 1e-11;
    constexpr int most_diagrams = 60;
    DiagramVertex vertex = largest_vertex(original);
    require_void(vertex.power);
    double growth = closing_growth(original, vertex.sites, 0);
    for (int k = 0; k < most_diagrams; ++k) {
        const PowerDiagram diagram = grown_diagram(packing, original, growth, margin);
        margin = std::max(margin, diagram.margin);
        vertex = largest_vertex(diagram);
        const double next = closing_growth(diagram, vertex.sites, growth);
        if (std::abs(next - growth) < converged) {
            return next;
        }
        growth = next;
    }
    throw std::runtime_error("the radius of the largest pore could not be found");
}

/// How many triangulations may be in memory at once.
std::size_t parallel_diagrams(const PowerDiagram& diagram) {
    constexpr double bytes_per_site = 2500;
    constexpr double memory = 2e9;
    const double fit = memory / (bytes_per_site * static_cast<double>(diagram.positions.cols()));
    return static_cast<std::size_t>(std::clamp(fit, 1.0, 1000.0));
}

/// Covered and cell volumes by block at some growths of the radii.
Coverage cover_grown(const Packing& packing, const PowerDiagram& original, double margin, const Eigen::VectorXd& growths,
                     const Blocks& blocks) {
    Coverage coverage{Eigen::MatrixXd(growths.size(), blocks.count), Eigen::MatrixXd(growths.size(), blocks.count)};
    const auto cover = [&](std::size_t k) {
        const auto row = static_cast<Index>(k);
        const Eigen::Matrix2Xd volumes = cover_spheres(grown_diagram(packing, original, growths[row], margin), blocks);
        coverage.covered.row(row) = volumes.row(0);
        coverage.cells.row(row) = volumes.row(1);
    };
    run_together(static_cast<std::size_t>(growths.size()), cover, parallel_diagrams(original));
    return coverage;
}

/// Growths at which the curve is computed: denser where the balls begin to grow.
Eigen::VectorXd node_growths(Index intervals, double largest) {
    return largest * (Eigen::ArrayXd::LinSpaced(intervals + 1, 0, 1)).pow(1.5);
}

Eigen::VectorXd uncovered_fraction(const Coverage& coverage) {
    const Eigen::ArrayXd open = 1 - coverage.covered.rowwise().sum().array() / coverage.cells.rowwise().sum().array();
    return open / open[0];
}

/// The new nodes between the old ones, and all of them in order.
Coverage merge_coverage(const Coverage& old_nodes, const Coverage& new_nodes) {
    const Index count = old_nodes.covered.rows() + new_nodes.covered.rows();
    Coverage merged{Eigen::MatrixXd(count, old_nodes.covered.cols()), Eigen::MatrixXd(count, old_nodes.covered.cols())};
    for (Index k = 0; k < count; ++k) {
        const Coverage& source = k % 2 == 0 ? old_nodes : new_nodes;
        merged.covered.row(k) = source.covered.row(k / 2);
        merged.cells.row(k) = source.cells.row(k / 2);
    }
    return merged;
}

/// The power cells move as unequal balls grow, so that each growth needs a diagram of its own. The curve is computed at a few
/// growths and interpolated by a cubic spline; their number is doubled until the spline through every second one meets the others.
CoverageCurve cover_unequal(const Packing& packing, const PowerDiagram& original, Index intervals, double tolerance,
                            const Blocks& blocks, const Progress& progress) {
    constexpr double gain = 4;  // error of every second node over that of all nodes; 16 for a smooth curve
    double margin = original.margin;
    CoverageCurve curve;
    curve.largest = largest_unequal_pore(packing, original, margin);
    const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(intervals + 1, 0, curve.largest);
    Index nodes = 16;
    Coverage coverage;
    if (tolerance > 0) {
        coverage = cover_grown(packing, original, margin, node_growths(nodes, curve.largest), blocks);
    }
    while (tolerance > 0 && 2 * nodes < intervals) {
        progress.update(stage, 0.3 + 0.7 * static_cast<double>(nodes) / static_cast<double>(intervals));
        const Eigen::VectorXd finer = node_growths(2 * nodes, curve.largest);
        const Eigen::VectorXd between = finer(Eigen::seqN(1, nodes, 2));
        const Eigen::VectorXd coarser = node_growths(nodes, curve.largest);
        const Eigen::VectorXd guess = spline_interpolate(coarser, uncovered_fraction(coverage), between);
        coverage = merge_coverage(coverage, cover_grown(packing, original, margin, between, blocks));
        nodes *= 2;
        const Eigen::VectorXd found = uncovered_fraction(coverage)(Eigen::seqN(1, nodes / 2, 2));
        curve.error = (found - guess).cwiseAbs().maxCoeff() / gain;
        if (curve.error < tolerance) {
            curve.coverage = {spline_interpolate(finer, coverage.covered, wanted),
                              spline_interpolate(finer, coverage.cells, wanted)};
            return curve;
        }
    }
    curve.error = 0;
    curve.coverage = cover_grown(packing, original, margin, wanted, blocks);
    return curve;
}

}  // namespace

double largest_pore(const ReducedDiagram& reduced) {
    double margin = reduced.diagram.margin;
    return is_monodisperse(reduced.packing) ? largest_equal_pore(reduced.diagram)
                                            : largest_unequal_pore(reduced.packing, reduced.diagram, margin);
}

CoverageCurve cover_curve(const ReducedDiagram& reduced, Index intervals, double tolerance, const Blocks& blocks,
                          const Progress& progress) {
    return is_monodisperse(reduced.packing)
               ? cover_equal(reduced.diagram, intervals, blocks, progress)
               : cover_unequal(reduced.packing, reduced.diagram, intervals, tolerance, blocks, progress);
}

}  // namespace coagula::characterize
