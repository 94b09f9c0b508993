// SPDX-License-Identifier: GPL-3.0-or-later
// The curve of a large sample from a few structures that yield in steps, drawn from a curve that is known.
#include "responses/population_curve.hpp"

#include "responses/yield_curves.hpp"

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;

const std::vector<double> loads{1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 12, 16, 32};
constexpr double energy_ratio = 1.4;

double last_load(std::size_t node) {
    return node > 0 ? loads[node - 1] : 0.0;
}

/// Part of the modulus that is lost on the way to a node.
double lost_share(std::size_t node) {
    const double middle = 0.5 * (loads[node] + (node > 0 ? loads[node - 1] : 0.5));
    const double width = std::log(loads[node] / (node > 0 ? loads[node - 1] : 0.5));
    return std::min(0.9, width * std::max(0.0, 0.8 * std::log(middle / 1.4)));
}

double stored(std::size_t node, double lost) {
    const double last = last_load(node);
    return lost * (loads[node] * loads[node] + loads[node] * last + last * last) /
           (6 * std::numbers::pi * loads[node] * loads[node]);
}

Eigen::VectorXcd truth() {
    Eigen::VectorXcd curve(static_cast<Index>(loads.size()));
    double left = 1;
    for (std::size_t node = 0; node < loads.size(); ++node) {
        const double lost = left * lost_share(node);
        left -= lost;
        curve[static_cast<Index>(node)] = Complex(left, energy_ratio * stored(node, lost));
    }
    return curve;
}

/// Structures of so many parts, each of which breaks as a whole.
Eigen::MatrixXcd drawn(int structures, std::uint64_t seed) {
    constexpr int parts = 20;
    Eigen::MatrixXcd curves(static_cast<Index>(loads.size()), structures);
    for (int structure = 0; structure < structures; ++structure) {
        std::vector<bool> broken(parts, false);
        for (std::size_t node = 0; node < loads.size(); ++node) {
            int breaking = 0;
            int left = 0;
            for (std::size_t part = 0; part < broken.size(); ++part) {
                const auto number = static_cast<std::uint64_t>(structure) * 10000 + node * 100 + part;
                const bool breaks = !broken[part] && random_uniform(seed, RandomPurpose::test, 6, number)[0] < lost_share(node);
                broken[part] = broken[part] || breaks;
                breaking += breaks ? 1 : 0;
                left += broken[part] ? 0 : 1;
            }
            const double scatter = 1 + 0.3 * drawn_normal(seed, static_cast<std::uint64_t>(structure) * 100 + node, 7);
            const double loss = energy_ratio * scatter * stored(node, static_cast<double>(breaking) / parts);
            curves(static_cast<Index>(node), structure) = Complex(static_cast<double>(left) / parts, loss);
        }
    }
    return curves;
}

/// Estimates depart from the truth as their errors say, and less than the mean of the structures does.
TEST(PopulationCurve, IsWithinItsErrorsOfTheTruth) {
    const Eigen::VectorXcd expected = truth();
    double storage = 0;
    double loss = 0;
    double curve_error = 0;
    double mean_error = 0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Eigen::MatrixXcd structures = drawn(4, seed);
        const Eigen::MatrixXcd found = population_curve(loads, structures);
        ASSERT_TRUE(found.allFinite());
        for (Index node = 2; node < 13; ++node) {
            double real = 0;
            double imaginary = 0;
            for (Index error = 1; error < found.cols(); ++error) {
                real += std::pow((found(node, error) - found(node, 0)).real(), 2);
                imaginary += std::pow((found(node, error) - found(node, 0)).imag(), 2);
            }
            const Complex departure = found(node, 0) - expected[node];
            storage += departure.real() * departure.real() / real;
            loss += departure.imag() * departure.imag() / imaginary;
            curve_error += std::norm(departure);
            mean_error += std::norm(structures.row(node).mean() - expected[node]);
            ++count;
        }
    }
    EXPECT_NEAR(storage / count, 1, 0.35);
    EXPECT_NEAR(loss / count, 1, 0.35);
    EXPECT_LT(curve_error, 0.8 * mean_error);
}

TEST(PopulationCurve, OfEqualStructuresIsTheirs) {
    const Eigen::VectorXcd expected = truth();
    const Eigen::MatrixXcd found = population_curve(loads, expected.replicate(1, 3));
    EXPECT_LT((found.col(0) - expected).cwiseAbs().maxCoeff(), 0.01);
    EXPECT_EQ(population_curve(loads, expected), expected);
}

/// A row loses the energy between its strain and that before, wherever the nodes lie: here 0.01 load^2 in all up to a load.
TEST(YieldCurves, LoseEvenlyBetweenTheirNodes) {
    const auto energy = [](double load) { return 0.01 * load * load; };
    Eigen::RowVectorXcd settled(static_cast<Index>(loads.size()));
    for (std::size_t node = 0; node < loads.size(); ++node) {
        const double load = loads[node];
        settled[static_cast<Index>(node)] =
            Complex(1 - 0.2 * std::log(load), (energy(load) - energy(last_load(node))) / (load * load));
    }
    const YieldCurves curves(loads, settled);
    for (double load = 2.2; load < 12; load += 0.17) {
        const double before = load - 0.15;
        const double lost = (energy(load) - energy(before)) / (load * load);
        EXPECT_NEAR(curves.response(before, load)[0].imag() / lost, 1, 0.04) << load;
        EXPECT_NEAR(curves.response(load, load)[0].real(), 1 - 0.2 * std::log(load), 2e-3) << load;
    }
}

/// Nothing breaks, or everything at once.
TEST(PopulationCurve, HoldsAtTheEnds) {
    const auto nodes = static_cast<Index>(loads.size());
    const Eigen::MatrixXcd whole = population_curve(loads, Eigen::MatrixXcd::Ones(nodes, 3));
    EXPECT_LT((whole.col(0).array() - 1.0).abs().maxCoeff(), 1e-9);
    Eigen::MatrixXcd gone = Eigen::MatrixXcd::Ones(nodes, 3);
    gone.bottomRows(nodes - 4).setZero();
    const Eigen::MatrixXcd found = population_curve(loads, gone);
    EXPECT_TRUE(found.allFinite());
    EXPECT_GE(found.real().col(0).minCoeff(), 0);
}

}  // namespace
}  // namespace coagula::diagnose
