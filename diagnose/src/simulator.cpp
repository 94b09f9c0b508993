#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_law.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include "cache_key.hpp"
#include "interpolation.hpp"
#include "unit_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coagula::diagnose {

namespace {

/// Nodes of the grids, uniform in the logarithm. Bending below its lowest node is off.
constexpr Axis ratio_axis{0.02, 2.0, 9};
constexpr Axis bending_axis{1e-6, 0.2, 12};
constexpr Axis tolerance_axis{5e-4, 0.08, 12};

/// Amplitude over critical strain of the strength curve: equal steps.
constexpr double load_step = 0.25;
constexpr int load_nodes = 32;
/// Of the explicit run behind it.
constexpr int steps_per_oscillation = 3000;

mechanics::LinearResponse solve(const Packing& packing, const ContactNetwork& bonds, double ratio, double bending, double radius,
                                const Progress& progress) {
    ContactModel model{.normal_stiffness = unit_stiffness, .shear_stiffness = ratio * unit_stiffness};
    mechanics::LinearOptions options;
    options.normal_stiffness = model.normal_stiffness;
    options.shear_stiffness = model.shear_stiffness;
    if (bending > 0) {
        const double moment = bending * stiffness_in_series(unit_stiffness, unit_stiffness) * radius * radius;
        model.bending_stiffness = moment;
        model.twisting_stiffness = moment;
        options.bond_tangents = mechanics::bond_tangents(packing, bonds, model);
    }
    return mechanics::solve_linear(packing, bonds, options, progress);
}

ContactModel breaking_model(double ratio, double strength) {
    ContactModel model;
    model.normal_stiffness = unit_stiffness;
    model.shear_stiffness = ratio * unit_stiffness;
    model.normal_strength = strength;
    model.shear_strength = strength;
    return model;
}

}  // namespace

Simulator::Simulator(std::vector<Packing> structures, std::vector<std::string> names, SimulationCache& cache,
                     const Progress& progress, std::vector<std::size_t> groups)
    : Simulator(Structures(std::move(structures)), std::move(names), cache, progress, std::move(groups), 0) {
    require(structures_.size() > 0 && structures_.size() == names_.size(), "a diagnosis needs at least one structure");
    require(groups_.empty() || groups_.size() == structures_.size(), "every structure must belong to a group, or none");
    radius_ = mean_radius(structures_[0]);
}

Simulator::Simulator(Structures structures, std::vector<std::string> names, SimulationCache& cache, Progress progress,
                     std::vector<std::size_t> groups, double radius)
    : structures_(std::move(structures)),
      names_(std::move(names)),
      groups_(std::move(groups)),
      cache_(cache),
      progress_(std::move(progress)),
      radius_(radius) {}

std::size_t Simulator::groups() const {
    return groups_.empty() ? 0 : *std::max_element(groups_.begin(), groups_.end());
}

std::vector<std::size_t> Simulator::members(std::size_t group) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        if (group == 0 || (!groups_.empty() && groups_[k] == group)) {
            found.push_back(k);
        }
    }
    require(!found.empty(), "no structure belongs to group " + std::to_string(group));
    return found;
}

double Simulator::particles(std::size_t group) const {
    const std::vector<std::size_t> structures = members(group);
    double sum = 0;
    for (const std::size_t k : structures) {
        sum += static_cast<double>(structures_.particles(k));
    }
    return sum / static_cast<double>(structures.size());
}

/// Moduli of one structure for unit stiffness: mean over the orientations, then the three shear planes.
const std::vector<double>& Simulator::linear_moduli(std::size_t structure, double ratio, double bending, double tolerance) {
    const std::string key = key_of("linear " + names_[structure], {ratio, bending, tolerance});
    auto found = cache_.find(key);
    if (found == cache_.end() || found->second.size() < 4) {
        progress_.update("simulating", 0.0, "linear modulus");
        const ContactNetwork bonds = find_contacts(structures_[structure], tolerance);
        const auto response = solve(structures_[structure], bonds, ratio, bending, radius_, progress_);
        const std::vector<double> values{response.mean_shear_modulus(), response.shear_modulus(0, 1), response.shear_modulus(0, 2),
                                         response.shear_modulus(1, 2)};
        found = cache_.insert_or_assign(key, values).first;
    }
    return found->second;
}

