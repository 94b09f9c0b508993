// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/depletion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace coagula::generators {

namespace {

constexpr double lengths_per_range = 6;
constexpr int points = 20000;  // of the integrals over a well

/// Gap below the bottom of the well where the energy is so high that no pair of thermal energy comes there.
double closest_gap(const PairPotential& potential, double thermal) {
    constexpr double impassable = 40;
    const double rest = potential.contact().equilibrium_gap;
    const double bottom = potential.energy(rest);
    double below = std::max(rest - potential.cut_gap(), 1e-6 * rest);
    while (potential.energy(rest - below) < bottom + impassable * thermal) {
        below *= 1.25;
    }
    return rest - below;
}

double largest_attraction(const PairPotential& potential, double rest, double farthest) {
    double largest = 0;
    for (int point = 0; point <= points; ++point) {
        largest = std::max(largest, -potential.force(rest + (farthest - rest) * point / points));
    }
    return largest;
}

/// Variance of the gap of a bound pair [m^2], by the midpoint rule.
double gap_variance(const PairPotential& potential, double radius, double thermal, double bond_range) {
    const double low = closest_gap(potential, thermal);
    const double bottom = potential.energy(potential.contact().equilibrium_gap);
    double sum = 0;
    double first = 0;
    double second = 0;
    for (int point = 0; point < points; ++point) {
        const double gap = low + (bond_range - low) * (point + 0.5) / points;
        const double distance = 2 * radius + gap;
        const double weight = distance * distance * std::exp((bottom - potential.energy(gap)) / thermal);
        sum += weight;
        first += weight * gap;
        second += weight * gap * gap;
    }
    const double mean = first / sum;
    return second / sum - mean * mean;
}

}  // namespace

double depletion_depth(double concentration, double size_ratio) {
    require_positive(concentration, "the concentration of the polymer");
    require_positive(size_ratio, "the ratio of the polymer to the particles");
    return concentration * (1 + 3 / (2 * size_ratio));
}

PairPotential depletion_potential(const DepletionAttraction& attraction, std::vector<PairLaw> others) {
    const double length = require_positive(attraction.range, "the range of the attraction", "m") / lengths_per_range;
    const double rest = require_positive(attraction.rest_gap, "the equilibrium gap of the contact", "m");
    others.emplace_back(Morse(attraction.depth, rest, length));
    const double curvature = 2 * attraction.depth / (length * length);
    if (!attraction.contact_stiffness) {
        return {std::move(others), 6 * curvature, rest - std::numbers::ln2 * length, rest + attraction.range};
    }
    const double stiffness = *attraction.contact_stiffness;
    require(stiffness > curvature, "the contact stiffness is " + to_text(stiffness) +
                                       " N/m, softer than the attraction's well of " + to_text(curvature) +
                                       " N/m: take a stiffer contact");
    // The slope of the force is curvature (2 x^2 - x), with x = exp(-(gap - rest)/length).
    const double x = 0.25 * (1 + std::sqrt(1 + 8 * stiffness / curvature));
    return {std::move(others), stiffness, rest - std::log(x) * length, rest + attraction.range};
}

BoundPair bound_pair(const PairPotential& potential, double radius, double temperature, double bond_range) {
    require_positive(radius, "the radius", "m");
    const double thermal = boltzmann_constant * require_positive(temperature, "the temperature", "K");
    require(potential.has_well(), "bonds have the stiffness of a well, but the laws of this potential have none of their own");
    const double rest = potential.contact().equilibrium_gap;
    require(bond_range > rest, "the bond range is " + to_text(bond_range) + " m, but it must be more than the gap of " +
                                   to_text(rest) + " m at which two particles rest");
    const double half = 1e-3 * std::abs(rest - potential.cut_gap());
    const double slope = (potential.force(rest - half) - potential.force(rest + half)) / (2 * half);
    return {.stiffness = slope,
            .thermal_stiffness = thermal / gap_variance(potential, radius, thermal, bond_range),
            .rupture_force = largest_attraction(potential, rest, bond_range)};
}

}  // namespace coagula::generators
