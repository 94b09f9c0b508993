// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the distribution of the Voronoi volumes.
#include <coagula/characterize/measure.hpp>
#include <coagula/common/special_functions.hpp>

#include "distribution.hpp"

namespace coagula::characterize {

Measure voronoi_measure();

namespace {

/// Volumes of the certain cells [m^3].
Eigen::VectorXd certain_volumes(const VoronoiCells& cells) {
    std::vector<double> volumes;
    for (std::size_t i = 0; i < cells.certain.size(); ++i) {
        if (cells.certain[i]) {
            volumes.push_back(cells.volumes[static_cast<Index>(i)]);
        }
    }
    return Eigen::Map<const Eigen::VectorXd>(volumes.data(), std::ssize(volumes));
}

/// Standard errors of relative standard deviation, width and shape.
Eigen::VectorXd moment_errors(const MeasureInput& input, double smallest) {
    const Eigen::VectorXd& volumes = input.voronoi_cells().volumes;
    Eigen::MatrixXd values(4, volumes.size());
    values << Eigen::RowVectorXd::Ones(volumes.size()), volumes.transpose(), volumes.array().square().matrix().transpose(),
        volumes.unaryExpr([&](double volume) { return std::log(std::max(volume / smallest - 1, 1e-300)); }).transpose();
    return block_errors(
        sum_by_block(input.blocks(), values),
        [smallest](const Eigen::VectorXd& sum) {
            const double mean = sum[1] / sum[0];
            const double deviation = std::sqrt(std::max(0.0, sum[2] / sum[0] - mean * mean));
            const double minus_mean_log = std::log(mean / smallest - 1) - sum[3] / sum[0];
            return Eigen::VectorXd{{deviation / mean, deviation / (mean - smallest), gamma_shape(minus_mean_log)}};
        },
        [](const Eigen::VectorXd& sum) { return sum[0] / sum[1]; });
}

/// Standard error of the mean volume [m^3]; of a periodic packing it is a fact.
double mean_error(const MeasureInput& input) {
    const Eigen::VectorXd& volumes = input.voronoi_cells().volumes;
    Eigen::MatrixXd values(2, volumes.size());
    values << Eigen::RowVectorXd::Ones(volumes.size()), volumes.transpose();
    const auto mean = [](const Eigen::VectorXd& sum) { return Eigen::VectorXd::Constant(1, sum[1] / sum[0]); };
    return input.packing().cell.is_periodic() ? 0.0 : block_errors(sum_by_block(input.blocks(), values), mean)[0];
}

/// The density of x = free volume over its mean, measured and fitted.
void add_distribution(const Eigen::VectorXd& volumes, const VoronoiDistribution& found, double smallest, MeasureResult& result) {
    constexpr Index bins = 60;
    constexpr double end = 4;
    const Eigen::VectorXd x = (volumes.array() - smallest) / (found.mean - smallest);
    const Eigen::VectorXd middle = middles_of_bins(0, end, bins);
    const double k = found.shape;
    const Eigen::VectorXd fit = middle.unaryExpr([k](double at) { return k * gamma_p_derivative(k, k * at); });
    result.add_vector("voronoi/free_volume", middle, "1", "x = (V - V_min) / (mean V - V_min), middles of the bins");
    result.add_vector("voronoi/density", density_in_bins(x, 0, end, bins), "1", "probability density of x");
    result.add_vector("voronoi/fit", fit, "1", "k^k / Gamma(k) x^(k-1) exp(-k x)");
}

/// Why there is no gamma law.
std::string without_law(const VoronoiDistribution& found) {
    return found.width < narrowest_gamma_law
               ? "none: all cells are alike but for " + with_unit(found.width, "1") + " of their free volume, as in a crystal"
               : "none: some cell is no larger than V_min = 5.55 r^3, the smallest cell of equal spheres that do not overlap";
}

void add_free_volumes(const Eigen::VectorXd& volumes, const VoronoiDistribution& found, const Eigen::VectorXd& error, double radius,
                      MeasureResult& result) {
    const double smallest = smallest_voronoi_volume * radius * radius * radius;
    result.add("voronoi/width", found.width, "1",
               "standard deviation of x = (V - V_min) / (mean V - V_min), V_min = 5.55 r^3 the smallest cell of equal spheres",
               error[1]);
    result.add_line("width of the Voronoi volumes", with_error(found.width, error[1]) + "   (free volume over its mean)");
    if (std::isfinite(found.shape)) {
        result.add("voronoi/shape", found.shape, "1", "k of the gamma law fitted to x by largest likelihood", error[2]);
        result.add("voronoi/distance", found.distance, "1", "largest difference between the distribution of x and the gamma law");
        result.add_line("gamma law of the free volumes",
                        "k = " + with_unit(found.shape, "1") + ", largest difference " + with_unit(found.distance, "1"));
        add_distribution(volumes, found, smallest, result);
    } else {
        result.add_line("gamma law of the free volumes", without_law(found));
    }
}

MeasureResult run_voronoi(const MeasureInput& input) {
    const VoronoiCells& cells = input.voronoi_cells();
    const Eigen::VectorXd volumes = certain_volumes(cells);
    require_applicable(volumes.size() >= 2, "fewer than two particles have a certain Voronoi cell");
    const double r0 = input.r0();
    const VoronoiDistribution found = fit_voronoi_volumes(volumes, r0);
    const bool equal = is_monodisperse(input.packing());
    const Eigen::VectorXd error = moment_errors(input, smallest_voronoi_volume * r0 * r0 * r0);
    MeasureResult result;
    result.add("voronoi/mean", found.mean, "m3", "mean volume of the Voronoi (power) cells", mean_error(input));
    result.add("voronoi/deviation", found.deviation / found.mean, "1", "standard deviation of the volumes over their mean",
               error[0]);
    result.add_count("voronoi/cells", found.cells, "number of cells");
    if (equal && std::isfinite(found.width)) {
        add_free_volumes(volumes, found, error, r0, result);
    } else {
        result.add_line("deviation of the Voronoi volumes",
                        with_error(found.deviation / found.mean, error[0]) + "   of their mean");
    }
    result.add_field("voronoi_volume", cells.volumes.transpose(), "m3",
                     "volume of the Voronoi (power) cell; 0 where it is not certain");
    return result;
}

}  // namespace

Measure voronoi_measure() {
    return {.name = "voronoi", .summary = "distribution of the Voronoi (power) cell volumes: width, gamma law", .run = run_voronoi};
}

}  // namespace coagula::characterize
