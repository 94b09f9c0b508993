// Amplitude response of Hertz contacts, between the nodes of a grid of strains.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/hertz_curve.hpp>

#include "cache_key.hpp"
#include "hertz_scatter.hpp"
#include "interpolation.hpp"

#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double any_preload = 1e-4;   ///< of the contacts; the response depends on the strain over it alone
constexpr int phases_of_quarter = 24;  ///< of a quarter of an oscillation

}  // namespace

/// Stress over strain of one structure at the nodes.
const std::vector<double>& Simulator::secant_moduli(std::size_t structure) {
    const auto count = static_cast<std::size_t>(hertz_axis.count);
    const std::string key = key_of("Hertz contacts " + names_[structure], {hertz_axis.low, hertz_axis.high});
    auto found = find_result(cache_, key, count);
    if (found == cache_.end()) {
        progress_.update("simulating", 0.0, "Hertz contacts");
        std::vector<double> loads;
        for (int node = 0; node < hertz_axis.count; ++node) {
            loads.push_back(hertz_axis.node(node));
        }
        const Packing& packing = structures_[structure];
        const ContactNetwork bonds = find_contacts(packing, Settings{}.bond_tolerance);
        Settings hertz;
        hertz.contact_preload = any_preload;
        const ContactModel contact = contact_model_of(hertz, mean_radius(packing));
        const std::vector<double> curve = mechanics::hertz_curve(packing, bonds, contact, any_preload, loads, progress_);
        found = cache_.insert_or_assign(key, curve).first;
    }
    return found->second;
}

/// Logarithm of the mean over the structures.
const std::vector<double>& Simulator::secant_curve() {
    if (secant_curve_.empty()) {
        secant_curve_.assign(static_cast<std::size_t>(hertz_axis.count), 0.0);
        for (std::size_t structure = 0; structure < structures_.size(); ++structure) {
            const std::vector<double>& one = secant_moduli(structure);
            for (std::size_t node = 0; node < one.size(); ++node) {
                secant_curve_[node] += one[node] / static_cast<double>(structures_.size());
            }
        }
        for (double& secant : secant_curve_) {
            secant = std::log(secant);
        }
    }
    return secant_curve_;
}

double Simulator::contact_secant(const Settings& settings, double strain) {
    if (settings.contact_preload <= 0) {
        return 1;
    }
    const std::vector<double>& curve = secant_curve();
    const double load = std::abs(strain) / settings.contact_preload;
    const double secant =
        std::exp(interpolate_nodes(hertz_axis, load, [&](int node) { return curve[static_cast<std::size_t>(node)]; }));
    return load > hertz_axis.high ? secant * std::sqrt(load / hertz_axis.high) : secant;
}

namespace {

/// The fundamental of the stress: mean of f(strain) over a quarter of an oscillation with the weights of 4/pi sin^2.
template <class Function>
auto fundamental(double amplitude, const Function& f) {
    std::decay_t<decltype(f(amplitude))> sum = 0 * f(amplitude);
    for (int k = 0; k < phases_of_quarter; ++k) {
        const double sine = std::sin(0.5 * std::numbers::pi * (k + 0.5) / phases_of_quarter);
        sum += 2.0 / phases_of_quarter * sine * sine * f(amplitude * sine);
    }
    return sum;
}

}  // namespace

double Simulator::contact_response(const Settings& settings, double amplitude) {
    if (settings.contact_preload <= 0) {
        return 1;
    }
    return fundamental(amplitude, [&](double strain) { return contact_secant(settings, strain); });
}

/// Of the fundamental at amplitudes of the nodes, relative.
const HertzScatter& Simulator::contact_scatter() {
    if (!contact_scatter_) {
        Eigen::MatrixXd logarithms(hertz_axis.count, static_cast<Index>(structures_.size()));
        for (std::size_t structure = 0; structure < structures_.size(); ++structure) {
            const std::vector<double>& one = secant_moduli(structure);
            logarithms.col(static_cast<Index>(structure)) =
                Eigen::Map<const Eigen::ArrayXd>(one.data(), hertz_axis.count).log() - std::log(one.front());
        }
        const HertzScatter secants = hertz_scatter(particles(), logarithms);
        const auto error = [&](int node) -> Eigen::RowVectorXd { return secants.errors.row(node); };
        Settings settings;
        settings.contact_preload = 1;
        HertzScatter fundamentals = secants;
        for (int node = 0; node < hertz_axis.count; ++node) {
            const double amplitude = hertz_axis.node(node);
            const auto moved = [&](double load) {
                return Eigen::RowVectorXd(contact_secant(settings, load) * interpolate_nodes(hertz_axis, load, error));
            };
            fundamentals.errors.row(node) = fundamental(amplitude, moved) / contact_response(settings, amplitude);
        }
        contact_scatter_ = std::make_shared<HertzScatter>(std::move(fundamentals));
    }
    return *contact_scatter_;
}

double Simulator::contact_degrees() {
    return contact_scatter().degrees;
}

Eigen::RowVectorXd Simulator::contact_errors(const Settings& settings, double amplitude) {
    const Eigen::MatrixXd& errors = contact_scatter().errors;
    const auto at = [&](int node) -> Eigen::RowVectorXd { return errors.row(node); };
    return interpolate_nodes(hertz_axis, amplitude / settings.contact_preload, at);
}

}  // namespace coagula::diagnose
