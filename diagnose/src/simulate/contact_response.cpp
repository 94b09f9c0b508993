// Amplitude response of Hertz contacts: equilibrium at the nodes of a grid of strains by secant stiffnesses.
#include <coagula/diagnose/model.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/mechanics/linear.hpp>

#include "cache_key.hpp"
#include "interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

/// Strain over the overlap at rest (over r0).
constexpr Axis load_axis{0.05, 500, 9};
constexpr double converged = 1e-4;
constexpr int most_iterations = 60;
constexpr int phases_of_quarter = 24;  ///< of a quarter of an oscillation

/// Elongation of every bond by a unit shear strain (engineering, y-z) with the displacements found for it [m].
Eigen::VectorXd overlaps_per_strain(const ContactNetwork& bonds, const Eigen::Matrix3Xd& displacement) {
    Eigen::VectorXd overlap(bonds.size());
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const Eigen::Vector3d branch = bonds.branch.col(bond);
        Eigen::Vector3d moved = displacement.col(bonds.ends(1, bond)) - displacement.col(bonds.ends(0, bond));
        moved += 0.5 * Eigen::Vector3d(0, branch.z(), branch.y());
        overlap[bond] = -moved.dot(branch) / branch.norm();
    }
    return overlap;
}

/// Secant stiffness of a bond whose overlap changed by `change` from that at rest, where another force balances it. Mindlin's shear
/// stiffness grows on the way as the normal one does, so that their secants keep the ratio.
ContactTangent secant(const GeneralContact& law, double rest_overlap, double change, double effective_radius) {
    const NormalResponse rest = law.normal(rest_overlap, effective_radius, true);
    const bool moved = std::abs(change) > 1e-9 * rest_overlap;
    const double force = law.normal(rest_overlap + change, effective_radius, true).force;
    const double normal = moved ? (force - rest.force) / change : rest.stiffness;
    return {.normal = normal, .shear = normal * rest.shear_stiffness / rest.stiffness};
}

}  // namespace

/// Stress over strain of Hertz contacts at one load over that of linear springs as stiff at rest.
double Simulator::secant_modulus(std::size_t structure, double load) {
    const std::string key = key_of("hertz " + names_[structure], {load});
    if (const auto found = find_result(cache_, key, 1); found != cache_.end()) {
        return found->second.front();
    }
    progress_.update("simulating", 0.0, "Hertz contacts");
    constexpr double preload = 1e-4;  // only the load counts
    Settings settings;
    settings.contact_preload = preload;
    const GeneralContact law(contact_model_of(settings, radius_));
    const Packing& packing = structures_[structure];
    const ContactNetwork bonds = find_contacts(packing, settings.bond_tolerance);
    const double strain = load * preload;
    mechanics::LinearOptions options;
    options.bond_tangents.resize(static_cast<std::size_t>(bonds.size()));
    Eigen::VectorXd change = Eigen::VectorXd::Zero(bonds.size());
    double modulus = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        for (Index bond = 0; bond < bonds.size(); ++bond) {
            const double first = packing.radii[bonds.ends(0, bond)];
            const double second = packing.radii[bonds.ends(1, bond)];
            options.bond_tangents[static_cast<std::size_t>(bond)] =
                secant(law, preload * radius_, change[bond], first * second / (first + second));
        }
        const mechanics::LinearResponse response = mechanics::solve_linear(packing, bonds, options, progress_);
        change = strain * overlaps_per_strain(bonds, response.displacement[3]);
        const double before = std::exchange(modulus, response.elastic_tensor(3, 3));
        if (modulus <= 0 || std::abs(modulus - before) < converged * modulus) {
            break;
        }
    }
    mechanics::LinearOptions springs;
    const double linear = mechanics::solve_linear(packing, bonds, springs, progress_).elastic_tensor(3, 3);
    const double ratio = linear > 0 ? modulus / linear : 1.0;
    cache_.insert_or_assign(key, std::vector<double>{ratio});
    return ratio;
}

/// The same at the nodes, mean over the structures.
const std::vector<double>& Simulator::secant_curve() {
    for (int node = static_cast<int>(secant_curve_.size()); node < load_axis.count; ++node) {
        double sum = 0;
        for (std::size_t structure = 0; structure < structures_.size(); ++structure) {
            sum += secant_modulus(structure, load_axis.node(node));
        }
        secant_curve_.push_back(sum / static_cast<double>(structures_.size()));
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
        std::exp(interpolate_nodes(load_axis, load, [&](int node) { return std::log(curve[static_cast<std::size_t>(node)]); }));
    return load > load_axis.high ? secant * std::sqrt(load / load_axis.high) : secant;
}

double Simulator::contact_response(const Settings& settings, double amplitude) {
    if (settings.contact_preload <= 0) {
        return 1;
    }
    // Fundamental of the stress: 4/pi times the integral of G(gamma_0 sin x) sin^2 x over a quarter.
    double sum = 0;
    for (int k = 0; k < phases_of_quarter; ++k) {
        const double sine = std::sin(0.5 * std::numbers::pi * (k + 0.5) / phases_of_quarter);
        sum += 2.0 / phases_of_quarter * sine * sine * contact_secant(settings, amplitude * sine);
    }
    return sum;
}

}  // namespace coagula::diagnose
