// SPDX-License-Identifier: GPL-3.0-or-later
#include "thinned_contacts.hpp"

#include <coagula/common/random.hpp>

#include "interpolation.hpp"
#include "linear_modulus.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

/// Contacts that are missing. Beyond the last node nothing bears a load in structures as loose as gels.
constexpr LinearAxis missing_axis{0, 0.4, 21};
/// Over the whole modulus: what bears nothing still has a modulus, that of what it is swollen with.
constexpr double least_response = 1e-3;
/// Particles of all structures and random orders together: what one order takes from a small structure is chance.
constexpr double enough_particles = 1000;

/// 0 where the network is too close to losing its stiffness for the solver.
double modulus_of(const Simulator& simulator, const Packing& packing, const ContactNetwork& bonds, const Settings& settings) {
    try {
        return solve_springs(simulator, packing, bonds, settings).mean_shear_modulus();
    } catch (const Cancelled&) {
        throw;
    } catch (const std::runtime_error&) {
        return 0;
    }
}

}  // namespace

ContactNetwork thinned(const ContactNetwork& contacts, double share, std::uint64_t order) {
    std::vector<std::pair<double, Index>> places;
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const auto number = static_cast<std::uint64_t>(contact);
        places.emplace_back(random_uniform(order, RandomPurpose::thinned_contacts, 0, number)[0], contact);
    }
    std::sort(places.begin(), places.end());
    const auto missing = std::lround(std::clamp(share, 0.0, 1.0) * static_cast<double>(contacts.size()));
    std::vector<Index> kept;
    for (auto place = places.begin() + missing; place != places.end(); ++place) {
        kept.push_back(place->second);
    }
    std::sort(kept.begin(), kept.end());
    return {contacts.particles, contacts.ends(Eigen::all, kept), contacts.branch(Eigen::all, kept)};
}

namespace {

/// Modulus of one structure for unit stiffness [Pa], mean over some random orders.
double thinned_modulus(Simulator& simulator, std::size_t structure, const Settings& settings, double missing) {
    const ResultKey key{"thinned", structure, {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance, missing}};
    const auto mean = [&](const Packing& packing) -> std::vector<double> {
        simulator.progress().update("simulating", 0.0, "linear modulus without some contacts");
        Settings free = settings;
        free.tension = 0;
        const ContactNetwork whole = find_contacts(packing, settings.bond_tolerance);
        const double all_particles = simulator.particles() * static_cast<double>(simulator.structures());
        const auto orders = static_cast<std::uint64_t>(std::max(1.0, std::round(enough_particles / all_particles)));
        double sum = 0;
        for (std::uint64_t order = 0; order < orders; ++order) {
            sum += modulus_of(simulator, packing, thinned(whole, missing, order), free);
        }
        return {sum / static_cast<double>(orders)};
    };
    return simulator.simulated(key, 1, mean).front();
}

/// Response at the nodes; nothing comes back once nothing is left.
const std::vector<double>& thinned_curve(Simulator& simulator, std::size_t group) {
    return simulator.remembered({"thinned", group}, [&] {
        std::vector<double> curve{1.0};
        for (int node = 1; node < missing_axis.count; ++node) {
            const bool gone = curve.back() <= least_response;
            curve.push_back(gone ? least_response : exact_thinned_response(simulator, {}, missing_axis.node(node), group));
        }
        return curve;
    });
}

}  // namespace

double exact_thinned_response(Simulator& simulator, const Settings& settings, double missing, std::size_t group) {
    double sum = 0;
    double whole = 0;
    for (const std::size_t k : simulator.members(group)) {
        sum += thinned_modulus(simulator, k, settings, missing);
        whole += moduli_of_structure(simulator, k, settings).front();
    }
    return whole > 0 ? std::max(sum / whole, least_response) : 1.0;
}

double thinned_response(Simulator& simulator, double missing, std::size_t group) {
    const std::vector<double>& curve = thinned_curve(simulator, group);
    const double response =
        interpolate_nodes(missing_axis, missing, [&](int node) { return curve[static_cast<std::size_t>(node)]; });
    return std::clamp(response, least_response, 1.0);
}

}  // namespace coagula::diagnose
