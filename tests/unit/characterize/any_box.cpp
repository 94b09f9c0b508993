// SPDX-License-Identifier: GPL-3.0-or-later
// Measures in boxes of other shapes: the same packing by other edge vectors, and packings that are periodic along some edges only.
#include "support/boxes.hpp"
#include "test_packings.hpp"

#include <coagula/characterize/coordination.hpp>
#include <coagula/characterize/density_fluctuations.hpp>
#include <coagula/characterize/free_spheres.hpp>
#include <coagula/characterize/inner_particles.hpp>
#include <coagula/characterize/largest_pores.hpp>
#include <coagula/characterize/measure.hpp>
#include <coagula/characterize/pair_correlation.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/characterize/structure_factor.hpp>
#include <coagula/characterize/voronoi_cells.hpp>

#include <gtest/gtest.h>

namespace coagula::characterize {
namespace {

using coagula::testing::skewed;
using coagula::testing::with_other_edges;
using coagula::testing::with_periodicity;

void expect_near(const Eigen::VectorXd& found, const Eigen::VectorXd& expected, double tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), tolerance * std::max(1e-300, expected.cwiseAbs().maxCoeff()));
}

void expect_same_measures(const Packing& one, const Packing& other) {
    expect_near(measure_voronoi_cells(one).volumes, measure_voronoi_cells(other).volumes, 1e-10);
    const PoreSizes pores = measure_pores(one, {.radii = 60});
    const PoreSizes expected = measure_pores(other, {.radii = 60});
    EXPECT_NEAR(pores.mean, expected.mean, 1e-9 * expected.mean);
    EXPECT_NEAR(pores.max, expected.max, 1e-9 * expected.max);
    expect_near(pores.exclusion_probability, expected.exclusion_probability, 1e-9);
    EXPECT_EQ(measure_coordination(one, {}).mean, measure_coordination(other, {}).mean);
    const PairCorrelation pairs = measure_pair_correlation(one, {});
    const PairCorrelation expected_pairs = measure_pair_correlation(other, {});
    expect_near(pairs.by_distance.g, expected_pairs.by_distance.g, 1e-9);
    const LargestPores largest = find_largest_pores(one, {.count = 5});
    expect_near(largest.radii, find_largest_pores(other, {.count = 5}).radii, 1e-9);
}

TEST(AnyBox, OtherEdgesOfTheSameLatticeChangeNothing) {
    for (const bool unequal : {false, true}) {
        const Packing packing = test::random_spheres(300, {6, 7, 8}, unequal ? 0.2 : 0.4, 0.4, 3);
        const Packing tilted = skewed(packing);
        EXPECT_FALSE(tilted.cell.is_rectangular());
        expect_same_measures(tilted, packing);
        const FreeSpheres free = measure_free_spheres(tilted);
        EXPECT_NEAR(free.free, measure_free_spheres(packing).free, 1e-9);
        EXPECT_NEAR(free.included, measure_free_spheres(packing).included, 1e-9);
    }
}

TEST(AnyBox, DensityFluctuatesAlike) {
    const Packing packing = test::random_spheres(2000, {16, 17, 18}, 0.4, 0.4, 3);  // by another grid of windows
    const DensityFluctuations expected = measure_density_fluctuations(packing, {}, largest_window);
    const DensityFluctuations found = measure_density_fluctuations(skewed(packing), {}, largest_window);
    for (Index k = 0; k < std::min(found.edge.size(), expected.edge.size()); ++k) {
        const double ideal = std::pow(expected.edge[k] / found.edge[k], 1.5);
        EXPECT_NEAR(found.deviation[k] / expected.deviation[k], ideal, 0.03) << found.edge[k];
    }
}

TEST(AnyBox, ScatteringIsThatOfTheLattice) {
    const Packing packing = test::random_spheres(300, {6, 7, 8}, 0.4, 0.4, 3);
    const StructureFactor found = measure_structure_factor(skewed(packing), {.vectors = 100000});
    const StructureFactor expected = measure_structure_factor(packing, {.vectors = 100000});
    expect_near(found.wave_number, expected.wave_number, 1e-9);
    expect_near(found.direct, expected.direct, 1e-7);
    expect_near(found.vectors.cast<double>(), expected.vectors.cast<double>(), 1e-9);
}

