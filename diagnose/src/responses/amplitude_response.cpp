// Amplitude sweeps with bonds that break, by the explicit rheometer.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_law.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/parallel.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include "cache_key.hpp"
#include "population_curve.hpp"
#include "unit_stiffness.hpp"

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
/// Of freedom, for the scale of the errors, that one more structure adds: what breaks at once is so uneven that a curve counts for
/// no more (sets of 2, 4 and 8 of 32 structures of 400 particles against the others, with errors independent from node to node).
constexpr double degrees_of_structure = 3;
/// Of the explicit runs: what a run of this rate loses without breaking is taken off, but it must not shake bonds apart.
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

}  // namespace

/// Two oscillations at each of some growing amplitudes by the explicit rheometer in a sheared cell, over the modulus at a strain so
/// small that nothing breaks. In the second one bonds hold: what it loses is the rate of the run, and the first has lost the rest
/// in breaking.
std::vector<Yielded> Simulator::sweep(std::size_t structure, const Settings& settings, double strength,
                                      const std::vector<double>& amplitudes, const Progress& progress) const {
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
    const ContactNetwork bonds = find_contacts(structures_[structure], settings.bond_tolerance);
    const mechanics::RheometerRun run =
        mechanics::run_rheometer(structures_[structure], bonds, options, {mechanics::ShearOrientation{}}, progress).runs.front();
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

/// Runs those sweeps, of structure k at amplitudes[k], that the cache does not hold, one beside the other: a structure is too small
/// for several threads. The keys of all in the cache.
std::vector<std::string> Simulator::run_sweeps(const Settings& settings, const std::vector<std::vector<double>>& amplitudes) {
    // Strain times stiffness over strength is what counts, so that unit stiffness serves all.
    const double strength = settings.critical_strain * stiffness_in_series(unit_stiffness, unit_stiffness) * radius_;
    std::vector<std::string> keys;
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
        std::vector<double> what{settings.stiffness_ratio, settings.bond_tolerance, strength};
        what.insert(what.end(), amplitudes[k].begin(), amplitudes[k].end());
        keys.push_back(key_of("breaking " + names_[k], what));
        const auto found = cache_.find(keys[k]);
        if (!amplitudes[k].empty() && (found == cache_.end() || found->second.size() != 3 * amplitudes[k].size())) {
            missing.push_back(k);
            (void)structures_[k];  // made now, where it is made on demand: two threads must not
        }
    }
    if (!missing.empty()) {
        progress_.update("simulating", 0.0, "amplitude sweep with breaking bonds");
    }
    std::mutex mutex;
    const Progress shared([&](std::string_view stage, double fraction, std::string_view remark) {
        const std::lock_guard lock(mutex);
        progress_.update(stage, fraction, remark);
        return true;
    });
    run_together(missing.size(), [&](std::size_t place) {
        const std::size_t k = missing[place];
        std::vector<double> values;
        for (const Yielded& response : sweep(k, settings, strength, amplitudes[k], shared)) {
            values.insert(values.end(), {response.first.real(), response.first.imag(), response.settled});
        }
        const std::lock_guard lock(mutex);
        cache_.insert_or_assign(keys[k], std::move(values));
    });
    return keys;
}

/// How every structure yields at its amplitudes of a sweep.
std::vector<std::vector<Yielded>> Simulator::structure_responses(const Settings& settings,
                                                                 const std::vector<std::vector<double>>& amplitudes) {
    const std::vector<std::string> keys = run_sweeps(settings, amplitudes);
    std::vector<std::vector<Yielded>> responses(amplitudes.size());
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
        for (std::size_t entry = 0; entry < amplitudes[k].size(); ++entry) {
            const double* values = cache_.at(keys[k]).data() + 3 * entry;
            responses[k].push_back({Complex(values[0], values[1]), values[2]});
        }
    }
    return responses;
}