/// Mean modulus for unit stiffness at one node, over the structures of a group.
double Simulator::node(double ratio, double bending, double tolerance, std::size_t group) {
    const std::array place{ratio, bending, tolerance, static_cast<double>(group)};
    if (const auto found = nodes_.find(place); found != nodes_.end()) {
        return found->second;
    }
    const std::vector<std::size_t> structures = members(group);
    double sum = 0;
    for (const std::size_t k : structures) {
        sum += linear_moduli(k, ratio, bending, tolerance).front();
    }
    return nodes_[place] = sum / static_cast<double>(structures.size());
}

double Simulator::exact_linear_modulus(const Settings& settings, std::size_t group) {
    return settings.normal_stiffness / unit_stiffness *
           node(settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance, group);
}

double Simulator::linear_modulus(const Settings& settings, std::size_t group) {
    if (const StructureChange change = change_of(settings); change != StructureChange{}) {
        return over_changes(change, [&](Simulator& other) { return other.linear_modulus(as_stated(settings), group); });
    }
    const Settings base;
    const auto over_tolerance = [&](double ratio, double bending) {
        if (settings.bond_tolerance == base.bond_tolerance) {
            return node(ratio, bending, base.bond_tolerance, group);
        }
        return interpolate(tolerance_axis, settings.bond_tolerance,
                           [&](double tolerance) { return node(ratio, bending, tolerance, group); });
    };
    const auto over_bending = [&](double ratio) {
        if (settings.bending_ratio < bending_axis.low) {
            return over_tolerance(ratio, 0);
        }
        return interpolate(bending_axis, settings.bending_ratio, [&](double bending) { return over_tolerance(ratio, bending); });
    };
    const double modulus = settings.stiffness_ratio == base.stiffness_ratio
                               ? over_bending(base.stiffness_ratio)
                               : interpolate(ratio_axis, settings.stiffness_ratio, over_bending);
    return settings.normal_stiffness / unit_stiffness * modulus;
}

/// Standard deviation of the moduli of structures of one group, for unit stiffness [Pa]. It is pooled over the groups as it stands,
/// not relative to their moduli: what makes structures differ is their coordination, on which the modulus depends linearly.
double Simulator::scatter_between_structures() {
    const Settings base;
    double squares = 0;
    double degrees = 0;
    const auto add = [&](const std::vector<double>& values, double weight) {
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
        for (const double value : values) {
            squares += weight * std::pow(value - mean, 2);
        }
        degrees += static_cast<double>(values.size()) - 1;
    };
    for (std::size_t group = std::min<std::size_t>(1, groups()); group <= groups(); ++group) {
        std::vector<double> moduli;
        for (const std::size_t k : members(group)) {
            moduli.push_back(linear_moduli(k, base.stiffness_ratio, 0, base.bond_tolerance).front());
        }
        add(moduli, 1);
    }
    const bool alone = degrees == 0;
    for (std::size_t k = 0; alone && k < structures_.size(); ++k) {
        const std::vector<double>& one = linear_moduli(k, base.stiffness_ratio, 0, base.bond_tolerance);
        add({one.begin() + 1, one.end()}, 1.0 / 3);  // of their mean
    }
    return std::sqrt(squares / degrees);
}

double Simulator::structure_error(std::size_t group) {
    if (scatter_ < 0) {
        scatter_ = scatter_between_structures();
    }
    const Settings base;
    const double modulus = node(base.stiffness_ratio, 0, base.bond_tolerance, group);
    return modulus > 0 ? scatter_ / modulus / std::sqrt(static_cast<double>(members(group).size())) : 0.0;
}

