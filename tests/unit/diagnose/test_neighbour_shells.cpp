// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the neighbours that an image shows, where particles lie closer in some places than in others: single particles and
// triangles of touching ones, at random on a lattice. Each triangle has one side near the plane and two near z, whatever axis z is.
#include "observables/neighbour_shells.hpp"
#include "responses/imaged_centres.hpp"

#include "remade_structures.hpp"

#include "chain/forward.hpp"

#include <coagula/common/random.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

namespace coagula::diagnose {
namespace {

constexpr std::uint64_t sites_along = 8;
constexpr double spacing = 3.5;  // diameters: the next site is beyond the reach of the shells
constexpr double triangles = 0.1;
constexpr double in_triangles = 3 * triangles / (1 + 2 * triangles);  // share of the particles
constexpr Index contact = 4;                                          // the shell about a distance of one diameter
constexpr Index contact_along_axis = shells_of_direction + contact;

Packing singles_and_triangles(std::uint64_t seed) {
    std::vector<Eigen::Vector3d> positions;
    for (std::uint64_t site = 0; site < sites_along * sites_along * sites_along; ++site) {
        const std::uint64_t row = site / sites_along;
        const std::uint64_t layer = row / sites_along;
        const Eigen::Vector3d place = spacing * Eigen::Vector3d(static_cast<double>(site % sites_along),
                                                                static_cast<double>(row % sites_along), static_cast<double>(layer));
        positions.push_back(place);
        if (random_uniform(seed, RandomPurpose::diagnosis, 0, site)[0] < triangles) {
            positions.emplace_back(place + Eigen::Vector3d(1, -1, 0).normalized());
            positions.emplace_back(place + Eigen::Vector3d(1, 0, -1).normalized());
        }
    }
    const auto count = static_cast<Index>(positions.size());
    Packing packing{.cell = Cell::periodic(Eigen::Vector3d::Constant(spacing * static_cast<double>(sites_along))),
                    .positions = Eigen::Matrix3Xd(3, count),
                    .radii = Eigen::VectorXd::Constant(count, 0.5)};
    for (Index particle = 0; particle < count; ++particle) {
        packing.positions.col(particle) = positions[static_cast<std::size_t>(particle)];
    }
    return packing;
}

double variance(const std::vector<double>& values) {
    const Eigen::Map<const Eigen::ArrayXd> all(values.data(), static_cast<Index>(values.size()));
    return (all - all.mean()).square().sum() / static_cast<double>(all.size() - 1);
}

/// Variance of the neighbours in contact in both directions together.
double variance_in_contact(const Eigen::MatrixXd& errors) {
    return (errors.row(contact) + errors.row(contact_along_axis)).squaredNorm();
}

double share_in_triangles(const Packing& packing) {
    constexpr auto sites = static_cast<double>(sites_along * sites_along * sites_along);
    const auto particles = static_cast<double>(packing.size());
    return 1.5 * (particles - sites) / particles;
}

TEST(NeighbourShells, OfStructuresVaryWithAllThatAreNear) {
    const Packing packing = singles_and_triangles(1);
    const double p = share_in_triangles(packing);
    const Eigen::MatrixXd errors = errors_of_structures(spread_of_neighbours(packing), 1);
    // Two neighbours or none; in a triangle the other two have as many.
    EXPECT_NEAR(variance_in_contact(errors), 4 * p * (1 - p) + 8 * p * (1 - p) * (1 - p), 1e-9);
    // Near the plane two particles of a triangle have one neighbour, the third has none.
    const double q = 2 * p / 3;
    EXPECT_NEAR(errors.row(contact).squaredNorm(), q * (1 - q) + 2 * p / 3 * (1 - q) * (1 - 3 * q), 1e-9);
    EXPECT_EQ(errors.row(contact + 1).squaredNorm(), 0);  // an empty shell
}

TEST(NeighbourShells, OfAnImageHaveTheErrorsOfIndependentPairsAndThoseOfDensity) {
    const Packing packing = singles_and_triangles(1);
    const double p = share_in_triangles(packing);
    const double mutual = 0.8;
    const Eigen::MatrixXd errors = errors_of_density(spread_of_neighbours(packing), 100, mutual);
    const double independent = (1 + mutual) * 2 * p;
    const double all = 4 * p * (1 - p) + mutual * 8 * p * (1 - p) * (1 - p);
    ASSERT_GT(all, 1.3 * independent);
    // In directions in which the triangles scatter less than independent pairs nothing is above these.
    EXPECT_NEAR(variance_in_contact(errors) / ((all - independent) / 100), 1, 0.1);
}

TEST(NeighbourShells, OfIndependentPairsHaveNoErrorsOfDensity) {
    // Each has as many neighbours as a pair that is counted from one end, or from both, makes it have.
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(shell_count, 1 + 2 * shell_count);
    spread.col(0).setConstant(2);
    spread.middleCols<shell_count>(1).diagonal().setConstant(2);
    spread.rightCols<shell_count>().diagonal().setConstant(2);
    const std::vector<double> flat(spread.reshaped().begin(), spread.reshaped().end());
    for (const double mutual : {0.0, 0.5, 1.0}) {
        EXPECT_LT(errors_of_density(flat, 1, mutual).norm(), 1e-6) << mutual;
    }
}

/// Along z, where both sides of a triangle lie, and in both directions together.
TEST(NeighbourShells, ScatterFromImageToImageAsStated) {
    const std::vector<double> spread = spread_of_neighbours(singles_and_triangles(1000));
    for (const std::vector<Index>& shells : {std::vector<Index>{contact_along_axis}, {contact, contact_along_axis}}) {
        std::vector<double> seen;
        double stated = 0;
        double independent = 0;
        constexpr std::uint64_t images = 400;
        for (std::uint64_t image = 0; image < images; ++image) {
            const NeighbourShells found = shells_of_points(singles_and_triangles(image).positions, 1);
            const auto centres = static_cast<double>(found.centres);
            const auto sum = [&](const std::vector<double>& values) {
                return Eigen::Map<const Eigen::VectorXd>(values.data(), shell_count)(shells).sum();
            };
            const Eigen::MatrixXd errors = errors_of_density(spread, centres, found.mutual);
            const double own = sum(found.variances) / (centres * centres) / images;
            seen.push_back(sum(found.mean));
            independent += own;
            stated += own + errors(shells, Eigen::all).colwise().sum().squaredNorm() / images;
        }
        EXPECT_NEAR(stated / variance(seen), 1, 0.25);  // the spread is that of 600 particles, the variance one of 400 images
        EXPECT_LT(independent / variance(seen), 0.8);
    }
    EXPECT_NEAR(in_triangles, share_in_triangles(singles_and_triangles(1000)), 0.06);
}

/// A pair along each direction.
TEST(NeighbourShells, CountNeighboursNearThePlaneAndAlongTheAxis) {
    constexpr double reach = 3;
    for (const double degrees : {0.0, 25.0, 35.0, 90.0}) {
        const double angle = degrees * std::numbers::pi / 180;
        Eigen::Matrix3Xd positions(3, 10);
        for (Index corner = 0; corner < 8; ++corner) {
            positions.col(corner) =
                reach * Eigen::Vector3d(corner % 2 == 0 ? -1.0 : 1.0, corner / 2 % 2 == 0 ? -1.0 : 1.0, corner < 4 ? -1.0 : 1.0);
        }
        positions.col(8) = Eigen::Vector3d(0, 0, 0);
        positions.col(9) = Eigen::Vector3d(0, std::cos(angle), std::sin(angle));
        const NeighbourShells shells = shells_of_points(positions, 1);
        EXPECT_EQ(shells.mean[contact], degrees < 30 ? 1 : 0) << degrees;
        EXPECT_EQ(shells.mean[contact_along_axis], degrees < 30 ? 0 : 1) << degrees;
    }
}

/// Half of the neighbours of a random structure without errors are near z. Errors along z widen the contacts there.
TEST(NeighbourShells, AlongTheAxisSpreadByItsErrors) {
    const Packing random = structure(500, 79);
    const auto sum = [](const std::vector<double>& shells, std::size_t first) {
        return std::accumulate(shells.begin() + static_cast<std::ptrdiff_t>(first),
                               shells.begin() + static_cast<std::ptrdiff_t>(first + shells_of_direction), 0.0);
    };
    const std::vector<double> sharp = shells_of_structure(random, 0, 0);
    EXPECT_NEAR(sum(sharp, 0) / sum(sharp, shells_of_direction), 1, 0.03);
    const std::vector<double> blurred = shells_of_structure(random, 0.02e-6, 0.08e-6);
    EXPECT_GT(blurred[contact] / sharp[contact], 1.4 * blurred[contact_along_axis] / sharp[contact_along_axis]);
}

TEST(NeighbourShells, OfFewNeighboursAreComparedTogether) {
    std::vector<double> variances(shell_count, 50);
    EXPECT_EQ(groups_of_shells(variances).size(), static_cast<std::size_t>(shell_count));
    variances[0] = 1;
    variances[1] = 12;
    variances[3] = 2;
    variances[14] = 2;  // with the last one of its direction, which
    variances[15] = 3;  // does not go on to the other
    const std::vector<ShellGroup> groups = groups_of_shells(variances);
    ASSERT_EQ(groups.size(), static_cast<std::size_t>(shell_count) - 2);
    EXPECT_EQ(groups[0].count, 2);
    EXPECT_EQ(groups[0].variance, 13);
    EXPECT_EQ(groups[1].first, 2);
    EXPECT_EQ(groups[2].first, 3);  // not with the contact
    EXPECT_EQ(groups[2].count, 1);
    EXPECT_EQ(groups[13].count, 2);
    EXPECT_EQ(groups[14].first, shells_of_direction);
}

TEST(NeighbourShells, OfFewNeighboursHaveTheErrorOfTheUpperLimit) {
    // The means below which so many are found in 15.87 % of the cases: the exact limits lie within 10 %.
    for (const int count : {0, 1, 4, 9}) {
        const double limit = count + error_of_count(count);
        double below = 0;
        double term = std::exp(-limit);
        for (int k = 0; k <= count; ++k) {
            below += term;
            term *= limit / (k + 1);
        }
        EXPECT_NEAR(below, 0.1587, 0.0159) << count;
    }
    EXPECT_EQ(error_of_count(100), 10);
}

TEST(NeighbourShells, OfTwoImagesShareTheErrorsOfTheStructures) {
    const Packing hidden = structure(500, 79);
    const Experiment experiment =
        experiment_of_recipe({seen_by_microscope(hidden, 0, 0, 0, 1), seen_by_microscope(hidden, 0, 0, 0.3, 2)});
    const std::vector<Observation> observations = observations_of(experiment);
    constexpr Index rows = shell_count - 6;  // nothing is nearer than the contact: one row in each direction
    ASSERT_EQ(observations.size(), 2U * rows);
    const Eigen::MatrixXd errors = Forward(experiment, observations, recipe().simulator).prediction(Model{}).errors.changes;
    const Index shared = neighbour_errors_of_structures(recipe().simulator).cols();
    ASSERT_GT(shared, 0);
    EXPECT_EQ(errors.topLeftCorner(rows, shared), errors.bottomLeftCorner(rows, shared));
    // The rest is of one image or of the other.
    ASSERT_GT(errors.cols(), shared + 1);
    for (Index own = shared; own < errors.cols(); ++own) {
        EXPECT_NE(errors.col(own).head(rows).norm() > 0, errors.col(own).tail(rows).norm() > 0) << own;
    }
}

}  // namespace
}  // namespace coagula::diagnose