TEST(AnyBox, OneSphereMakesAFaceCentredCrystal) {
    const double side = std::sqrt(2.0);  // half the edge of the cube, for unit spheres
    Packing primitive;
    primitive.cell = Cell::of_edges(Eigen::Vector3d::Zero(), side * (Eigen::Matrix3d() << 0, 1, 1, 1, 0, 1, 1, 1, 0).finished(),
                                    {true, true, true});
    primitive.positions = Eigen::Vector3d(0.1, 0.2, 0.3);
    primitive.radii = Eigen::VectorXd::Ones(1);
    EXPECT_NEAR(volume_fraction(primitive), std::numbers::pi / std::sqrt(18.0), 1e-14);
    EXPECT_NEAR(measure_coordination(primitive, {.contact_tolerance = 1e-9}).mean, 12, 1e-12);
    const PoreSizes pores = measure_pores(primitive, {.radii = 60});
    const PoreSizes expected = measure_pores(test::face_centred({2, 2, 2}, 1), {.radii = 60});
    EXPECT_NEAR(pores.max, std::sqrt(2.0) - 1, 1e-12);  // in the octahedral hole
    EXPECT_NEAR(pores.mean, expected.mean, 1e-9);
    expect_near(pores.exclusion_probability, expected.exclusion_probability, 1e-9);
}

/// Their cells are those that they have in the packing without a free surface.
void expect_certain_cells(const Packing& whole, const std::array<bool, 3>& periodic, Index fewest) {
    const Packing packing = with_periodicity(whole, periodic);
    const Eigen::VectorXd volumes = measure_voronoi_cells(packing).volumes;
    const Eigen::VectorXd expected = measure_voronoi_cells(whole).volumes;
    const std::vector<bool> inner = inner_particles(packing);
    Index count = 0;
    for (Index i = 0; i < whole.size(); ++i) {
        if (inner[static_cast<std::size_t>(i)]) {
            ++count;
            EXPECT_NEAR(volumes[i], expected[i], 1e-10) << "particle " << i;
        }
    }
    EXPECT_GE(count, fewest);
    EXPECT_LT(count, whole.size());
}

TEST(AnyBox, CellsBelowAFreeSurfaceAreCertain) {
    const Packing packing = test::random_spheres(1000, {10, 10, 10}, 0.3, 0.3, 4);
    const Packing tilted = with_other_edges(packing, (Eigen::Matrix3d() << 1, 0, 1, 0, 1, 0, 0, 0, 1).finished());
    for (const Packing& whole : {packing, tilted}) {
        expect_certain_cells(whole, {true, true, false}, 500);
        expect_certain_cells(whole, {false, true, true}, 200);
        expect_certain_cells(whole, {false, true, false}, 100);
        expect_certain_cells(whole, {false, false, false}, 50);
    }
}

TEST(AnyBox, ALayerIsTheSameByOtherEdges) {
    const Packing layer = with_periodicity(test::random_spheres(400, {7, 8, 9}, 0.3, 0.3, 6), {true, true, false});
    const Eigen::Matrix3d other = (Eigen::Matrix3d() << 1, 2, 0, 0, 1, 0, 0, 0, 1).finished();
    expect_same_measures(with_other_edges(layer, other), layer);
    // The open edge may lean: its images do not exist.
    Packing leaning = layer;
    leaning.cell =
        Cell::of_edges(layer.cell.origin(), layer.cell.edges() * (Eigen::Matrix3d() << 1, 0, .4, 0, 1, .3, 0, 0, 1).finished(),
                       layer.cell.periodicity());
    for (auto position : leaning.positions.colwise()) {
        position = leaning.cell.wrap(position);
    }
    expect_same_measures(leaning, layer);
}

TEST(AnyBox, EveryMeasureRunsOrSaysWhyNot) {
    const Packing packing = test::random_spheres(400, {7, 8, 9}, 0.4, 0.4, 8);
    for (const std::array<bool, 3>& periodic : {std::array{true, true, true}, {true, true, false}, {false, true, false}}) {
        const Packing tilted = with_periodicity(skewed(packing), periodic);
        const MeasureResult found = run_measures(MeasureInput(tilted), {});
        EXPECT_FALSE(found.datasets.empty());
    }
}

}  // namespace
}  // namespace coagula::characterize