/// Moduli of a sweep by the explicit rheometer in a sheared cell over that at a strain so small that nothing breaks.
std::vector<std::complex<double>> Simulator::sweep(std::size_t structure, const Settings& settings, double strength,
                                                   const std::vector<double>& amplitudes) {
    const double largest = *std::max_element(amplitudes.begin(), amplitudes.end());
    mechanics::RheometerOptions options;
    options.model = breaking_model(settings.stiffness_ratio, strength);
    options.boundary = mechanics::RheometerBoundary::periodic;
    options.amplitude = largest;
    options.oscillations = static_cast<int>(amplitudes.size()) + 2;
    options.steps_per_oscillation = steps_per_oscillation;
    options.compare_with_rest = false;
    options.course.assign(2, 1e-3);
    for (const double amplitude : amplitudes) {
        options.course.push_back(amplitude / largest);
    }
    const ContactNetwork bonds = find_contacts(structures_[structure], settings.bond_tolerance);
    const mechanics::RheometerRun run =
        mechanics::run_rheometer(structures_[structure], bonds, options, {mechanics::ShearOrientation{}}, progress_).runs.front();
    const mechanics::Oscillation& unbroken = run.oscillations[1];
    std::vector<std::complex<double>> responses;
    for (std::size_t k = 2; k < run.oscillations.size(); ++k) {
        const mechanics::Oscillation& one = run.oscillations[k];
        // What the rate of the run costs is in both.
        const std::complex<double> beyond(one.fundamental_storage - unbroken.fundamental_storage,
                                          one.fundamental_loss - unbroken.fundamental_loss);
        responses.push_back(1.0 + beyond / unbroken.fundamental_storage);
    }
    return responses;
}

std::vector<std::complex<double>> Simulator::exact_amplitude_response(const Settings& settings,
                                                                      const std::vector<double>& amplitudes) {
    // Strain times stiffness over strength is what counts, so that unit stiffness serves all.
    const double strength = settings.critical_strain * stiffness_in_series(unit_stiffness, unit_stiffness) * radius_;
    std::vector<std::complex<double>> mean(amplitudes.size());
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        std::vector<double> what{settings.stiffness_ratio, settings.bond_tolerance, strength};
        what.insert(what.end(), amplitudes.begin(), amplitudes.end());
        const std::string key = key_of("sweep " + names_[k], what);
        auto found = cache_.find(key);
        if (found == cache_.end()) {
            progress_.update("simulating", 0.0, "amplitude sweep with breaking bonds");
            std::vector<double> values;
            for (const std::complex<double>& response : sweep(k, settings, strength, amplitudes)) {
                values.insert(values.end(), {response.real(), response.imag()});
            }
            found = cache_.emplace(key, std::move(values)).first;
        }
        for (std::size_t entry = 0; entry < amplitudes.size(); ++entry) {
            mean[entry] +=
                std::complex(found->second[2 * entry], found->second[2 * entry + 1]) / static_cast<double>(structures_.size());
        }
    }
    return mean;
}

/// Storage and loss over the linear modulus at loads 1, 2, 3 ... times load_step.
const std::vector<double>& Simulator::strength_curve() {
    if (!strength_curve_.empty()) {
        return strength_curve_;
    }
    std::string all = "strength curve";
    for (const std::string& name : names_) {
        all += " " + name;
    }
    auto found = cache_.find(all);
    if (found == cache_.end()) {
        Settings settings;
        settings.critical_strain = 1e-4;
        std::vector<double> amplitudes;
        for (int k = 1; k <= load_nodes; ++k) {
            amplitudes.push_back(k * load_step * settings.critical_strain);
        }
        std::vector<double> values;
        for (const std::complex<double>& response : exact_amplitude_response(settings, amplitudes)) {
            values.insert(values.end(), {response.real(), response.imag()});
        }
        found = cache_.emplace(all, std::move(values)).first;
    }
    strength_curve_ = found->second;
    return strength_curve_;
}

std::complex<double> Simulator::amplitude_response(const Settings& settings, double amplitude) {
    if (!std::isfinite(settings.critical_strain)) {
        return 1;
    }
    const double load = amplitude / settings.critical_strain;
    const std::vector<double>& curve = strength_curve();
    const auto at = [&](int k) {
        const std::size_t place = 2 * static_cast<std::size_t>(std::min(k, load_nodes) - 1);
        return k == 0 ? std::complex<double>(1) : std::complex(curve[place], curve[place + 1]);
    };
    const double place = std::min(load / load_step, static_cast<double>(load_nodes));
    const int below = static_cast<int>(place);
    return at(below) + (place - below) * (at(below + 1) - at(below));
}

}  // namespace coagula::diagnose
