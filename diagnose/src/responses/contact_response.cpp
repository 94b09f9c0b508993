// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_response.hpp"

#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/hertz_curve.hpp>

#include "fundamental.hpp"
#include "hertz_scatter.hpp"
#include "interpolation.hpp"

#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double any_preload = 1e-4;  ///< of the contacts; the response depends on the strain over it alone

/// Stress over strain of one structure at the nodes.
const std::vector<double>& secant_moduli(Simulator& simulator, std::size_t structure) {
    const ResultKey key{"Hertz contacts", structure, {hertz_axis.low, hertz_axis.high}};
    return simulator.simulated(key, static_cast<std::size_t>(hertz_axis.count), [&](const Packing& packing) {
        simulator.progress().update("simulating", 0.0, "Hertz contacts");
        std::vector<double> loads;
        for (int node = 0; node < hertz_axis.count; ++node) {
            loads.push_back(hertz_axis.node(node));
        }
        Settings hertz;
        hertz.contact_preload = any_preload;
        return mechanics::hertz_curve(packing, find_contacts(packing, hertz.bond_tolerance),
                                      contact_model_of(hertz, mean_radius(packing)), any_preload, loads, simulator.progress());
    });
}

/// Logarithm of the mean over the structures.
const std::vector<double>& secant_curve(Simulator& simulator) {
    return simulator.remembered({"Hertz contacts"}, [&] {
        std::vector<double> curve(static_cast<std::size_t>(hertz_axis.count), 0.0);
        for (std::size_t structure = 0; structure < simulator.structures(); ++structure) {
            const std::vector<double>& one = secant_moduli(simulator, structure);
            for (std::size_t node = 0; node < one.size(); ++node) {
                curve[node] += one[node] / static_cast<double>(simulator.structures());
            }
        }
        for (double& secant : curve) {
            secant = std::log(secant);
        }
        return curve;
    });
}

}  // namespace

double contact_secant(Simulator& simulator, const Settings& settings, double strain) {
    if (settings.contact_preload <= 0) {
        return 1;
    }
    const std::vector<double>& curve = secant_curve(simulator);
    const double load = std::abs(strain) / settings.contact_preload;
    const double secant =
        std::exp(interpolate_nodes(hertz_axis, load, [&](int node) { return curve[static_cast<std::size_t>(node)]; }));
    return load > hertz_axis.high ? secant * std::sqrt(load / hertz_axis.high) : secant;
}

namespace {

/// Errors of the fundamental at amplitudes of the nodes, relative.
const HertzScatter& scatter_of_fundamentals(Simulator& simulator) {
    return simulator.remembered({"scatter of Hertz contacts"}, [&] {
        Eigen::MatrixXd logarithms(hertz_axis.count, static_cast<Index>(simulator.structures()));
        for (std::size_t structure = 0; structure < simulator.structures(); ++structure) {
            const std::vector<double>& one = secant_moduli(simulator, structure);
            logarithms.col(static_cast<Index>(structure)) =
                Eigen::Map<const Eigen::ArrayXd>(one.data(), hertz_axis.count).log() - std::log(one.front());
        }
        const HertzScatter secants = hertz_scatter(simulator.particles(), logarithms);
        const auto error = [&](int node) -> Eigen::RowVectorXd { return secants.errors.row(node); };
        Settings settings;
        settings.contact_preload = 1;
        HertzScatter fundamentals = secants;
        for (int node = 0; node < hertz_axis.count; ++node) {
            const double amplitude = hertz_axis.node(node);
            const auto moved = [&](double load) {
                return Eigen::RowVectorXd(contact_secant(simulator, settings, load) * interpolate_nodes(hertz_axis, load, error));
            };
            fundamentals.errors.row(node) = fundamental(amplitude, moved) / contact_response(simulator, settings, amplitude);
        }
        return fundamentals;
    });
}

}  // namespace

double contact_response(Simulator& simulator, const Settings& settings, double amplitude) {
    if (settings.contact_preload <= 0) {
        return 1;
    }
    return fundamental(amplitude, [&](double strain) { return contact_secant(simulator, settings, strain); });
}

double contact_degrees(Simulator& simulator) {
    return scatter_of_fundamentals(simulator).degrees;
}

Eigen::RowVectorXd contact_errors(Simulator& simulator, const Settings& settings, double amplitude) {
    const Eigen::MatrixXd& errors = scatter_of_fundamentals(simulator).errors;
    const auto at = [&](int node) -> Eigen::RowVectorXd { return errors.row(node); };
    return interpolate_nodes(hertz_axis, amplitude / settings.contact_preload, at);
}

Response hertz_contacts() {
    return {.acts = [](const Settings& settings,
                       const Conditions& at) { return settings.contact_preload > 0 && std::isfinite(at.strain); },
            .factor = [](Simulator& simulator, const Settings& settings, const Conditions& at, bool) -> std::complex<double> {
                return contact_response(simulator, settings, at.strain);
            },
            .scatter = [](Simulator& simulator, const Settings& settings, const Conditions& at) -> Scatter {
                return {.relative = contact_errors(simulator, settings, at.strain)};
            },
            .degrees = contact_degrees,
            .follows_strain = true};
}

}  // namespace coagula::diagnose
