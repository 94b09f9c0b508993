// SPDX-License-Identifier: GPL-3.0-or-later
// Amplitude sweeps of breaking bonds by the explicit rheometer: data that the diagnosis does not make itself.
#pragma once

#include "hidden_effects.hpp"

#include <coagula/mechanics/rheometer.hpp>

namespace coagula::diagnose {

/// G* of a sweep, mean over structures of 250 particles in some orientations each.
/// @param critical_strain at which a bond between particles of 0.25 um breaks.
inline std::vector<std::complex<double>> explicit_sweep(const std::vector<double>& strains, double critical_strain,
                                                        const std::vector<std::uint64_t>& seeds,
                                                        const std::vector<mechanics::ShearOrientation>& orientations) {
    mechanics::RheometerOptions run;
    run.model = {.normal_stiffness = 40, .shear_stiffness = 4};
    run.model.normal_strength = run.model.shear_strength = critical_strain * 20 * 0.25e-6;
    run.boundary = mechanics::RheometerBoundary::periodic;
    run.amplitude = *std::max_element(strains.begin(), strains.end());
    run.oscillations = static_cast<int>(strains.size()) + 2;
    run.steps_per_oscillation = 5000;
    run.damping = 0.75;
    run.compare_with_rest = false;
    run.course.assign(2, {1e-3});  // until the start is forgotten
    for (const double strain : strains) {
        run.course.push_back({strain / run.amplitude});
    }
    const auto runs = static_cast<double>(seeds.size() * orientations.size());
    std::vector<std::complex<double>> moduli(strains.size());
    for (const std::uint64_t seed : seeds) {
        const Packing packing = structure(250, seed);
        const auto result = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), run, orientations);
        for (const auto& one : result.runs) {
            const double lag = one.oscillations[1].fundamental_loss;  // of the rate of the run
            for (std::size_t k = 0; k < strains.size(); ++k) {
                const auto& oscillation = one.oscillations[k + 2];
                moduli[k] += std::complex(oscillation.fundamental_storage, oscillation.fundamental_loss - lag) / runs;
            }
        }
    }
    return moduli;
}

}  // namespace coagula::diagnose