/// How every structure yields at the nodes of the strength curve.
std::vector<std::vector<Yielded>> Simulator::nodes_of_strength_curves() {
    Settings settings;
    settings.critical_strain = 1e-4;
    std::vector<double> amplitudes;
    for (const double load : loads) {
        amplitudes.push_back(load * settings.critical_strain);
    }
    return structure_responses(settings, std::vector(structures_.size(), amplitudes));
}

/// Largest strain of each structure up to which no bond breaks, as far as the strength curves tell.
std::vector<double> Simulator::unbroken_strains(const Settings& settings) {
    const Settings base;
    std::vector<double> strains(structures_.size(), 0);
    if (settings.stiffness_ratio == base.stiffness_ratio && settings.bond_tolerance == base.bond_tolerance) {
        const std::vector<std::vector<Yielded>> nodes = nodes_of_strength_curves();
        for (std::size_t k = 0; k < strains.size(); ++k) {
            for (std::size_t node = 0; node < loads.size() && nodes[k][node].first.imag() == 0; ++node) {
                strains[k] = loads[node] * settings.critical_strain;
            }
        }
    }
    return strains;
}

std::vector<Yielded> Simulator::exact_amplitude_response(const Settings& settings, const std::vector<double>& amplitudes) {
    std::vector<std::vector<double>> breaking;
    for (const double unbroken : unbroken_strains(settings)) {
        breaking.emplace_back(std::upper_bound(amplitudes.begin(), amplitudes.end(), unbroken), amplitudes.end());
    }
    const double share = 1 / static_cast<double>(structures_.size());
    std::vector<Yielded> mean(amplitudes.size());
    for (std::vector<Yielded>& one : structure_responses(settings, breaking)) {
        one.insert(one.begin(), mean.size() - one.size(), {1, 1});
        for (std::size_t entry = 0; entry < mean.size(); ++entry) {
            mean[entry].first += share * one[entry].first;
            mean[entry].settled += share * one[entry].settled;
        }
    }
    return mean;
}

YieldCurves Simulator::exact_yield_curve(const Settings& settings, const std::vector<double>& amplitudes) {
    const std::vector<double> nodes = with_nodes_between(amplitudes, settings.critical_strain);
    const std::vector<Yielded> run = exact_amplitude_response(settings, nodes);
    std::vector<double> run_loads;
    Eigen::RowVectorXcd settled(static_cast<Index>(nodes.size()));
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        run_loads.push_back(nodes[node] / settings.critical_strain);
        settled[static_cast<Index>(node)] = Complex(run[node].settled, run[node].first.imag());
    }
    return {run_loads, settled};
}

/// Of a large sample, and errors.
const YieldCurves& Simulator::strength_curves() {
    if (strength_curves_) {
        return *strength_curves_;
    }
    Eigen::MatrixXcd curves(static_cast<Index>(loads.size()), static_cast<Index>(structures_.size()));
    const std::vector<std::vector<Yielded>> nodes = nodes_of_strength_curves();
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        for (std::size_t node = 0; node < loads.size(); ++node) {
            curves(static_cast<Index>(node), static_cast<Index>(k)) = Complex(nodes[k][node].settled, nodes[k][node].first.imag());
        }
    }
    return strength_curves_.emplace(loads, population_curve(loads, curves).transpose());
}

double Simulator::yield_degrees() const {
    return degrees_of_structure * (static_cast<double>(structures_.size()) - 1);
}

std::array<double, 4> Simulator::storage_while_breaking(const Settings& settings, double before, double amplitude, double sine) {
    if (!std::isfinite(settings.critical_strain)) {
        return {1, 1, 1, 1};
    }
    return strength_curves().storage(before / settings.critical_strain, amplitude / settings.critical_strain, sine);
}

Eigen::VectorXcd Simulator::amplitude_response(const Settings& settings, double before, double amplitude) {
    if (!std::isfinite(settings.critical_strain)) {
        return Eigen::VectorXcd::Ones(1);
    }
    return strength_curves().response(before / settings.critical_strain, amplitude / settings.critical_strain);
}

}  // namespace coagula::diagnose
