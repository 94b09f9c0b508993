// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/pair_correlation.hpp>

#include "geometry/reduced_diagram.hpp"
#include "pair_histogram.hpp"
#include "sample/averaged_particles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace coagula::characterize {

namespace {

constexpr double fine_width = 0.002;  ///< in units of the contact distance; all edges are multiples of it

Index fine_bins(double length) {
    return static_cast<Index>(std::lround(length / fine_width));
}

/// Edges in fine bins: equally wide bins on both sides of the one that holds the contacts.
std::vector<Index> bin_edges(Index bins, const PairCorrelationOptions& options, Index& contact_bin) {
    const Index width = fine_bins(options.bin_width);
    const Index low = std::min(bins, fine_bins(1) - fine_bins(options.contact_tolerance));
    const Index high = std::min(bins, fine_bins(1) + fine_bins(options.contact_tolerance));
    std::vector<Index> edges;
    if (low % width != 0) {
        edges.push_back(0);
    }
    for (Index edge = low % width; edge <= low; edge += width) {
        edges.push_back(edge);
    }
    contact_bin = static_cast<Index>(edges.size()) - 1;
    for (Index edge = high; edge <= bins && edge > low; edge += width) {
        edges.push_back(edge);
    }
    return edges;
}

RadialDistribution in_bins(const PairHistogram& histogram, const PairCorrelationOptions& options, double unit) {
    RadialDistribution result;
    const std::vector<Index> edges = bin_edges(histogram.pairs.rows(), options, result.contact_bin);
    const auto bins = static_cast<Index>(edges.size()) - 1;
    result.lower.resize(bins);
    result.upper.resize(bins);
    result.g.resize(bins);
    result.g_stderr.resize(bins);
    result.neighbours.resize(bins);
    double neighbours = 0;
    for (Index bin = 0; bin < bins; ++bin) {
        const Index first = edges[static_cast<std::size_t>(bin)];
        const Index count = edges[static_cast<std::size_t>(bin) + 1] - first;
        const Eigen::VectorXd pairs = histogram.pairs.middleRows(first, count).colwise().sum();
        const Eigen::VectorXd expected = histogram.expected.middleRows(first, count).colwise().sum();
        for (Index fine = first; fine < first + count; ++fine) {
            neighbours += histogram.pairs.row(fine).sum() / std::max(1.0, histogram.centres[fine]);
        }
        result.lower[bin] = unit * histogram.width * static_cast<double>(first);
        result.upper[bin] = unit * histogram.width * static_cast<double>(first + count);
        result.g[bin] = expected.sum() > 0 ? pairs.sum() / expected.sum() : 0.0;
        result.g_stderr[bin] = ratio_stderr(pairs, expected);
        result.neighbours[bin] = neighbours;
    }
    return result;
}

void add_contact_peak(const PairHistogram& histogram, const PairCorrelationOptions& options, PairCorrelation& result) {
    const Index low = fine_bins(1 - options.contact_tolerance);
    const Index count = 2 * fine_bins(options.contact_tolerance);
    if (low + count > histogram.pairs.rows() || histogram.centres[low + count - 1] == 0) {
        return;
    }
    const Eigen::VectorXd pairs = histogram.pairs.middleRows(low, count).colwise().sum();
    const Eigen::VectorXd expected = histogram.expected.middleRows(low, count).colwise().sum();
    const double per_expected = expected.sum() / histogram.centres[low + count - 1];
    result.contact_peak = pairs.sum() / expected.sum() * per_expected;
    result.contact_peak_stderr = ratio_stderr(pairs, expected) * per_expected;
}

/// Weighted parabola through g from the contact bin outward; each pair has been counted for both of its ends.
void add_contact_value(const PairHistogram& histogram, const PairCorrelationOptions& options, PairCorrelation& result) {
    constexpr double fitted = 0.25;
    const Index first = fine_bins(1 + options.contact_tolerance);
    const Index last = fine_bins(1 + fitted);
    if (last > histogram.pairs.rows()) {
        return;
    }
    const Eigen::VectorXd pairs = histogram.pairs.middleRows(first, last - first).rowwise().sum();
    const Eigen::VectorXd expected = histogram.expected.middleRows(first, last - first).rowwise().sum();
    if (pairs.sum() < 2 * 30 || expected.minCoeff() <= 0) {  // fewer than 30 pairs say nothing about a slope
        return;
    }
    Eigen::VectorXd model = Eigen::VectorXd::Constant(pairs.size(), pairs.sum() / expected.sum());
    Eigen::Matrix3d normal;
    Eigen::Vector3d coefficients;
    for (int pass = 0; pass < 3; ++pass) {  // the variance of a count is that of the model
        normal.setZero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        for (Index k = 0; k < pairs.size(); ++k) {
            const double x = (static_cast<double>(first + k) + 0.5) * fine_width - 1;
            const Eigen::Vector3d powers(1, x, x * x);
            const double weight = expected[k] / (2 * model[k]);
            normal += weight * powers * powers.transpose();
            right += weight * (pairs[k] / expected[k]) * powers;
        }
        coefficients = normal.ldlt().solve(right);
        for (Index k = 0; k < pairs.size(); ++k) {
            const double x = (static_cast<double>(first + k) + 0.5) * fine_width - 1;
            const double fit = coefficients[0] + x * (coefficients[1] + x * coefficients[2]);
            model[k] = std::max(fit, 0.1 * pairs.sum() / expected.sum());
        }
    }
    const double misfit =
        (expected.array() / (2 * model.array()) * (pairs.array() / expected.array() - model.array()).square()).sum();
    constexpr double good = 1.5;  // of chi^2 per degree of freedom
    if (coefficients[0] <= 0 || misfit > good * static_cast<double>(pairs.size() - 3)) {
        return;
    }
    result.contact_value = coefficients[0];
    result.contact_value_stderr = std::sqrt(normal.inverse()(0, 0));
}

double checked_range(const Packing& packing, const SampleWindow& window, double range) {
    constexpr double default_range = 12;
    const double largest = largest_pair_distance(packing, window);
    if (std::isnan(range)) {
        return std::min(largest, default_range);
    }
    require_positive(range, "the range of the pair correlation", "m");
    require(range <= largest * (1 + 1e-12), "the range of the pair correlation is " + to_text(range) +
                                                " mean diameters, but the sample allows no more than " + to_text(largest) +
                                                (packing.cell.is_periodic() ? ": half the shortest length of the periodic cell"
                                                                            : ": particles must lie that deep in it"));
    return std::min(range, largest);
}

}  // namespace

