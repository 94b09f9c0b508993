// How the simulated modulus depends on the volume fraction, and what layers of different volume fraction in series make of it.
#include "volume_fraction_gradient.hpp"

#include "linear_grid.hpp"

#include <coagula/diagnose/simulator.hpp>

#include <coagula/mechanics/straight_line.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {

namespace {

constexpr double close_packing = 0.64;
constexpr double most_depleted = 0.95;  ///< part of the mean volume fraction that the highest layer may have lost
constexpr double floppy = 1e-6;         ///< modulus over the largest one below which a structure bears nothing

}  // namespace

bool differ_in_volume_fraction(std::span<const double> fractions) {
    constexpr double enough = 1.01;
    const auto [low, high] = std::minmax_element(fractions.begin(), fractions.end());
    return !fractions.empty() && *high > enough * *low;
}

double settled_difference(double volume_fraction, double difference) {
    const double most = 2 * std::min(most_depleted * volume_fraction, close_packing - volume_fraction);
    return std::clamp(difference, 0.0, std::max(most, 0.0));
}

double layers_in_series(double exponent, double relative_difference) {
    if (relative_difference <= 0) {
        return 1;
    }
    // Mean of (1 + s)^-exponent over s from -x to x; ln(1 + x) - ln(1 - x) = 2 artanh(x).
    const double x = 0.5 * relative_difference;
    const double power = 1 - exponent;
    const double range = 2 * std::atanh(x);
    const double integral = power == 0 ? range : std::pow(1 - x, power) * std::expm1(power * range) / power;
    return 2 * x / integral;
}

double Simulator::volume_fraction(std::size_t group) {
    const auto [found, added] = volume_fractions_.try_emplace(group, 0.0);
    if (added) {
        const std::vector<std::size_t> structures = members(group);
        for (const std::size_t k : structures) {
            found->second += coagula::volume_fraction(structures_[k]) / static_cast<double>(structures.size());
        }
    }
    return found->second;
}

/// At one node: slope of the logarithms over the structures that bear a load; 0 where these have one volume fraction only.
double Simulator::exponent_node(double ratio, double bending, double tolerance) {
    const std::array place{ratio, bending, tolerance};
    if (const auto found = exponents_.find(place); found != exponents_.end()) {
        return found->second;
    }
    std::vector<double> moduli;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        moduli.push_back(linear_moduli(k, ratio, bending, tolerance).front());
    }
    const double largest = *std::max_element(moduli.begin(), moduli.end());
    std::vector<double> fractions;
    std::vector<double> borne;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        if (moduli[k] > floppy * largest) {
            fractions.push_back(coagula::volume_fraction(structures_[k]));
            borne.push_back(moduli[k]);
        }
    }
    double slope = 0;
    if (differ_in_volume_fraction(fractions)) {
        const auto logarithms = [](const std::vector<double>& values) -> Eigen::VectorXd {
            return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Index>(values.size())).log();
        };
        slope = mechanics::fit_line(logarithms(fractions), logarithms(borne)).slope;
    }
    return exponents_[place] = slope;
}

double Simulator::volume_fraction_exponent(const Settings& settings, bool exact) {
    if (exact) {
        return exponent_node(settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance);
    }
    // The slope is linear in the logarithms of the moduli, which are what is interpolated.
    return std::log(between_nodes(settings, [&](double ratio, double bending, double tolerance) {
        return std::exp(exponent_node(ratio, bending, tolerance));
    }));
}

}  // namespace coagula::diagnose
