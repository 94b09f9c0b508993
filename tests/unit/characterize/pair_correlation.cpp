// SPDX-License-Identifier: GPL-3.0-or-later
// g(r) and S(q) against brute force, lattices and the ideal gas.
#include <coagula/characterize/pair_correlation.hpp>
#include <coagula/characterize/structure_factor.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

namespace coagula::characterize {
namespace {

using std::numbers::pi;

/// Neighbours nearer than `reach`, in units of r_i + r_j or of the mean diameter, by comparing all pairs.
double count_brutally(const Packing& packing, double reach, bool by_contact) {
    double pairs = 0;
    for (Index i = 0; i < packing.size(); ++i) {
        for (Index j = i + 1; j < packing.size(); ++j) {
            const double unit = by_contact ? packing.radii[i] + packing.radii[j] : 2 * mean_radius(packing);
            const Eigen::Vector3d separation = packing.positions.col(j) - packing.positions.col(i);
            pairs += packing.cell.minimum_image(separation).norm() < reach * unit ? 1 : 0;
        }
    }
    return 2 * pairs / static_cast<double>(packing.size());
}

TEST(PairCorrelation, NeighboursAreThoseOfAllPairs) {
    const Packing packing = test::random_spheres(400, {5, 6, 7}, 0.2, 0.5, 3);
    const PairCorrelation found = measure_pair_correlation(packing);
    const double diameter = 2 * mean_radius(packing);
    for (const Index bin : {3, 10, 20, 30}) {
        const double upper = found.by_distance.upper[bin];
        EXPECT_NEAR(found.by_distance.neighbours[bin], count_brutally(packing, upper / diameter, false), 1e-9) << upper;
    }
    for (const Index bin : {3, 10, 20, 30}) {
        const double upper = found.by_contact.upper[bin];
        EXPECT_NEAR(found.by_contact.neighbours[bin], count_brutally(packing, upper, true), 1e-9) << upper;
    }
    EXPECT_EQ(found.centres, 400);
}

TEST(PairCorrelation, CountsTheShellsOfFcc) {
    const Packing packing = test::face_centred({5, 6, 5}, 0.25e-6);
    const PairCorrelation found = measure_pair_correlation(packing);
    EXPECT_NEAR(found.contact_peak, 12, 1e-9);
    const RadialDistribution& g = found.by_contact;
    const auto neighbours_below = [&](double x) {
        Index bin = 0;
        while (g.upper[bin] < x) {
            ++bin;
        }
        return g.neighbours[bin];
    };
    EXPECT_NEAR(neighbours_below(1.2), 12, 1e-9);
    EXPECT_NEAR(neighbours_below(1.55), 18, 1e-9);
    EXPECT_NEAR(neighbours_below(1.85), 42, 1e-9);
    EXPECT_NEAR(g.lower[g.contact_bin], 0.99, 1e-12);
    EXPECT_NEAR(g.upper[g.contact_bin], 1.01, 1e-12);
    EXPECT_GT(g.g[g.contact_bin], 20);
    EXPECT_EQ(g.g[g.contact_bin + 1], 0);
}

/// Mean square of (g - 1) over its standard error.
double misfit(const RadialDistribution& g, Index first) {
    const Index bins = g.g.size() - first;
    return ((g.g.tail(bins).array() - 1) / g.g_stderr.tail(bins).array()).square().mean();
}

TEST(PairCorrelation, OfAnIdealGasIsOneWithinItsErrors) {
    Packing packing = test::random_spheres(6000, {10, 11, 12}, 0.3, 0.6, 4);
    const PairCorrelation periodic = measure_pair_correlation(packing);
    EXPECT_NEAR(misfit(periodic.by_distance, 5), 1, 0.4);
    EXPECT_NEAR(misfit(periodic.by_contact, 5), 1, 0.4);
    EXPECT_NEAR(periodic.contact_value, 1, 4 * periodic.contact_value_stderr);
    packing.cell = Cell::open({0, 0, 0}, packing.cell.lengths());
    const PairCorrelation open = measure_pair_correlation(packing);
    EXPECT_NEAR(misfit(open.by_distance, 5), 1, 0.6);
    EXPECT_LT((open.by_distance.g.tail(10).array() - 1).abs().maxCoeff(), 0.05);
    EXPECT_NEAR(open.number_density / (6000 / 1320.0), 1, 0.03);
}

TEST(PairCorrelation, OfAnOpenPackingIsTheSameWhateverTheMemoryLooksLike) {
    Packing packing = test::random_spheres(800, {8, 9, 10}, 0.3, 0.5, 12);
    packing.cell = Cell::open({0, 0, 0}, packing.cell.lengths());
    const PairCorrelation first = measure_pair_correlation(packing);
    test::ScatteredMemory memory;
    for (int k = 0; k < 12; ++k) {
        memory.scatter();
        const PairCorrelation again = measure_pair_correlation(packing);
        EXPECT_EQ(again.by_distance.g, first.by_distance.g);
        EXPECT_EQ(again.by_distance.g_stderr, first.by_distance.g_stderr);
        EXPECT_EQ(again.contact_peak, first.contact_peak);
        EXPECT_EQ(again.contact_peak_stderr, first.contact_peak_stderr);
        EXPECT_EQ(again.number_density, first.number_density);
    }
}

TEST(PairCorrelation, RefusesMoreThanHalfTheBox) {
    const Packing packing = test::simple_cubic({4, 5, 6}, 1);
    EXPECT_NO_THROW(measure_pair_correlation(packing, {.range = 4}));
    EXPECT_THROW(measure_pair_correlation(packing, {.range = 4.01}), std::invalid_argument);
    EXPECT_THROW(measure_pair_correlation(packing, {.bin_width = 0}), std::invalid_argument);
    Packing four = test::simple_cubic({1, 2, 2}, 1);
    four.cell = Cell::open({0, 0, 0}, {4, 4, 4});
    EXPECT_THROW(measure_pair_correlation(four), std::invalid_argument);
}

TEST(StructureFactor, IsTheSumOverParticles) {
    // In a box that short only the vectors of one shell fall below the limit: 2 pi / 4 along each axis.
    const Packing packing = test::random_spheres(50, {4, 4, 4}, 0.5, 0.5, 5);
    const StructureFactor found = measure_structure_factor(packing, {.largest = 1.49 * 2 * pi / 4});
    ASSERT_EQ(found.direct.size(), 1);
    double sum = 0;
    int vectors = 0;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                const Eigen::Vector3d q = 2 * pi / 4 * Eigen::Vector3d(x, y, z);
                if (q.norm() > 0 && q.norm() < 1.5 * 2 * pi / 4) {
                    std::complex<double> amplitude = 0;
                    for (Index i = 0; i < packing.size(); ++i) {
                        amplitude += std::polar(1.0, q.dot(packing.positions.col(i)));
                    }
                    sum += std::norm(amplitude) / 50;
                    ++vectors;
                }
            }
        }
    }
    EXPECT_EQ(vectors, 2 * found.vectors[0]);
    EXPECT_NEAR(found.direct[0], sum / vectors, 1e-10);
    EXPECT_TRUE(std::isnan(found.peak_wave_number_stderr)) << "one shell alone";
}

