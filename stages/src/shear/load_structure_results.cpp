// SPDX-License-Identifier: GPL-3.0-or-later
#include "load_structure_results.hpp"

#include <algorithm>
#include <array>

namespace coagula::stages {

namespace {

using coagula::Cluster;
using mechanics::LoadStructure;
using mechanics::ShearLoad;

const std::string load_structure_group = "/mechanics/linear/load_structure/";
const std::array<std::string, 3> planes = {"yz", "xz", "xy"};  // as LoadStructure::shear

const std::string normal_force_meaning = "force along the bond per unit strain, positive where it is pulled";
const std::string backbone_meaning = "1 where the bond belongs to the backbone";

/// Data sets below one load_structure_group.
struct Group {
    Results& results;
    std::string path;

    void number(const std::string& name, double value, const std::string& unit, const std::string& description) const {
        results.push_back(io::scalar(path + name, value, unit, description));
    }
    void count(const std::string& name, Index value, const std::string& description) const {
        results.push_back(io::integer(path + name, value, description));
    }
    void flags(const std::string& name, const Eigen::Vector3i& values, const std::string& description) const {
        results.push_back(io::integers(path + name, values, description));
    }
    void fabric(const std::string& name, const Fabric& fabric, const std::string& description) const {
        results.push_back(io::matrix(path + name + "/tensor", fabric.tensor, "1", description));
        results.push_back(
            io::vector(path + name + "/eigenvalues", fabric.eigenvalues, "1", "eigenvalues of the fabric tensor, ascending"));
        number(name + "/anisotropy", fabric.anisotropy, "1", "sqrt(3/2) |deviator|: 0 isotropic, 1 all contacts parallel");
    }
};

Eigen::Vector3i flags_of(const Cluster& cluster) {
    return {cluster.percolates(0) ? 1 : 0, cluster.percolates(1) ? 1 : 0, cluster.percolates(2) ? 1 : 0};
}

double fraction(Index part, Index whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

double backbone_fraction(const ShearLoad& load) {
    return fraction(load.backbone.bonds, load.energy_share.size());
}

void append_backbone(const Group& at, const ShearLoad& load, bool periodic) {
    const mechanics::Backbone& backbone = load.backbone;
    at.count("backbone/bonds", backbone.bonds, "least number of bonds that store this share of the energy");
    at.number("backbone/bond_fraction", backbone_fraction(load), "1", "bonds of the backbone over all bonds");
    at.count("backbone/particles", backbone.particles, "particles with at least one such bond");
    at.number("backbone/particle_fraction", fraction(backbone.particles, load.particle_energy_share.size()), "1",
              "particles of the backbone over all particles");
    at.count("backbone/clusters", backbone.clusters, "connected parts of the backbone");
    at.count("backbone/largest_cluster", backbone.largest.particles, "particles of its largest part");
    if (periodic) {
        at.flags("backbone/percolates", flags_of(backbone.largest), "1 where that part reaches around the box along x, y, z");
    }
}

void append_forces(const Group& at, const ShearLoad& load) {
    const mechanics::ForceDistribution& forces = load.distribution;
    at.count("force_distribution/bonds", forces.bonds, "bonds that can carry load");
    at.number("force_distribution/mean", forces.mean, "N", "mean |normal force| of these per unit strain");
    at.number("force_distribution/bin_width", forces.bin_width, "1", "width of the bins of the density");
    at.results.push_back(io::vector(at.path + "force_distribution/density", forces.density, "1",
                                    "probability density of |normal force| over its mean, bins from 0 on"));
    at.number("force_distribution/beyond", forces.beyond, "1", "share of the bonds beyond the last bin");
    at.count("force_distribution/tail_bonds", forces.tail_bonds, "bonds with more than twice the mean");
    at.number("force_distribution/tail_slope", forces.tail_slope, "1",
              "b of exp(-b |f| / mean) above twice the mean; 0: fewer than ten bonds there");
    at.number("force_distribution/tail_slope_stderr", forces.tail_slope_error, "1", "standard error, as of independent forces");
    at.number("force_distribution/tail_variation", forces.tail_variation, "1",
              "standard deviation over mean of what exceeds twice the mean: 1 for an exponential");
}

void append_non_affinity(const Group& at, const std::string& name, const mechanics::NonAffinity& motion) {
    at.count(name + "particles", motion.particles, "load-bearing particles in this average");
    at.number(name + "mean_square", motion.mean_square, "1",
              "mean square displacement beyond the affine one over (mean radius times strain)^2");
    at.number(name + "median", motion.median, "1", "median of its length over mean radius times strain");
    at.number(name + "participation", motion.participation, "1", "(sum u^2)^2 / (n sum u^4); 0 when nothing moves");
}

void append_shear(const Group& at, const ShearLoad& load, bool periodic) {
    at.count("carried", load.carried ? 1 : 0, "1 where the modulus is not zero");
    at.number("energy", load.energy, "J", "elastic energy of all bonds per unit strain squared");
    at.number("shear_spring_share", load.shear_spring_share, "1", "share of the energy in the shear springs");
    const Eigen::Vector3d strongest(load.strongest_share[0], load.strongest_share[1], load.strongest_share[2]);
    at.results.push_back(io::vector(at.path + "strongest_share", strongest, "1",
                                    "share of the energy in the strongest 10, 20 and 50 % of the bonds"));
    at.fabric("force_fabric", load.force_fabric, "mean of n n^T over the bonds, weighted by |normal force|");
    append_forces(at, load);
    append_backbone(at, load, periodic);
    at.number("energy_participation", load.energy_participation, "1",
              "(sum e)^2 / (N sum e^2) of the particles' energies: share of the particles that take part");
    append_non_affinity(at, "nonaffinity/", load.non_affinity);
    append_non_affinity(at, "backbone/nonaffinity/", load.backbone_non_affinity);
}

/// Mean over the planes that carry shear; 0 when none does.
double mean(const LoadStructure& structure, double (*value)(const ShearLoad&)) {
    double sum = 0;
    double planes_that_carry = 0;
    for (const ShearLoad& load : structure.shear) {
        sum += load.carried ? value(load) : 0.0;
        planes_that_carry += load.carried ? 1 : 0;
    }
    return sum / std::max(1.0, planes_that_carry);
}

void append_means(const Group& at, const LoadStructure& structure) {
    const std::string of = "mean of the planes that carry shear";
    at.number("backbone_bond_fraction", mean(structure, backbone_fraction), "1", of);
    at.number("energy_participation", mean(structure, [](const ShearLoad& l) { return l.energy_participation; }), "1", of);
    at.number("backbone_nonaffinity_median", mean(structure, [](const ShearLoad& l) { return l.backbone_non_affinity.median; }),
              "1", of);
    at.number("backbone_nonaffine_participation",
              mean(structure, [](const ShearLoad& l) { return l.backbone_non_affinity.participation; }), "1", of);
    at.number("shear_spring_share", mean(structure, [](const ShearLoad& l) { return l.shear_spring_share; }), "1", of);
}

/// Seven digits: the bytes that are zero then cost nothing in the compressed file.
Eigen::VectorXd seven_digits(const Eigen::VectorXd& values) {
    return values.cast<float>().cast<double>();
}

Eigen::VectorXi backbone_flags(const ShearLoad& load) {
    Eigen::VectorXi flags(load.energy_share.size());
    std::copy(load.backbone.bond.begin(), load.backbone.bond.end(), flags.begin());
    return flags;
}

std::string part_in_percent(double share) {
    return with_unit(100 * share, "1") + " %";
}

std::string axes_of(const std::array<bool, 3>& percolates) {
    std::string axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        axes += percolates.at(axis) ? std::string(axes.empty() ? "" : ", ") + "xyz"[axis] : "";
    }
    return axes;
}

}  // namespace

Results load_structure_datasets(const LoadStructure& structure, bool periodic) {
    Results results;
    const Group top{results, load_structure_group};
    results.push_back(io::text(load_structure_group + "summary", structure.summary(), "whether shear is carried, and if not, why"));
    top.fabric("fabric", structure.fabric, "mean of n n^T over the bonds");
    top.count("clusters", structure.clusters, "connected clusters of bonded particles");
    top.count("largest_cluster", structure.largest_cluster, "particles of the largest cluster");
    if (periodic) {
        const auto& percolates = structure.percolates;
        top.flags("percolates", {percolates[0] ? 1 : 0, percolates[1] ? 1 : 0, percolates[2] ? 1 : 0},
                  "1 where a cluster of bonds reaches around the box along x, y, z");
    }
    top.number("backbone_energy", structure.backbone_energy, "1", "share of the elastic energy that the backbone stores");
    append_means({results, load_structure_group + "mean/"}, structure);
    for (std::size_t plane = planes.size(); plane-- > 0;) {
        append_shear({results, load_structure_group + planes.at(plane) + "/"}, structure.shear.at(plane), periodic);
    }
    return results;
}

Results bond_datasets(const LoadStructure& structure) {
    Results results;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        const ShearLoad& load = structure.shear.at(plane);
        if (load.energy_share.size() == 0) {
            continue;
        }
        const std::string path = load_structure_group + planes.at(plane) + "/bonds/";
        results.push_back(io::vector(path + "normal_force", seven_digits(load.normal_force), "N", normal_force_meaning));
        results.push_back(io::vector(path + "shear_force", seven_digits(load.shear_force), "N",
                                     "magnitude of the force across the bond per unit strain"));
        results.push_back(io::vector(path + "energy_share", seven_digits(load.energy_share), "1", "share of the elastic energy"));
        results.push_back(io::integers(path + "backbone", backbone_flags(load), backbone_meaning));
    }
    return results;
}

