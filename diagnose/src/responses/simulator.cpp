#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_law.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/linear.hpp>

#include "cache_key.hpp"
#include "linear_grid.hpp"
#include "unit_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace coagula::diagnose {

namespace {

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

}  // namespace

Simulator::Simulator(std::vector<Packing> structures, std::vector<std::string> names, SimulationCache& cache,
                     const Progress& progress, std::vector<std::size_t> groups)
    : Simulator(Structures(std::move(structures)), std::move(names), cache, progress, std::move(groups), 0) {
    require(structures_.size() == names_.size(), "every structure must have a name");
    require(groups_.empty() || groups_.size() == structures_.size(), "every structure must belong to a group, or none");
    radius_ = structures_.size() > 0 ? mean_radius(structures_[0]) : 0;
}

Simulator::Simulator(Structures structures, std::vector<std::string> names, SimulationCache& cache, Progress progress,
                     std::vector<std::size_t> groups, double radius)
    : structures_(std::move(structures)),
      names_(std::move(names)),
      groups_(std::move(groups)),
      distinct_groups_(groups_.empty() ? std::set<std::size_t>{0} : std::set(groups_.begin(), groups_.end())),
      cache_(cache),
      progress_(std::move(progress)),
      radius_(radius) {}

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
    auto found = find_result(cache_, key, 4);
    if (found == cache_.end()) {
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
    const double modulus = between_nodes(
        settings, [&](double ratio, double bending, double tolerance) { return node(ratio, bending, tolerance, group); });
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
    for (const std::size_t group : distinct_groups_) {
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

}  // namespace coagula::diagnose
