// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_modulus.hpp"

#include "linear_grid.hpp"
#include "structure_changes.hpp"

#include <cmath>
#include <numeric>

namespace coagula::diagnose {

namespace {

/// Mean modulus for unit stiffness over the structures of a group.
double mean_modulus(Simulator& simulator, const Settings& settings, std::size_t group) {
    const ResultKey key{"linear", group, {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance}};
    return simulator.remembered(key, [&] {
        const std::vector<std::size_t> structures = simulator.members(group);
        double sum = 0;
        for (const std::size_t k : structures) {
            sum += moduli_of_structure(simulator, k, settings).front();
        }
        return sum / static_cast<double>(structures.size());
    });
}

}  // namespace

mechanics::LinearResponse solve_springs(const Simulator& simulator, const Packing& packing, const ContactNetwork& bonds,
                                        const Settings& settings) {
    Settings springs;
    springs.normal_stiffness = unit_stiffness;
    springs.stiffness_ratio = settings.stiffness_ratio;
    springs.bending_ratio = settings.bending_ratio;
    springs.tension = settings.tension;
    mechanics::LinearOptions options;
    options.normal_stiffness = unit_stiffness;
    options.shear_stiffness = springs.stiffness_ratio * unit_stiffness;
    if (springs.bending_ratio > 0 || springs.tension > 0) {
        options.bond_tangents = mechanics::bond_tangents(packing, bonds, contact_model_of(springs, simulator.radius()));
    }
    return mechanics::solve_linear(packing, bonds, options, simulator.progress());
}

const std::vector<double>& moduli_of_structure(Simulator& simulator, std::size_t structure, const Settings& settings) {
    const ResultKey key{"linear", structure, {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance}};
    return simulator.simulated(key, 4, [&](const Packing& packing) -> std::vector<double> {
        simulator.progress().update("simulating", 0.0, "linear modulus");
        Settings free = settings;
        free.tension = 0;
        const mechanics::LinearResponse response =
            solve_springs(simulator, packing, find_contacts(packing, settings.bond_tolerance), free);
        return {response.mean_shear_modulus(), response.shear_modulus(0, 1), response.shear_modulus(0, 2),
                response.shear_modulus(1, 2)};
    });
}

double exact_linear_modulus(Simulator& simulator, const Settings& settings, std::size_t group) {
    return settings.normal_stiffness / unit_stiffness * mean_modulus(simulator, settings, group);
}

double linear_modulus(Simulator& simulator, const Settings& settings, std::size_t group) {
    if (settings.structures != StructureChange{}) {
        return over_changes(simulator, settings.structures,
                            [&](Simulator& other) { return linear_modulus(other, as_stated(settings), group); });
    }
    const double modulus = between_nodes(settings, [&](const Settings& node) { return mean_modulus(simulator, node, group); });
    return settings.normal_stiffness / unit_stiffness * modulus;
}

namespace {

/// Standard deviation of the moduli of structures of one group, for unit stiffness [Pa]. It is pooled over the groups as it stands,
/// not relative to their moduli: what makes structures differ is their coordination, on which the modulus depends linearly.
double scatter_between_structures(Simulator& simulator) {
    double squares = 0;
    double degrees = 0;
    const auto add = [&](const std::vector<double>& values, double weight) {
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
        for (const double value : values) {
            squares += weight * std::pow(value - mean, 2);
        }
        degrees += static_cast<double>(values.size()) - 1;
    };
    for (const std::size_t group : simulator.groups()) {
        std::vector<double> moduli;
        for (const std::size_t k : simulator.members(group)) {
            moduli.push_back(moduli_of_structure(simulator, k, {}).front());
        }
        add(moduli, 1);
    }
    const bool alone = degrees == 0;
    for (std::size_t k = 0; alone && k < simulator.structures(); ++k) {
        const std::vector<double>& one = moduli_of_structure(simulator, k, {});
        add({one.begin() + 1, one.end()}, 1.0 / 3);  // of their mean
    }
    return std::sqrt(squares / degrees);
}

}  // namespace

double structure_error(Simulator& simulator, std::size_t group) {
    const double scatter =
        simulator.remembered({"scatter between structures"}, [&] { return scatter_between_structures(simulator); });
    const double modulus = mean_modulus(simulator, {}, group);
    return modulus > 0 ? scatter / modulus / std::sqrt(static_cast<double>(simulator.members(group).size())) : 0.0;
}

}  // namespace coagula::diagnose
