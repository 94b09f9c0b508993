// SPDX-License-Identifier: GPL-3.0-or-later
// How the simulated modulus depends on the volume fraction, and what layers of different volume fraction in series make of it.
#include "volume_fraction_gradient.hpp"

#include "linear_grid.hpp"
#include "linear_modulus.hpp"

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

double mean_volume_fraction(Simulator& simulator, std::size_t group) {
    return simulator.remembered({"volume fraction", group}, [&] {
        const std::vector<std::size_t> structures = simulator.members(group);
        double mean = 0;
        for (const std::size_t k : structures) {
            mean += volume_fraction(simulator.structure(k)) / static_cast<double>(structures.size());
        }
        return mean;
    });
}

namespace {

/// Slope of the logarithms over the structures that bear a load; 0 where these have one volume fraction only.
double exponent_over_structures(Simulator& simulator, const Settings& settings) {
    std::vector<double> moduli;
    for (std::size_t k = 0; k < simulator.structures(); ++k) {
        moduli.push_back(moduli_of_structure(simulator, k, settings).front());
    }
    const double largest = *std::max_element(moduli.begin(), moduli.end());
    std::vector<double> fractions;
    std::vector<double> borne;
    for (std::size_t k = 0; k < simulator.structures(); ++k) {
        if (moduli[k] > floppy * largest) {
            fractions.push_back(volume_fraction(simulator.structure(k)));
            borne.push_back(moduli[k]);
        }
    }
    const auto logarithms = [](const std::vector<double>& values) -> Eigen::VectorXd {
        return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Index>(values.size())).log();
    };
    return differ_in_volume_fraction(fractions) ? mechanics::fit_line(logarithms(fractions), logarithms(borne)).slope : 0.0;
}

double exponent_node(Simulator& simulator, const Settings& settings) {
    const ResultKey key{
        "exponent of volume fraction", 0, {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance}};
    return simulator.remembered(key, [&] { return exponent_over_structures(simulator, settings); });
}

}  // namespace

double volume_fraction_exponent(Simulator& simulator, const Settings& settings, bool exact) {
    if (exact) {
        return exponent_node(simulator, settings);
    }
    // The slope is linear in the logarithms of the moduli, which are what is interpolated.
    return std::log(between_nodes(settings, [&](const Settings& node) { return std::exp(exponent_node(simulator, node)); }));
}

}  // namespace coagula::diagnose