TEST(StructureFactor, VanishesBetweenTheBraggPeaks) {
    const Packing packing = test::face_centred({4, 4, 4}, 0.5);
    // Below (1 1 1) of the cubic cell of edge sqrt(2) nothing is reflected; there it is |q| = sqrt(3) 2 pi / sqrt(2) = 7.695.
    const StructureFactor found = measure_structure_factor(packing, {.largest = 9, .vectors = 100000});
    for (Index k = 0; k < found.direct.size(); ++k) {
        if (found.wave_number[k] < 7) {
            EXPECT_NEAR(found.direct[k], 0, 1e-9);
        }
    }
    EXPECT_NEAR(found.peak_wave_number, 7.695, 0.3);
}

TEST(StructureFactor, BothWaysAgreeForTheIdealGas) {
    Packing packing = test::random_spheres(4000, {10, 10, 10}, 0.5, 0.5, 6);
    for (const bool open : {false, true}) {
        const StructureFactor found = measure_structure_factor(packing, {.largest = 12});
        // Both see the same particles: their difference is at most what independent errors would make it, chi-square over its
        // number.
        const Eigen::ArrayXd error = (found.direct_stderr.array().square() + found.transformed_error.array().square()).sqrt();
        const double most = 1 + 3 * std::sqrt(2 / static_cast<double>(error.size()));
        EXPECT_LT(((found.direct - found.transformed).array() / error).square().mean(), most) << open << error.size();
        EXPECT_NEAR(((found.transformed.array() - 1) / found.transformed_error.array()).square().mean(), 1, 0.8) << open;
        EXPECT_NEAR(found.direct.mean(), 1, 0.1) << open;
        EXPECT_NEAR(found.at_zero, 1, 4 * found.at_zero_stderr) << open;
        packing.cell = Cell::open({0, 0, 0}, packing.cell.lengths());
    }
}

}  // namespace
}  // namespace coagula::characterize
