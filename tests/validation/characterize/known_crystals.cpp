// SPDX-License-Identifier: GPL-3.0-or-later
// Crystals of touching spheres: every measure that is exact there, by the name under which it is written.
#include "unit/characterize/named_results.hpp"
#include "unit/characterize/test_packings.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coagula::characterize {
namespace {

using std::numbers::pi;

constexpr double radius = 0.25e-6;

struct KnownCrystal {
    std::string name;
    Packing packing;
    double cell_volume;  ///< of a particle, over radius^3
    std::vector<std::pair<std::string, double>> values;
};

KnownCrystal face_centred() {
    return {"fcc",
            test::face_centred({4, 4, 4}, radius),
            4 * std::sqrt(2.0),
            {{"coordination", 12},
             {"topology/triangles", 8},
             {"topology/tetrahedra", 2},
             {"topology/contacts_outside_triangles", 0},
             {"coordination_percolation/six_or_more/largest_fraction", 1},
             {"dense_clusters/triangles/largest_fraction", 1},
             {"dense_clusters/tetrahedra/mean_size", 4},
             {"common_neighbours/mean", 4},
             {"common_neighbours/fcc", 1},
             {"bond_order/facets", 12},
             {"bond_order/q4", std::sqrt(7.0 / 192)},
             {"bond_order/q6", std::sqrt(169.0 / 512)},
             {"pair_correlation/contact_peak", 12},
             {"bond_angles/below_65_degrees", 24.0 / 66},
             {"bond_angles/mean", (24 * 60 + 12 * 90 + 24 * 120 + 6 * 180) / 66.0 * pi / 180},
             {"pore_size/max", std::sqrt(2.0) - 1}}};
}

KnownCrystal body_centred() {
    const double hexagons = 8 * 3 * std::sqrt(3.0) / 2, squares = 6;
    const double tetrahedral = std::acos(1.0 / 3);
    return {"bcc",
            test::body_centred({5, 5, 5}, radius),
            32 / (3 * std::sqrt(3.0)),
            {{"coordination", 8},
             {"topology/triangles", 0},
             {"topology/tetrahedra", 0},
             {"topology/contacts_outside_triangles", 1},
             {"coordination_percolation/six_or_more/largest_fraction", 1},
             {"dense_clusters/triangles/fraction", 0},
             {"common_neighbours/mean", 0},
             {"common_neighbours/bcc", 1},
             {"bond_order/facets", 14},
             {"bond_order/q4", std::sqrt(7.0 / 12) * (2.0 / 3 * hexagons - squares) / (squares + hexagons)},
             {"bond_order/q6", std::sqrt(1.0 / 8) * (squares + 16.0 / 9 * hexagons) / (squares + hexagons)},
             {"pair_correlation/contact_peak", 8},
             {"bond_angles/below_65_degrees", 0},
             {"bond_angles/mean", (12 * tetrahedral + 12 * (pi - tetrahedral) + 4 * pi) / 28},
             {"pore_size/max", std::sqrt(5.0 / 3) - 1}}};
}

class KnownCrystals : public ::testing::TestWithParam<KnownCrystal (*)()> {};

TEST_P(KnownCrystals, HaveTheValuesOfTheClosedForms) {
    KnownCrystal crystal = GetParam()();
    const double solid = 4 * pi / 3 / crystal.cell_volume;
    const double surface = 4 * pi / crystal.cell_volume / radius;
    crystal.values.insert(crystal.values.end(), {{"pore_space/void_fraction", 1 - solid},
                                                 {"topology/contact_spread", 0},
                                                 {"topology/largest_fraction", 1},
                                                 {"fabric/anisotropy", 0},
                                                 {"voronoi/deviation", 0},
                                                 {"voronoi/width", 0},
                                                 {"neighbour_distances/spread", 0},
                                                 {"minkowski/undilated/volume_fraction", solid}});
    const MeasureResult found = run_measures(MeasureInput(crystal.packing, {{"contact-tolerance", 0.01}}));
    for (const auto& [name, value] : crystal.values) {
        EXPECT_NEAR(test::scalar(found, name), value, 1e-7) << name;
    }
    EXPECT_NEAR(test::scalar(found, "voronoi/mean") / (crystal.cell_volume * std::pow(radius, 3)), 1, 1e-12);
    EXPECT_NEAR(test::scalar(found, "neighbour_distances/nearest") / (2 * radius), 1, 1e-12);
    EXPECT_NEAR(test::scalar(found, "minkowski/undilated/surface") / surface, 1, 1e-9);
    EXPECT_NEAR(test::scalar(found, "chord_lengths/solid/mean") / (4 * radius / 3), 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Cubic, KnownCrystals, ::testing::Values(&face_centred, &body_centred),
                         [](const auto& test) { return test.param().name; });

}  // namespace
}  // namespace coagula::characterize
