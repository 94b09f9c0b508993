// SPDX-License-Identifier: GPL-3.0-or-later
#include "amplitude_response.hpp"

#include <coagula/common/contact_law.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/parallel.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include "linear_modulus.hpp"
#include "population_curve.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

/// Nodes of the strength curve: amplitude over critical strain.
const std::vector<double> loads{1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 12, 16, 32};
/// Degrees of freedom, for the scale of the errors, that one more structure adds: what breaks at once is so uneven that a curve
/// counts for no more (sets of 2, 4 and 8 of 32 structures of 400 particles against the others, with errors independent from node
/// to node).
constexpr double degrees_of_structure = 3;
/// Settings of the explicit runs: what a run of this rate loses without breaking is taken off, but it must not shake bonds
/// apart.
constexpr int steps_per_oscillation = 6000;
constexpr double damping = 0.7;
ContactModel breaking_model(double ratio, double strength) {
    ContactModel model;
    model.normal_stiffness = unit_stiffness;
    model.shear_stiffness = ratio * unit_stiffness;
    model.normal_strength = strength;
    model.shear_strength = strength;
    return model;
}

/// Amplitudes with those nodes of the strength curve between whose neighbours no amplitude lies, as far as the largest.
std::vector<double> with_nodes_between(std::vector<double> amplitudes, double critical_strain) {
    const std::vector<double> given = amplitudes;
    for (std::size_t node = 0; node + 1 < loads.size() && loads[node] * critical_strain < given.back(); ++node) {
        const double below = node > 0 ? loads[node - 1] : 0.0;
        const auto next = std::upper_bound(given.begin(), given.end(), below * critical_strain);
        if (*next >= loads[node + 1] * critical_strain) {
            amplitudes.push_back(loads[node] * critical_strain);
        }
    }
    std::sort(amplitudes.begin(), amplitudes.end());
    return amplitudes;
}

/// Two oscillations at each of some growing amplitudes by the explicit rheometer in a sheared cell, over the modulus at a strain so
/// small that nothing breaks. In the second one bonds hold: what it loses is the rate of the run, and the first has lost the rest
/// in breaking.
std::vector<Yielded> sweep(const Packing& packing, const Settings& settings, double strength, const std::vector<double>& amplitudes,
                           const Progress& progress) {
    mechanics::RheometerOptions options;
    options.model = breaking_model(settings.stiffness_ratio, strength);
    options.boundary = mechanics::RheometerBoundary::periodic;
    options.amplitude = amplitudes.back();
    options.steps_per_oscillation = steps_per_oscillation;
    options.damping = damping;
    options.compare_with_rest = false;
    options.course.assign(2, {std::min(1e-3, 0.1 * settings.critical_strain / amplitudes.back())});
    for (const double amplitude : amplitudes) {
        options.course.push_back({amplitude / amplitudes.back()});
        options.course.push_back({amplitude / amplitudes.back(), false});
    }
    options.oscillations = static_cast<int>(options.course.size());
    const ContactNetwork bonds = find_contacts(packing, settings.bond_tolerance);
    const mechanics::RheometerRun run =
        mechanics::run_rheometer(packing, bonds, options, {mechanics::ShearOrientation{}}, progress).runs.front();
    const double unbroken = run.oscillations[1].fundamental_storage;
    std::vector<Yielded> responses;
    for (std::size_t k = 2; k < run.oscillations.size(); k += 2) {
        const mechanics::Oscillation& one = run.oscillations[k];
        const mechanics::Oscillation& settled = run.oscillations[k + 1];
        const double lost = one.broken_bonds > 0 ? one.fundamental_loss - settled.fundamental_loss : 0.0;
        responses.push_back({Complex(one.fundamental_storage, lost) / unbroken, settled.fundamental_storage / unbroken});
    }
    return responses;
}

/// The numbers of a sweep in the cache.
std::vector<double> numbers_of(const std::vector<Yielded>& responses) {
    std::vector<double> values;
    for (const Yielded& response : responses) {
        values.insert(values.end(), {response.first.real(), response.first.imag(), response.settled});
    }
    return values;
}

std::vector<Yielded> yielded_of(const std::vector<double>& values) {
    std::vector<Yielded> responses;
    for (std::size_t place = 0; place < values.size(); place += 3) {
        responses.push_back({Complex(values[place], values[place + 1]), values[place + 2]});
    }
    return responses;
}

