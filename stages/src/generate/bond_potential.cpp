// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/bond_potential.hpp>

#include <coagula/generators/depletion.hpp>
#include <coagula/io/structure_file.hpp>

namespace coagula::stages {

namespace {

double value_in(const Results& results, const std::string& name) {
    for (const io::Dataset& dataset : results) {
        const auto* numbers = std::get_if<std::vector<double>>(&dataset.values);
        if (numbers != nullptr && numbers->size() == 1 && dataset.path == bond_potential_group + "/" + name) {
            return numbers->front();
        }
    }
    return unset;
}

}  // namespace

Findings bond_findings(const generators::PairPotential& potential, double radius, double temperature, double attraction_range) {
    const generators::Extreme bottom = potential.contact_minimum();
    const double bond_range = bottom.gap + attraction_range;
    const double tolerance = bond_range / (2 * radius);
    const double depth = -bottom.energy / (generators::boltzmann_constant * temperature);
    const generators::BoundPair bond = generators::bound_pair(potential, radius, temperature, bond_range);
    const std::string group = bond_potential_group + "/";
    return {.group = bond_potential_group,
            .results =
                {io::scalar(group + "attraction_range", attraction_range, "m", "gap beyond that at rest where the attraction ends"),
                 io::scalar(group + "bond_tolerance", tolerance, "1", "pairs nearer than (1 + x) (r_i + r_j) attract each other"),
                 io::scalar(group + "bond_stiffness", bond.stiffness, "N/m", "curvature of the energy at the bottom of the well"),
                 io::scalar(group + "thermal_bond_stiffness", bond.thermal_stiffness, "N/m",
                            "kB T over the variance of the distance of a bound pair"),
                 io::scalar(group + "rupture_force", bond.rupture_force, "N", "largest attraction of two particles")},
            .table = {{"attraction", with_unit(depth, "kT") + " deep, felt within " + with_unit(1 + tolerance, "1") +
                                         " diameters; largest force " + with_unit(bond.rupture_force, "N")},
                      {"bond stiffness", with_unit(bond.stiffness, "N/m") + " by the curvature of the well, " +
                                             with_unit(bond.thermal_stiffness, "N/m") + " by thermal motion"}}};
}

std::optional<BondPotential> bond_potential_in(const Results& results) {
    const BondPotential found{.stiffness = value_in(results, "bond_stiffness"),
                              .thermal_stiffness = value_in(results, "thermal_bond_stiffness"),
                              .tolerance = value_in(results, "bond_tolerance")};
    const bool whole = found.stiffness > 0 && found.thermal_stiffness > 0 && found.tolerance >= 0;
    return whole ? std::optional(found) : std::nullopt;
}

std::optional<BondPotential> bond_potential_of(const std::string& path) {
    return bond_potential_in(io::read_results(path, bond_potential_group));
}

}  // namespace coagula::stages
