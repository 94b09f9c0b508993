#include <coagula/characterize/pore_sizes.hpp>

#include <coagula/common/parallel.hpp>

#include "coverage.hpp"

#include <boost/math/tools/roots.hpp>

#include <numeric>

namespace coagula::characterize {

namespace {

constexpr const char* stage = "pore sizes";

/// The packing with its lengths divided by `unit`.
Packing in_units_of(double unit, const Packing& packing) {
    const Eigen::Vector3d lengths = packing.cell.lengths() / unit;
    const Eigen::Vector3d origin = packing.cell.origin() / unit;
    const bool periodic = packing.cell.is_periodic();
    return {periodic ? Cell::periodic(lengths) : Cell::open(origin, lengths), packing.positions / unit, packing.radii / unit};
}

/// The diagram of the packing's own radii with the cells to be measured counted: all, or the inner ones of an open packing.
PowerDiagram counted_diagram(const Packing& packing) {
    if (packing.cell.is_periodic()) {
        return periodic_diagram(packing, packing.radii);
    }
    PowerDiagram diagram = open_diagram(packing, packing.radii, std::vector<char>(static_cast<std::size_t>(packing.size()), 1));
    diagram.counted = inner_sites(diagram);
    const auto counted = [&](int site) { return diagram.counted[static_cast<std::size_t>(site)] != 0; };
    std::erase_if(diagram.edges,
                  [&](const DiagramEdge& edge) { return std::none_of(edge.around.begin(), edge.around.end(), counted); });
    require(!diagram.edges.empty(), "the packing is open and has " + std::to_string(packing.size()) +
                                        " particles, but none lies so far inside that its Voronoi cell is certain: pores cannot be "
                                        "measured");
    return diagram;
}

/// The same cells, for spheres whose radii have grown by `growth`.
PowerDiagram grown_diagram(const Packing& packing, const PowerDiagram& original, double growth, double margin) {
    const Eigen::VectorXd radii = packing.radii.array() + growth;
    return packing.cell.is_periodic() ? periodic_diagram(packing, radii, margin) : open_diagram(packing, radii, original.counted);
}

/// Coverage at equally spaced growths of the radii from 0 to the largest pore.
struct CoverageCurve {
    double largest = 0;
    Coverage coverage;
};

double require_void(double largest_power) {
    require(largest_power > 0, "the spheres cover all space: there are no pores to measure");
    return largest_power;
}

CoverageCurve cover_equal(const PowerDiagram& diagram, Index intervals, const Progress& progress) {
    const double radius = diagram.radii[0];
    const double power = require_void(largest_vertex_power(diagram));
    const double largest = power / (std::sqrt(radius * radius + power) + radius);  // of (radius + largest)^2 - radius^2 = power
    const RadialGrid grid{radius, largest / static_cast<double>(intervals), intervals + 1};
    return {largest, cover_equal_spheres(diagram, grid, progress)};
}

/// Growth at which the largest vertex power vanishes: the last pore is closed.
double largest_pore(const Packing& packing, const PowerDiagram& original, double& margin) {
    const double power = require_void(largest_vertex_power(original));
    const auto power_at = [&](double growth) {
        const PowerDiagram diagram = grown_diagram(packing, original, growth, margin);
        margin = std::max(margin, diagram.margin);
        return largest_vertex_power(diagram);
    };
    const double smallest = packing.radii.minCoeff();
    double low = 0;
    double low_power = power;
    double high = power / (std::sqrt(smallest * smallest + power) + smallest);  // no pore can be larger
    double high_power = power_at(high);
    while (high_power > 0) {  // in open packings the cells move with the growth, and the bound is an estimate
        low = high;
        low_power = high_power;
        high *= 1.1;
        high_power = power_at(high);
    }
    std::uintmax_t iterations = 50;
    const auto bracket = boost::math::tools::toms748_solve(power_at, low, high, low_power, high_power,
                                                           boost::math::tools::eps_tolerance<double>(36), iterations);
    return bracket.second;
}

/// How many triangulations may be in memory at once.
std::size_t parallel_diagrams(const PowerDiagram& diagram) {
    constexpr double bytes_per_site = 2500;
    constexpr double memory = 2e9;
    const double fit = memory / (bytes_per_site * static_cast<double>(diagram.positions.cols()));
    return static_cast<std::size_t>(std::clamp(fit, 1.0, 1000.0));
}

CoverageCurve cover_unequal(const Packing& packing, const PowerDiagram& original, Index intervals, const Progress& progress) {
    double margin = original.margin;
    CoverageCurve curve;
    curve.largest = largest_pore(packing, original, margin);
    curve.coverage = {Eigen::VectorXd(intervals + 1), Eigen::VectorXd(intervals + 1)};
    constexpr Index batch = 16;
    for (Index first = 0; first <= intervals; first += batch) {
        const auto cover = [&](std::size_t place) {
            const Index k = first + static_cast<Index>(place);
            const double growth = curve.largest * static_cast<double>(k) / static_cast<double>(intervals);
            const auto [covered, cells] = cover_spheres(grown_diagram(packing, original, growth, margin));
            curve.coverage.covered[k] = covered;
            curve.coverage.cells[k] = cells;
        };
        run_together(static_cast<std::size_t>(std::min(batch, intervals + 1 - first)), cover, parallel_diagrams(original));
        progress.update(stage, static_cast<double>(first) / static_cast<double>(intervals));
    }
    return curve;
}

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

PoreSizes summarize(const CoverageCurve& curve, Index radii, double unit) {
    const Eigen::ArrayXd open = 1 - curve.coverage.covered.array() / curve.coverage.cells.array();
    Eigen::ArrayXd probability = (open / open[0]).max(0.0).min(1.0);
    const Index intervals = probability.size() - 1;
    probability[intervals] = 0;
    const Eigen::ArrayXd radius = unit * Eigen::ArrayXd::LinSpaced(intervals + 1, 0.0, curve.largest);
    const double step = unit * curve.largest / static_cast<double>(intervals);
    const Index stride = intervals / (radii - 1);
    PoreSizes pores;
    pores.radius = radius(Eigen::seqN(0, radii, stride));
    pores.exclusion_probability = probability(Eigen::seqN(0, radii, stride));
    pores.mean = integrate(probability, step);
    pores.second_moment = integrate(2 * radius * probability, step);
    pores.median = find_median(probability, radius);
    pores.max = unit * curve.largest;
    pores.void_fraction = open[0];
    pores.volume = unit * unit * unit * curve.coverage.cells[0];
    return pores;
}

}  // namespace

PoreSizes measure_pores(const Packing& packing, const PoreOptions& options, const Progress& progress) {
    check(packing);
    require(options.radii >= 4, "the pore curve was asked for " + std::to_string(options.radii) + " radii, but needs at least 4");
    progress.update(stage, 0);
    const double unit = mean_radius(packing);
    const Packing reduced = in_units_of(unit, packing);
    const PowerDiagram diagram = counted_diagram(reduced);
    progress.update(stage, 0.3);
    const Index intervals = refinement(options.radii) * (options.radii - 1);
    CoverageCurve curve =
        is_monodisperse(packing) ? cover_equal(diagram, intervals, progress) : cover_unequal(reduced, diagram, intervals, progress);
    double defect = unset;
    if (packing.cell.is_periodic()) {
        const double volume = reduced.cell.volume();
        defect = (curve.coverage.cells.array() / volume - 1).abs().maxCoeff();
        curve.coverage.cells.setConstant(volume);
    }
    PoreSizes pores = summarize(curve, options.radii, unit);
    pores.cell_volume_defect = defect;
    pores.inner_particles = std::count(diagram.counted.begin(), diagram.counted.begin() + packing.size(), char{1});
    return pores;
}

}  // namespace coagula::characterize