/// Runs those sweeps, of structure k at amplitudes[k], that the cache does not hold, one beside the other: a structure is too small
/// for several threads.
std::vector<std::vector<Yielded>> structure_responses(Simulator& simulator, const Settings& settings,
                                                      const std::vector<std::vector<double>>& amplitudes) {
    // Strain times stiffness over strength is what counts, so that unit stiffness serves all.
    const double strength = settings.critical_strain * stiffness_in_series(unit_stiffness, unit_stiffness) * simulator.radius();
    std::vector<ResultKey> keys;
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
        keys.push_back({"breaking", k, {settings.stiffness_ratio, settings.bond_tolerance, strength}});
        keys[k].at.insert(keys[k].at.end(), amplitudes[k].begin(), amplitudes[k].end());
        if (!amplitudes[k].empty() && simulator.in_cache(keys[k], 3 * amplitudes[k].size()) == nullptr) {
            missing.push_back(k);
            (void)simulator.structure(k);  // made now, where it is made on demand: two threads must not
        }
    }
    if (!missing.empty()) {
        simulator.require_simulations();
        simulator.progress().update("simulating", 0.0, "amplitude sweep with breaking bonds");
    }
    std::mutex mutex;
    const Progress shared([&](std::string_view stage, double fraction, std::string_view remark) {
        const std::lock_guard lock(mutex);
        simulator.progress().update(stage, fraction, remark);
        return true;
    });
    run_together(missing.size(), [&](std::size_t place) {
        const std::size_t k = missing[place];
        std::vector<double> values = numbers_of(sweep(simulator.structure(k), settings, strength, amplitudes[k], shared));
        const std::lock_guard lock(mutex);
        simulator.keep(keys[k], std::move(values));
    });
    std::vector<std::vector<Yielded>> responses(amplitudes.size());
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
        if (!amplitudes[k].empty()) {
            responses[k] = yielded_of(*simulator.in_cache(keys[k], 3 * amplitudes[k].size()));
        }
    }
    return responses;
}

/// How every structure yields at the nodes of the strength curve.
std::vector<std::vector<Yielded>> nodes_of_strength_curves(Simulator& simulator) {
    Settings settings;
    settings.critical_strain = 1e-4;
    std::vector<double> amplitudes;
    for (const double load : loads) {
        amplitudes.push_back(load * settings.critical_strain);
    }
    return structure_responses(simulator, settings, std::vector(simulator.structures(), amplitudes));
}

/// Largest strain of each structure up to which no bond breaks, as far as the strength curves tell.
std::vector<double> unbroken_strains(Simulator& simulator, const Settings& settings) {
    const Settings base;
    std::vector<double> strains(simulator.structures(), 0);
    if (settings.stiffness_ratio == base.stiffness_ratio && settings.bond_tolerance == base.bond_tolerance) {
        const std::vector<std::vector<Yielded>> nodes = nodes_of_strength_curves(simulator);
        for (std::size_t k = 0; k < strains.size(); ++k) {
            for (std::size_t node = 0; node < loads.size() && nodes[k][node].first.imag() == 0; ++node) {
                strains[k] = loads[node] * settings.critical_strain;
            }
        }
    }
    return strains;
}

}  // namespace

std::vector<Yielded> exact_amplitude_response(Simulator& simulator, const Settings& settings,
                                              const std::vector<double>& amplitudes) {
    std::vector<std::vector<double>> breaking;
    for (const double unbroken : unbroken_strains(simulator, settings)) {
        breaking.emplace_back(std::upper_bound(amplitudes.begin(), amplitudes.end(), unbroken), amplitudes.end());
    }
    const double share = 1 / static_cast<double>(simulator.structures());
    std::vector<Yielded> mean(amplitudes.size());
    for (std::vector<Yielded>& one : structure_responses(simulator, settings, breaking)) {
        one.insert(one.begin(), mean.size() - one.size(), {1, 1});
        for (std::size_t entry = 0; entry < mean.size(); ++entry) {
            mean[entry].first += share * one[entry].first;
            mean[entry].settled += share * one[entry].settled;
        }
    }
    return mean;
}

YieldCurves exact_yield_curve(Simulator& simulator, const Settings& settings, const std::vector<double>& amplitudes) {
    const std::vector<double> nodes = with_nodes_between(amplitudes, settings.critical_strain);
    const std::vector<Yielded> run = exact_amplitude_response(simulator, settings, nodes);
    std::vector<double> run_loads;
    Eigen::RowVectorXcd settled(static_cast<Index>(nodes.size()));
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        run_loads.push_back(nodes[node] / settings.critical_strain);
        settled[static_cast<Index>(node)] = Complex(run[node].settled, run[node].first.imag());
    }
    return {run_loads, settled};
}

namespace {

/// The curve of a large sample, and errors.
const YieldCurves& strength_curves(Simulator& simulator) {
    return simulator.remembered({"strength curves"}, [&] {
        Eigen::MatrixXcd curves(static_cast<Index>(loads.size()), static_cast<Index>(simulator.structures()));
        const std::vector<std::vector<Yielded>> nodes = nodes_of_strength_curves(simulator);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            for (std::size_t node = 0; node < loads.size(); ++node) {
                curves(static_cast<Index>(node), static_cast<Index>(k)) =
                    Complex(nodes[k][node].settled, nodes[k][node].first.imag());
            }
        }
        return YieldCurves(loads, population_curve(loads, curves).transpose());
    });
}

}  // namespace

double yield_degrees(const Simulator& simulator) {
    return degrees_of_structure * (static_cast<double>(simulator.structures()) - 1);
}

std::array<double, 4> storage_in_quarters(Simulator& simulator, const Settings& settings, double before, double amplitude,
                                          double sine) {
    if (!std::isfinite(settings.critical_strain)) {
        return {1, 1, 1, 1};
    }
    return strength_curves(simulator).storage(before / settings.critical_strain, amplitude / settings.critical_strain, sine);
}

Eigen::VectorXcd amplitude_response(Simulator& simulator, const Settings& settings, double before, double amplitude) {
    if (!std::isfinite(settings.critical_strain)) {
        return Eigen::VectorXcd::Ones(1);
    }
    return strength_curves(simulator).response(before / settings.critical_strain, amplitude / settings.critical_strain);
}

}  // namespace coagula::diagnose