std::vector<io::BondField> load_structure_bond_fields(const LoadStructure& structure) {
    std::vector<io::BondField> fields;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        const ShearLoad& load = structure.shear.at(plane);
        fields.push_back({"normal_force_" + planes.at(plane), load.normal_force, "N", normal_force_meaning});
        fields.push_back({"backbone_" + planes.at(plane), backbone_flags(load).cast<double>(), "1", backbone_meaning});
    }
    return fields;
}

std::vector<io::ParticleField> load_structure_fields(const LoadStructure& structure) {
    std::vector<io::ParticleField> fields;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        const ShearLoad& load = structure.shear.at(plane);
        fields.push_back({"energy_share_" + planes.at(plane), seven_digits(load.particle_energy_share).transpose(), "1",
                          "share of the elastic energy under shear " + planes.at(plane) + ", half of each bond's to each end"});
        fields.push_back(
            {"nonaffinity_" + planes.at(plane), seven_digits(load.particle_non_affinity).transpose(), "1",
             "displacement beyond the affine one per unit shear strain " + planes.at(plane) + " over the mean radius"});
    }
    return fields;
}

Table load_structure_table(const LoadStructure& structure) {
    const auto carried = [](const ShearLoad& load) { return load.carried; };
    Table table;
    if (!std::all_of(structure.shear.begin(), structure.shear.end(), carried)) {
        table.emplace_back("load", structure.summary());
    }
    if (std::any_of(structure.shear.begin(), structure.shear.end(), carried)) {
        const std::string axes = axes_of(structure.percolates);
        table.emplace_back("backbone", part_in_percent(mean(structure, backbone_fraction)) + " of the bonds store " +
                                           part_in_percent(structure.backbone_energy) + " of the energy" +
                                           (axes.empty() ? "" : "; the bonds reach around the box along " + axes));
        table.emplace_back("participation",
                           part_in_percent(mean(structure, [](const ShearLoad& l) { return l.energy_participation; })) +
                               " of the particles in the energy; median non-affine displacement " +
                               with_unit(mean(structure, [](const ShearLoad& l) { return l.backbone_non_affinity.median; }), "1") +
                               " r0 times strain");
    }
    return table;
}

}  // namespace coagula::stages
