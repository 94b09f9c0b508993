// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/size_distribution.hpp>

#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace coagula::generators {

namespace {

constexpr double cutoff_deviations = 3;

double normal_cdf(double x) {
    return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// Quantile of the standard normal distribution: Abramowitz and Stegun 26.2.23, then Newton's method to rounding error.
double normal_quantile(double probability) {
    const double tail = std::min(probability, 1 - probability);
    const double t = std::sqrt(-2 * std::log(tail));
    const double guess = t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    double x = probability < 0.5 ? -guess : guess;
    for (int iteration = 0; iteration < 4; ++iteration) {
        const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
        x -= (normal_cdf(x) - probability) / density;
    }
    return x;
}

/// Particle numbers in an order that depends on the seed alone.
std::vector<Index> shuffled(Index n, std::uint64_t seed) {
    std::vector<std::pair<std::uint64_t, Index>> keys;
    keys.reserve(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
        keys.emplace_back(random_bits(seed, RandomPurpose::radius, 0, static_cast<std::uint64_t>(i))[0], i);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<Index> order;
    order.reserve(keys.size());
    for (const auto& key : keys) {
        order.push_back(key.second);
    }
    return order;
}

/// The medians of n equally probable intervals of the standard normal distribution cut at three deviations, ascending.
Eigen::VectorXd stratified_normal(Index n) {
    const double lowest = normal_cdf(-cutoff_deviations);
    Eigen::VectorXd values(n);
    for (Index i = 0; i < n; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        values[i] = normal_quantile(lowest + (1 - 2 * lowest) * share);
    }
    return values;
}

Eigen::VectorXd continuous(const SizeDistribution& sizes, Index n) {
    const bool is_normal = sizes.kind == SizeKind::normal;
    const double limit = is_normal ? 0.3 : 0.5;
    const double deviation = require_non_negative(sizes.relative_deviation, "the relative standard deviation of the radius");
    require(deviation <= limit, "the relative standard deviation of the radius is " + to_text(deviation) + ", but a " +
                                    (is_normal ? "normal" : "lognormal") + " distribution of sizes allows 0 to " + to_text(limit));
    const Eigen::ArrayXd normal = stratified_normal(n).array();
    const double log_deviation = std::sqrt(std::log1p(deviation * deviation));
    Eigen::VectorXd radii = is_normal ? Eigen::VectorXd(1 + deviation * normal) : Eigen::VectorXd((log_deviation * normal).exp());
    return radii * (sizes.mean_radius / radii.mean());
}

void check_table(const SizeDistribution& sizes) {
    const Index rows = sizes.table_radius.size();
    require(rows > 0 && sizes.table_fraction.size() == rows, "the table of sizes has " + std::to_string(rows) + " radii and " +
                                                                 std::to_string(sizes.table_fraction.size()) +
                                                                 " fractions, but needs at least one and as many of each");
    for (Index row = 0; row < rows; ++row) {
        require_positive(sizes.table_radius[row], "the radius in row " + std::to_string(row + 1) + " of the table of sizes", "m");
        require_positive(sizes.table_fraction[row],
                         "the number fraction in row " + std::to_string(row + 1) + " of the table of sizes");
    }
}

/// Whole numbers of particles by largest remainders.
Eigen::VectorXd from_table(const SizeDistribution& sizes, Index n) {
    check_table(sizes);
    const Eigen::ArrayXd wanted = sizes.table_fraction.array() * (static_cast<double>(n) / sizes.table_fraction.sum());
    std::vector<Index> counts;
    for (const double share : wanted) {
        counts.push_back(static_cast<Index>(share));
    }
    std::vector<std::size_t> rows(counts.size());
    std::iota(rows.begin(), rows.end(), 0);
    const auto remainder = [&](std::size_t row) { return wanted[static_cast<Index>(row)] - static_cast<double>(counts[row]); };
    std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return remainder(a) > remainder(b); });
    const Index missing = n - std::accumulate(counts.begin(), counts.end(), Index{0});
    for (Index extra = 0; extra < missing; ++extra) {
        ++counts[rows[static_cast<std::size_t>(extra) % rows.size()]];
    }
    Eigen::VectorXd radii(n);
    Index next = 0;
    for (std::size_t row = 0; row < counts.size(); ++row) {
        radii.segment(next, counts[row]).setConstant(sizes.table_radius[static_cast<Index>(row)]);
        next += counts[row];
    }
    return radii;
}

}  // namespace

Eigen::VectorXd draw_radii(const SizeDistribution& sizes, Index n, std::uint64_t seed) {
    require(n > 0, "the number of particles is " + std::to_string(n) + ", but must be at least 1");
    if (sizes.kind != SizeKind::table) {
        require_positive(sizes.mean_radius, "the mean particle radius", "m");
    }
    if (sizes.kind == SizeKind::monodisperse) {
        return Eigen::VectorXd::Constant(n, sizes.mean_radius);
    }
    const Eigen::VectorXd ascending = sizes.kind == SizeKind::table ? from_table(sizes, n) : continuous(sizes, n);
    return ascending(shuffled(n, seed));
}

}  // namespace coagula::generators
