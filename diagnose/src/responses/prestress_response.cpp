// SPDX-License-Identifier: GPL-3.0-or-later
#include "prestress_response.hpp"

#include "interpolation.hpp"
#include "linear_modulus.hpp"

namespace coagula::diagnose {

namespace {

constexpr NodeAxis tension_axis{1e-4, 1e-2, 7};

/// Modulus of one structure for unit stiffness [Pa].
double prestressed_modulus(Simulator& simulator, std::size_t structure, const Settings& settings) {
    const ResultKey key{
        "prestress", structure, {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance, settings.tension}};
    const auto run = [&](const Packing& packing) -> std::vector<double> {
        simulator.progress().update("simulating", 0.0, "linear modulus under tension");
        const ContactNetwork bonds = find_contacts(packing, settings.bond_tolerance);
        return {solve_springs(simulator, packing, bonds, settings).mean_shear_modulus()};
    };
    return simulator.simulated(key, 1, run).front();
}

double ratio_of_moduli(Simulator& simulator, const Settings& settings, std::size_t group) {
    const ResultKey key{
        "prestress", group, {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance, settings.tension}};
    return simulator.remembered(key, [&] {
        double sum = 0;
        double free = 0;
        for (const std::size_t k : simulator.members(group)) {
            sum += prestressed_modulus(simulator, k, settings);
            free += moduli_of_structure(simulator, k, settings).front();
        }
        return free > 0 ? sum / free : 1.0;
    });
}

}  // namespace

double prestress_response(Simulator& simulator, const Settings& settings, std::size_t group, bool exact) {
    if (settings.tension <= 0) {
        return 1;
    }
    return exact ? ratio_of_moduli(simulator, settings, group) : interpolate(tension_axis, settings.tension, [&](double tension) {
        Settings node;
        node.tension = tension;
        return ratio_of_moduli(simulator, node, group);
    });
}

Response prestressed_contacts() {
    return {.acts = [](const Settings& settings, const Conditions&) { return settings.tension > 0; },
            .factor = [](Simulator& simulator, const Settings& settings, const Conditions& at, bool exact) -> std::complex<double> {
                return prestress_response(simulator, settings, at.group, exact);
            }};
}

}  // namespace coagula::diagnose
