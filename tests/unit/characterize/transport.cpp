// SPDX-License-Identifier: GPL-3.0-or-later
// Chords against the Boolean model; conduction and paths around a lattice of spheres against closed forms.
#include <coagula/characterize/chord_lengths.hpp>
#include <coagula/characterize/minkowski.hpp>
#include <coagula/characterize/transport.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coagula::characterize {
namespace {

using std::numbers::pi;

/// One sphere in the middle of a periodic cube of edge 1.
Packing cubic_array(double fraction) {
    return test::lattice({{.5, .5, .5}}, 1, {1, 1, 1}, std::cbrt(fraction * 3 / (4 * pi)));
}

TEST(ChordLengths, InTheVoidOfAnIdealGasAreExponential) {
    // Spheres are met at the rate n pi R^2 along a line.
    const Packing packing = test::random_spheres(8000, {20, 20, 20}, 0.5, 0.5, 8);
    const ChordLengths found = measure_chord_lengths(packing, {.bins = 40});
    const double rate = pi / 4;
    EXPECT_NEAR(found.voids.mean, 1 / rate, 4 * found.voids.mean_stderr);
    EXPECT_NEAR(found.voids.second_moment, 2 / (rate * rate), 0.05 * 2 / (rate * rate));
    const double width = found.voids.length[1] - found.voids.length[0];
    for (Index k = 0; k < 8; ++k) {
        const double expected =
            (std::exp(-rate * width * static_cast<double>(k)) - std::exp(-rate * width * static_cast<double>(k + 1))) / width;
        EXPECT_NEAR(found.voids.density[k] / expected, 1, 0.1) << k;
    }
    const double empty = std::exp(-pi / 6);
    EXPECT_NEAR(found.void_fraction, empty, 4 * found.void_fraction_stderr);
    EXPECT_NEAR(found.solid.mean, (1 - empty) / (empty * rate), 4 * found.solid.mean_stderr);
}

TEST(ChordLengths, MeanIsFourVolumesOverSurface) {
    const Packing packing = test::random_spheres(500, {7, 7, 7}, 0.3, 0.6, 9);
    const ChordLengths found = measure_chord_lengths(packing, {.lines = 20000});
    const Minkowski exact = measure_minkowski(packing, {.dilations = 2});
    EXPECT_NEAR(found.solid.mean * exact.surface[0] / (4 * exact.volume_fraction[0]), 1, 0.01);
    EXPECT_NEAR(found.voids.mean * exact.surface[0] / (4 * (1 - exact.volume_fraction[0])), 1, 0.02);
    EXPECT_NEAR(found.void_fraction, 1 - exact.volume_fraction[0], 1e-3);
}

TEST(ChordLengths, OfAChainOfSpheresReachThroughTheBox) {
    // Overlapping spheres along x: their axis is all solid, and lines past them are all void.
    Packing packing = test::lattice({{.5, .5, .5}}, 1, {3, 1, 1}, 0.45);
    packing.cell = Cell::periodic({3 * 0.8, 1, 1});
    packing.positions.row(0) *= 0.8;
    const ChordLengths found = measure_chord_lengths(packing);
    EXPECT_GT(found.voids.mean_by_axis[1], found.voids.mean_by_axis[0]);
    EXPECT_NEAR(found.void_fraction, 1 - measure_minkowski(packing, {.dilations = 2}).volume_fraction[0], 2e-3);
    packing.cell = Cell::open({0, 0, 0}, {3, 1, 1});
    EXPECT_THROW(measure_chord_lengths(packing), std::invalid_argument);
}

TEST(Transport, AroundALatticeIsThatOfRayleigh) {
    // Conductivity of a simple cubic array of insulating spheres (McPhedran and McKenzie, Proc. R. Soc. A 359 (1978) 45, in the
    // form of Sangani and Acrivos, Proc. R. Soc. A 386 (1983) 263); Maxwell's to first order.
    for (const double f : {0.05, 0.3}) {
        const double correction = 1.3047 * std::pow(f, 10.0 / 3) / (4.0 / 3 + 0.4054 * std::pow(f, 7.0 / 3));
        const double exact = 1 / (1 - 3 * f / (2 + f - correction - 0.07231 * std::pow(f, 14.0 / 3)));
        const Transport found = measure_transport(cubic_array(f), {.voxels_per_radius = 8});
        EXPECT_NEAR(found.formation_factor.mean, exact, found.formation_factor.grid_error) << f;
        EXPECT_LT(found.formation_factor.grid_error, 0.005 * exact) << f;
        EXPECT_LT(found.formation_factor.axis_stderr, 1e-5 * exact) << f;
    }
}

TEST(Transport, PathsLeadTangentiallyAroundASphere) {
    // Straight to the sphere's equator, along the sphere, and along a tangent to a point in its shadow.
    const double radius = std::cbrt(0.3 * 3 / (4 * pi));
    double extra = 0;
    constexpr int rings = 10000;
    for (int k = 0; k < rings; ++k) {
        const double s = (k + 0.5) / rings * radius;
        const double distance = std::hypot(0.5, s);
        const double arc = pi / 2 - std::atan2(s, 0.5) - std::acos(radius / distance);
        const double path = 0.5 + radius * arc + std::sqrt(distance * distance - radius * radius);
        extra += (path - 1) * 2 * pi * s * radius / rings;
    }
    const Transport found = measure_transport(cubic_array(0.3), {.voxels_per_radius = 16});
    EXPECT_NEAR(found.tortuosity.mean, 1 + extra, found.tortuosity.grid_error);
    EXPECT_LT(found.tortuosity.grid_error, 0.01);
}

TEST(Transport, PoreLengthIsTheSlopeOfTheFormationFactor) {
    Packing packing = cubic_array(0.2);
    const TransportOptions options{.voxels_per_radius = 12};
    const Transport found = measure_transport(packing, options);
    const double step = 0.02 * packing.radii[0];
    packing.radii.array() += step;
    const double larger = measure_transport(packing, options).formation_factor.mean;
    packing.radii.array() -= 2 * step;
    const double smaller = measure_transport(packing, options).formation_factor.mean;
    EXPECT_NEAR(found.pore_length * std::log(larger / smaller) / (4 * step), 1, 0.05);
    EXPECT_NEAR(found.permeability, found.pore_length * found.pore_length / (8 * found.formation_factor.mean), 1e-15);
}

/// On coarse grids the extrapolated values of thin packings came out below what any pores can have.
TEST(Transport, NoPathIsShorterThanTheBoxOnAnyGrid) {
    int bounded = 0;
    for (const double fraction : {0.005, 0.05, 0.2}) {
        for (const double voxels : {1.3, 2.0}) {
            const double radius = std::cbrt(3 * fraction * 1000 / (4 * pi * 30));
            const Packing packing = test::random_spheres(30, Eigen::Vector3d::Constant(10), radius, radius, 1);
            const Transport found = measure_transport(packing, {.voxels_per_radius = voxels, .most_voxels = 2e5});
            EXPECT_GE(found.tortuosity.by_axis.minCoeff(), 1);
            EXPECT_GE(found.formation_factor.by_axis.minCoeff(), 1 / found.void_fraction);
            EXPECT_GE(found.diffusive_tortuosity, 1 - 1e-12);
            EXPECT_GT(found.pore_length, 0);
            if (found.tortuosity.at_bound) {
                EXPECT_GT(found.tortuosity.grid_error, 0);
                ++bounded;
            }
        }
    }
    EXPECT_GT(bounded, 0);
}

TEST(Transport, RefusesWhatItCannotMeasure) {
    Packing packing = cubic_array(0.2);
    EXPECT_THROW(measure_transport(packing, {.voxels_per_radius = 0.5}), std::invalid_argument);
    packing.cell = Cell::open({0, 0, 0}, {1, 1, 1});
    EXPECT_THROW(measure_transport(packing), std::invalid_argument);
    Packing closed = test::simple_cubic({2, 2, 2}, 1);
    closed.radii.setConstant(1.45);  // closes the windows of the cubes and leaves their middles empty
    EXPECT_THROW(measure_transport(closed, {.voxels_per_radius = 8}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::characterize