PairCorrelation measure_pair_correlation(const Packing& packing, const PairCorrelationOptions& options) {
    check(packing);
    require(options.bin_width >= 0.01 && options.bin_width <= 1,
            "the bins of the pair correlation are " + to_text(options.bin_width) + " wide, but must be 0.01 to 1 mean diameters");
    require(
        options.contact_tolerance >= fine_width && options.contact_tolerance <= 0.1,
        "the contact tolerance of the pair correlation is " + to_text(options.contact_tolerance) + ", but must be 0.002 to 0.1");
    const double diameter = 2 * mean_radius(packing);
    const Packing reduced = in_units_of(diameter, packing);
    const SampleWindow window = sample_window(reduced);
    const auto bins_in = [](double range) { return std::max<Index>(1, static_cast<Index>(range / fine_width)); };
    const double range = checked_range(reduced, window, options.range / diameter);
    require(range >= fine_width, "the packing is too small for a pair correlation: no particle lies deep enough in it");
    const Index bins = bins_in(range);
    const auto count = [&](Index fine, PairDistance distance) {
        return count_pairs(reduced, window, fine_width * static_cast<double>(fine), fine, distance);
    };
    PairHistogram histogram = count(bins, PairDistance::by_mean_diameter);
    PairCorrelation result;
    result.by_distance = in_bins(histogram, options, diameter);
    if (!is_monodisperse(packing)) {
        histogram = count(bins_in(range / (2 * reduced.radii.maxCoeff())), PairDistance::by_contact);
    }
    result.by_contact = in_bins(histogram, options, 1);
    add_contact_peak(histogram, options, result);
    add_contact_value(histogram, options, result);
    result.number_density = window.density / (diameter * diameter * diameter);
    result.centres = static_cast<Index>(histogram.centres[0]);
    return result;
}

}  // namespace coagula::characterize
