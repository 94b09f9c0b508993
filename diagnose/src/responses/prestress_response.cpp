// Linear modulus under a tension in all contacts: the linear solver with the geometric stiffness, at the nodes of a grid.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/linear.hpp>

#include "cache_key.hpp"
#include "interpolation.hpp"
#include "unit_stiffness.hpp"

namespace coagula::diagnose {

namespace {

constexpr Axis tension_axis{1e-4, 1e-2, 7};

}  // namespace

/// Of one structure, for unit stiffness [Pa].
double Simulator::prestressed_modulus(std::size_t structure, const Settings& settings) {
    const std::string key = key_of("prestress " + names_[structure],
                                   {settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance, settings.tension});
    if (const auto found = find_result(cache_, key, 1); found != cache_.end()) {
        return found->second.front();
    }
    progress_.update("simulating", 0.0, "linear modulus under tension");
    Settings part;
    part.normal_stiffness = unit_stiffness;
    part.stiffness_ratio = settings.stiffness_ratio;
    part.bending_ratio = settings.bending_ratio;
    part.tension = settings.tension;
    const Packing& packing = structures_[structure];
    const ContactNetwork bonds = find_contacts(packing, settings.bond_tolerance);
    mechanics::LinearOptions options;
    options.bond_tangents = mechanics::bond_tangents(packing, bonds, contact_model_of(part, radius_));
    const double modulus = mechanics::solve_linear(packing, bonds, options, progress_).mean_shear_modulus();
    cache_.insert_or_assign(key, std::vector<double>{modulus});
    return modulus;
}

double Simulator::exact_prestress_response(const Settings& settings, std::size_t group) {
    if (settings.tension <= 0) {
        return 1;
    }
    double sum = 0;
    double free = 0;
    for (const std::size_t k : members(group)) {
        sum += prestressed_modulus(k, settings);
        free += linear_moduli(k, settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance).front();
    }
    return free > 0 ? sum / free : 1.0;
}

double Simulator::prestress_response(const Settings& settings, std::size_t group) {
    if (settings.tension <= 0) {
        return 1;
    }
    return interpolate(tension_axis, settings.tension, [&](double tension) {
        Settings node;
        node.tension = tension;
        return exact_prestress_response(node, group);
    });
}

}  // namespace coagula::diagnose
