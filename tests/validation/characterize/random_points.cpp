// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres at random, which may overlap: every measure that has a closed form there, by the name under which it is written.
#include "unit/characterize/named_results.hpp"
#include "unit/characterize/test_packings.hpp"

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <numbers>

namespace coagula::characterize {
namespace {

using std::numbers::pi;
using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;

constexpr double radius = 0.4;  // particles per volume: 1
constexpr double tolerance = 0.01;

double ball(double r) {
    return 4 * pi / 3 * r * r * r;
}

/// Volume of the union of two balls of radii r and s about points seen under the angle t from a point where their surfaces meet.
double union_volume(double r, double s, double t) {
    const double distance = std::sqrt(r * r + s * s - 2 * r * s * std::cos(t));
    const auto kept = [](double own, double offset) {  // the ball less its cap beyond the plane of the circle
        return pi / 3 * (2 * own * own * own + 3 * own * own * offset - offset * offset * offset);
    };
    const double offset = (distance * distance + r * r - s * s) / (2 * distance);
    return kept(r, offset) + kept(s, distance - offset);
}

/// Variance of the volumes of Voronoi cells of mean 1 (Gilbert, Ann. Math. Stat. 33 (1962) 958): the mean square is the probability
/// density that two points lie in the cell of the origin, over all pairs of points, of which the size is integrated in closed form.
double voronoi_variance() {
    const auto over_shape = [](double t) {
        const auto integrand = [t](double shape) {
            const double c = std::cos(shape), s = std::sin(shape);
            return c * c * s * s / std::pow(union_volume(c, s, t), 2);
        };
        return std::sin(t) * 2 * Quadrature::integrate(integrand, 0, pi / 4, 10, 1e-10);
    };
    return 8 * pi * pi / 3 * Quadrature::integrate(over_shape, 0, pi, 10, 1e-10) - 1;
}

/// int_0^infinity of P(r_P > r) times r^power: P is that of a ball of radius R + r without centres, over that of R.
double pore_integral(int power) {
    const auto integrand = [power](double r) { return std::pow(r, power) * std::exp(ball(radius) - ball(radius + r)); };
    return Quadrature::integrate(integrand, 0, 3, 15, 1e-12);
}

struct Exact {
    std::string name;
    double value;
};

/// Contacts are pairs nearer than `reach`, a random geometric graph: two points within it have 15/32 of their balls in common.
std::vector<Exact> of_contacts() {
    const double contacts = ball(2 * radius * (1 + tolerance));
    const double none = std::exp(-contacts);
    return {{"coordination", contacts},
            {"below_three_fraction", none * (1 + contacts + contacts * contacts / 2)},
            {"topology/contact_spread", std::sqrt(contacts)},
            {"topology/triangles", contacts * contacts * 15 / 32 / 6},
            {"common_neighbours/mean", contacts * 15 / 32},
            {"bond_angles/mean", pi / 2},
            {"bond_angles/below_65_degrees", (1 - std::cos(65 * pi / 180)) / 2},
            {"pair_correlation/contact_peak", contacts - ball(2 * radius * (1 - tolerance))},
            {"pair_correlation/contact_value", 1}};
}

/// Neighbours: Hertz, Math. Ann. 67 (1909) 387. Cells: Meijering, Philips Res. Rep. 8 (1953) 270.
std::vector<Exact> of_points() {
    const double unit = std::cbrt(3 / (4 * pi));
    return {{"neighbour_distances/nearest", unit * std::tgamma(4.0 / 3)},
            {"voronoi/deviation", std::sqrt(voronoi_variance())},
            {"bond_order/facets", 2 + 48 * pi * pi / 35},
            {"structure_factor/at_zero", 1},
            {"density_fluctuations/integral", 2 * (1 / std::sqrt(2.0) - 1 / std::sqrt(10.0)) / std::pow(radius, 1.5)}};
}

/// The union of the spheres: Mecke and Wagner, J. Stat. Phys. 64 (1991) 843; lines meet spheres at the rate pi R^2.
std::vector<Exact> of_the_union() {
    const double s = 4 * pi * radius * radius, m = 4 * pi * radius, empty = std::exp(-ball(radius)), rate = pi * radius * radius;
    return {{"minkowski/undilated/volume_fraction", 1 - empty},
            {"minkowski/undilated/surface", s * empty},
            {"minkowski/undilated/mean_curvature", (m - pi * pi / 32 * s * s) * empty},
            {"minkowski/undilated/euler_characteristic", (1 - m * s / (4 * pi) + pi / 384 * s * s * s) * empty},
            {"pore_size/mean", pore_integral(0) / radius},
            {"pore_size/second_moment", 2 * pore_integral(1) / (radius * radius)},
            {"chord_lengths/void/mean", 1 / rate},
            {"chord_lengths/solid/mean", (1 - empty) / (empty * rate)}};
}

TEST(RandomPoints, HaveTheValuesOfTheClosedForms) {
    const Packing packing = test::random_spheres(8000, {20, 20, 20}, radius, radius, 11);
    const MeasureResult found = run_measures(MeasureInput(packing, {{"contact-tolerance", tolerance}}));
    double squares = 0, count = 0;
    for (const std::vector<Exact>& family : {of_contacts(), of_points(), of_the_union()}) {
        for (const auto& [name, value] : family) {
            const double error = test::scalar(found, "uncertainty/" + name);
            EXPECT_GT(error, 0) << name;
            EXPECT_LT(error, 0.1 * std::abs(value)) << name;
            EXPECT_NEAR(test::scalar(found, name), value, 4 * error) << name;
            squares += std::pow((test::scalar(found, name) - value) / error, 2);
            count += 1;
        }
    }
    EXPECT_GT(squares / count, 0.3) << "the errors are too large";
    EXPECT_LT(squares / count, 2.5) << "the errors are too small";
}

}  // namespace
}  // namespace coagula::characterize
