// SPDX-License-Identifier: GPL-3.0-or-later
// The pores of a hard-sphere fluid at volume fraction 0.4: exclusion probability and nearest distances of Torquato, Lu and
// Rubinstein, Phys. Rev. A 41 (1990) 2059, and mean chords.
#include "hard_sphere_fluid.hpp"

#include <coagula/characterize/chord_lengths.hpp>
#include <coagula/characterize/local_structure.hpp>
#include <coagula/characterize/pore_sizes.hpp>

#include <gtest/gtest.h>
#include <boost/math/quadrature/exp_sinh.hpp>

namespace coagula::characterize {
namespace {

using test::Average;
constexpr double fraction = test::fluid_fraction;

/// -ln of the probability that no centre lies between the distances `from` and x of a point or a centre, in diameters: 24 phi int
/// x^2 G(x) dx with G = a0 + a1 / x + a2 / x^2, G(1/2) = 1 / (1 - phi) and the contact value G(1) and pressure G(infinity) of
/// Carnahan and Starling.
double exponent(double from, double x) {
    const double a0 = 1 + fraction + fraction * fraction - std::pow(fraction, 3);
    const double a1 = (3 * std::pow(fraction, 3) - 4 * fraction * fraction - 3 * fraction) / 2;
    const double a2 = fraction * fraction * (2 - fraction) / 2;
    const double sum = 8 * a0 * (std::pow(x, 3) - std::pow(from, 3)) + 12 * a1 * (x * x - from * from) + 24 * a2 * (x - from);
    return fraction * sum / std::pow(1 - fraction, 3);
}

/// int_0^infinity of exp(-exponent): the mean of a distance beyond `from`.
double mean_beyond(double from) {
    boost::math::quadrature::exp_sinh<double> integrator;
    return integrator.integrate([&](double r) { return std::exp(-exponent(from, from + r)); });
}

TEST(HardSphereFluid, HasThePoresOfTorquatoLuAndRubinstein) {
    test::Fluid fluid;
    fluid.sweep(1500);
    constexpr Index steps = 21;  // of a twentieth of a radius
    std::vector<Average> curve(steps);
    Average mean, nearest, void_chord, solid_chord;
    for (int k = 0; k < 40; ++k) {
        fluid.sweep(40);
        const PoreSizes pores = measure_pores(fluid.packing(), {.radii = 401});
        for (Index step = 0; step < steps; ++step) {
            const double place = static_cast<double>(step) / 40 / pores.radius[1];
            const auto below = std::min<Index>(static_cast<Index>(place), 400);
            const double part = place - static_cast<double>(below);
            const Eigen::VectorXd& p = pores.exclusion_probability;
            curve[static_cast<std::size_t>(step)].add(below < 400 ? (1 - part) * p[below] + part * p[below + 1] : 0.0);
        }
        mean.add(pores.mean);
        nearest.add(measure_neighbour_distances(fluid.packing()).mean[0]);
        const ChordLengths chords = measure_chord_lengths(fluid.packing(), {.lines = 500});
        void_chord.add(chords.voids.mean);
        solid_chord.add(chords.solid.mean);
    }
    // The theory is an approximation: it lies up to 0.003 above the fluid's curve.
    for (std::size_t step = 0; step < curve.size(); ++step) {
        const double expected = std::exp(-exponent(0.5, 0.5 + static_cast<double>(step) / 40));
        EXPECT_NEAR(curve[step].mean(), expected, 4 * curve[step].error() + 0.003) << step;
    }
    EXPECT_NEAR(mean.mean() / mean_beyond(0.5), 1, 0.006);
    EXPECT_NEAR(nearest.mean() / (1 + mean_beyond(1)), 1, 0.001);
    EXPECT_NEAR(void_chord.mean(), 2 * (1 - fraction) / (3 * fraction), 4 * void_chord.error());
    EXPECT_NEAR(solid_chord.mean(), 2.0 / 3, 4 * solid_chord.error());
}

}  // namespace
}  // namespace coagula::characterize
