// SPDX-License-Identifier: GPL-3.0-or-later
// The measure of dense clusters is held against crystals and a column of triangles, where all is known.
#include <coagula/characterize/measure.hpp>

#include "named_results.hpp"
#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::characterize {
namespace {

using test::scalar;

/// The clusters of fcc: one of triangles, and tetrahedra that share particles and contacts but no face. A cubic lattice has none.
TEST(DenseClusters, OfFaceCentredCubicAndOfCubes) {
    const Packing packing = test::face_centred({3, 3, 3}, 1);
    const MeasureResult found = run_measures(MeasureInput(packing), {"dense_clusters"});
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/largest_fraction"), 1);
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/mean_size"), packing.size());
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/shared_fraction"), 0);
    EXPECT_EQ(scalar(found, "dense_clusters/tetrahedra/mean_size"), 4);
    EXPECT_EQ(scalar(found, "dense_clusters/tetrahedra/weighted_mean_size"), 4);
    EXPECT_EQ(scalar(found, "dense_clusters/tetrahedra/shared_fraction"), 1);
    EXPECT_EQ(scalar(found, "dense_clusters/tetrahedra/contacts_between"), 0);
    const MeasureResult cubes = run_measures(MeasureInput(test::simple_cubic({4, 4, 4}, 1)), {"dense_clusters"});
    EXPECT_EQ(scalar(cubes, "dense_clusters/triangles/fraction"), 0);
    EXPECT_EQ(scalar(cubes, "dense_clusters/triangles/mean_size"), 0);
    EXPECT_EQ(scalar(cubes, "dense_clusters/triangles/contacts_outside"), 3);
}

/// Regular triangles of touching spheres, one above the other around the box: prisms.
TEST(DenseClusters, OfAColumnOfTriangles) {
    constexpr Index layers = 5;
    const auto height = static_cast<double>(2 * layers);
    Packing packing;
    packing.cell = Cell::periodic({20, 20, height});
    packing.radii = Eigen::VectorXd::Ones(3 * layers);
    packing.positions.resize(3, 3 * layers);
    for (Index layer = 0; layer < layers; ++layer) {
        const auto level = static_cast<double>(2 * layer + 1);
        packing.positions.middleCols(3 * layer, 3) << 5, 7, 6, 5, 5, 5 + std::sqrt(3.0), level, level, level;
    }
    const MeasureResult found = run_measures(MeasureInput(packing), {"dense_clusters"});
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/mean_size"), 3);
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/contacts_between"), 1);
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/contacts_outside"), 0);
    EXPECT_EQ(scalar(found, "dense_clusters/triangles/fraction"), 1);
    EXPECT_DOUBLE_EQ(scalar(found, "dense_clusters/triangles/largest_fraction"), 1.0 / layers);
    EXPECT_EQ(scalar(found, "dense_clusters/tetrahedra/fraction"), 0);
}

}  // namespace
}  // namespace coagula::characterize
