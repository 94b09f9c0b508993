#include "thinned_contacts.hpp"

#include <coagula/common/random.hpp>
#include <coagula/diagnose/simulator.hpp>
#include <coagula/mechanics/linear.hpp>

#include "cache_key.hpp"
#include "interpolation.hpp"
#include "unit_stiffness.hpp"

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
/// Of all structures and random orders together: what one order takes from a small structure is chance.
constexpr double enough_particles = 1000;

/// 0 where the network is too close to losing its stiffness for the solver.
double modulus_of(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model, const Progress& progress) {
    mechanics::LinearOptions options;
    options.bond_tangents = mechanics::bond_tangents(packing, bonds, model);
    try {
        return mechanics::solve_linear(packing, bonds, options, progress).mean_shear_modulus();
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

/// Of one structure, for unit stiffness [Pa], mean over some random orders.
double Simulator::thinned_modulus(std::size_t structure, const Settings& settings, double missing) {
    const std::string key = key_of("thinned " + names_[structure],
                                   {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance, missing});
    if (const auto found = find_result(cache_, key, 1); found != cache_.end()) {
        return found->second.front();
    }
    progress_.update("simulating", 0.0, "linear modulus without some contacts");
    Settings part;
    part.normal_stiffness = unit_stiffness;
    part.stiffness_ratio = settings.stiffness_ratio;
    part.bending_ratio = settings.bending_ratio;
    const Packing& packing = structures_[structure];
    const ContactNetwork whole = find_contacts(packing, settings.bond_tolerance);
    const double all_particles = particles() * static_cast<double>(structures_.size());
    const auto orders = static_cast<std::uint64_t>(std::max(1.0, std::round(enough_particles / all_particles)));
    double sum = 0;
    for (std::uint64_t order = 0; order < orders; ++order) {
        sum += modulus_of(packing, thinned(whole, missing, order), contact_model_of(part, radius_), progress_);
    }
    const double modulus = sum / static_cast<double>(orders);
    cache_.insert_or_assign(key, std::vector<double>{modulus});
    return modulus;
}

double Simulator::exact_thinned_response(const Settings& settings, double missing, std::size_t group) {
    double sum = 0;
    double whole = 0;
    for (const std::size_t k : members(group)) {
        sum += thinned_modulus(k, settings, missing);
        whole += linear_moduli(k, settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance).front();
    }
    return whole > 0 ? std::max(sum / whole, least_response) : 1.0;
}

/// At the nodes; nothing comes back once nothing is left.
const std::vector<double>& Simulator::thinned_curve(std::size_t group) {
    std::vector<double>& curve = thinned_curves_[group];
    for (int node = static_cast<int>(curve.size()); node < missing_axis.count; ++node) {
        const bool gone = node > 0 && curve.back() <= least_response;
        curve.push_back(node == 0 ? 1.0 : gone ? least_response : exact_thinned_response({}, missing_axis.node(node), group));
    }
    return curve;
}

double Simulator::thinned_response(double missing, std::size_t group) {
    const std::vector<double>& curve = thinned_curve(group);
    const double response =
        interpolate_nodes(missing_axis, missing, [&](int node) { return curve[static_cast<std::size_t>(node)]; });
    return std::clamp(response, least_response, 1.0);
}

}  // namespace coagula::diagnose
