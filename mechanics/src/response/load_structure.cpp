// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/load_structure.hpp>

#include "bond_tangents.hpp"
#include "solvers/load_bearing.hpp"
#include "solvers/resisted_strains.hpp"
#include "solvers/stiffness.hpp"

#include <coagula/common/parallel.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace coagula::mechanics {

namespace {

constexpr double no_motion = 1e-8;         // rms displacement per unit strain over the mean radius: rounding errors
constexpr double rounding_energy = 1e-16;  // share of the energy below which forces are rounding errors
constexpr double histogram_width = 0.25;   // of |f_n| over its mean
constexpr Index histogram_bins = 40;
constexpr double tail_start = 2;  // of |f_n| over its mean
constexpr Index fewest_for_tail = 10;
constexpr int first_shear = 3;  // Voigt index of yz
constexpr std::array<std::pair<int, int>, 3> planes{{{1, 2}, {0, 2}, {0, 1}}};
constexpr std::array<const char*, 3> plane_names{"yz", "xz", "xy"};
constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

void check(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& response,
           const LoadStructureOptions& options) {
    require(bonds.particles == packing.size(), "the bonds belong to a packing of " + std::to_string(bonds.particles) +
                                                   " particles, the packing has " + std::to_string(packing.size()));
    require_between(options.backbone_energy, 0.0, 1.0, "the share of the energy that the backbone stores");
    require(options.held.empty() || options.held.size() == static_cast<std::size_t>(packing.size()),
            "the flags of the held particles must be one per particle");
    require(packing.cell.is_periodic() || !options.held.empty(),
            "the packing has a free surface: say which of its particles were held");
    require(response.bond_tangents.size() == static_cast<std::size_t>(bonds.size()), "the response belongs to other bonds");
    require(response.displacement.size() == 6 && response.rotation.size() == 6, "the response has no displacements");
    for (std::size_t strain = first_shear; strain < 6; ++strain) {
        require(response.displacement[strain].cols() == packing.size() && response.rotation[strain].cols() == packing.size(),
                "the response belongs to another packing");
    }
}

/// (sum w)^2 / (count sum w^2): the share of `count` that would hold the same in equal parts.
double participation_ratio(const Eigen::VectorXd& weight, Index count) {
    const double square = static_cast<double>(count) * weight.squaredNorm();
    return square > 0 ? weight.sum() * weight.sum() / square : 0.0;
}

/// Slope of an exponential tail by maximum likelihood: the inverse of the mean excess.
void fit_tail(const std::vector<double>& excess, ForceDistribution& distribution) {
    distribution.tail_bonds = static_cast<Index>(excess.size());
    const auto count = static_cast<double>(excess.size());
    const double mean = std::accumulate(excess.begin(), excess.end(), 0.0) / std::max(1.0, count);
    if (distribution.tail_bonds < fewest_for_tail || mean <= 0) {
        return;
    }
    double square = 0;
    for (const double value : excess) {
        square += (value - mean) * (value - mean);
    }
    distribution.tail_slope = 1 / mean;
    distribution.tail_slope_error = distribution.tail_slope / std::sqrt(count);
    distribution.tail_variation = std::sqrt(square / (count - 1)) / mean;
}

/// Bonds by energy, strongest first; of equals the one that comes first.
std::vector<Index> by_energy(const Eigen::VectorXd& energy) {
    std::vector<Index> order(static_cast<std::size_t>(energy.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return energy[a] != energy[b] ? energy[a] > energy[b] : a < b; });
    return order;
}

double share_of_strongest(const Eigen::VectorXd& share, const std::vector<Index>& order, double fraction) {
    const auto count = static_cast<std::ptrdiff_t>(std::llround(fraction * static_cast<double>(order.size())));
    return std::accumulate(order.begin(), order.begin() + count, 0.0, [&](double sum, Index bond) { return sum + share[bond]; });
}

Backbone backbone_of(const Packing& packing, const ContactNetwork& bonds, const Eigen::VectorXd& share,
                     const std::vector<Index>& order, double energy) {
    Backbone backbone;
    backbone.bond.assign(order.size(), false);
    double stored = 0;
    for (auto bond = order.begin(); bond != order.end() && stored < energy && share[*bond] > 0; ++bond) {
        stored += share[*bond];
        backbone.bond[static_cast<std::size_t>(*bond)] = true;
        ++backbone.bonds;
    }
    const std::vector<Cluster> clusters = find_clusters(packing, bonds, backbone.bond);
    backbone.clusters = static_cast<Index>(clusters.size());
    for (const Cluster& cluster : clusters) {
        backbone.particles += cluster.particles;
    }
    if (!clusters.empty()) {
        backbone.largest = clusters.front();
    }
    return backbone;
}

/// The upper one of an even number.
double median_of(const Eigen::VectorXd& values) {
    std::vector<double> sorted(values.begin(), values.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

/// @param length of the displacement of each particle that counts.
NonAffinity non_affinity_of(const Eigen::VectorXd& length) {
    NonAffinity result;
    result.particles = length.size();
    if (length.size() == 0) {
        return result;
    }
    const Eigen::VectorXd square = length.array().square();
    result.mean_square = square.mean();
    if (result.mean_square > no_motion * no_motion) {
        result.participation = participation_ratio(square, length.size());
    }
    result.median = median_of(length);
    return result;
}

/// The network of one packing, for all three shears.
class Analysis {
public:
    Analysis(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& response,
             const LoadStructureOptions& options)
        : packing_(packing),
          bonds_(bonds),
          response_(response),
          options_(options),
          kept_(find_load_bearing(bonds, options.held, resist_moments(response.bond_tangents))),
          geometry_(LinearNetwork(packing, bonds, kept_, response.bond_tangents, response.contact_normal_stiffness).bonds()),
          clusters_(find_clusters(packing, bonds)),
          r0_(mean_radius(packing)) {
        for (std::size_t k = 0; k < geometry_.size(); ++k) {
            if (geometry_[k].first >= 0 || geometry_[k].second >= 0) {  // not held at both ends
                bearing_.push_back(kept_.bond[k]);
            }
        }
    }

    LoadStructure run() const {
        LoadStructure structure;
        structure.backbone_energy = options_.backbone_energy;
        structure.fabric = find_fabric(bonds_, Eigen::VectorXd::Ones(bonds_.size()));
        structure.clusters = static_cast<Index>(clusters_.size());
        structure.largest_cluster = clusters_.empty() ? 0 : clusters_.front().particles;
        for (int axis = 0; axis < 3; ++axis) {
            structure.percolates.at(static_cast<std::size_t>(axis)) = percolates(axis);
        }
        for (std::size_t plane = 0; plane < planes.size(); ++plane) {
            structure.shear.at(plane) = shear(plane);
        }
        return structure;
    }

private:
    bool percolates(int axis) const {
        return std::any_of(clusters_.begin(), clusters_.end(), [axis](const Cluster& c) { return c.percolates(axis); });
    }

    ShearLoad shear(std::size_t plane) const {
        const auto strain = static_cast<Index>(first_shear + plane);
        ShearLoad load;
        load.carried = response_.elastic_tensor(strain, strain) > rounding_modulus * response_.affine_tensor(strain, strain);
        load.force = Eigen::Matrix3Xd::Zero(3, bonds_.size());
        load.normal_force = load.shear_force = load.energy_share = Eigen::VectorXd::Zero(bonds_.size());
        if (load.carried) {
            find_forces(strain, load);
        } else {
            load.reason = why_nothing_is_carried(planes.at(plane));
        }
        const std::vector<Index> order = by_energy(load.energy_share);
        load.strongest_share = {share_of_strongest(load.energy_share, order, 0.1),
                                share_of_strongest(load.energy_share, order, 0.2),
                                share_of_strongest(load.energy_share, order, 0.5)};
        load.force_fabric = find_fabric(bonds_, load.normal_force.cwiseAbs());
        load.distribution = distribution_of_forces(load.normal_force(bearing_));
        load.backbone = backbone_of(packing_, bonds_, load.energy_share, order, options_.backbone_energy);
        share_among_particles(load);
        find_non_affinity(strain, load);
        return load;
    }

    /// Deformation of a bond over the mean radius.
    Deformations<1> deformation(const LinearBond& bond, Index first, Index second, Index strain) const {
        const Eigen::Matrix3Xd& u = response_.displacement[static_cast<std::size_t>(strain)];
        const Eigen::Matrix3Xd& theta = response_.rotation[static_cast<std::size_t>(strain)];
        const Eigen::Vector3d rolling = bond.first_arm * theta.col(first) + bond.second_arm * theta.col(second);
        const Eigen::Vector3d moved = (u.col(second) - u.col(first)) / r0_ + affine_displacements(bond.branch).col(strain);
        Deformations<1> result;
        result << moved - rolling.cross(bond.normal), theta.col(second) - theta.col(first), moved;
        return result;
    }

    void find_forces(Index strain, ShearLoad& load) const {
        const auto count = static_cast<Index>(geometry_.size());
        const double per_length = response_.contact_normal_stiffness * r0_;
        Eigen::VectorXd normal_energy = Eigen::VectorXd::Zero(bonds_.size());
        Eigen::VectorXd shear_energy = normal_energy;
#pragma omp parallel for schedule(static) if (worth_threads(count, 200))
        for (Index k = 0; k < count; ++k) {
            const LinearBond& bond = geometry_[static_cast<std::size_t>(k)];
            if (bond.first < 0 && bond.second < 0) {
                continue;
            }
            const Index which = kept_.bond[static_cast<std::size_t>(k)];
            const Deformations<1> all = deformation(bond, bonds_.ends(0, which), bonds_.ends(1, which), strain);
            const Deformations<1> stress = stresses(bond, all);
            const Eigen::Vector3d force = per_length * (stress.head<3>() + stress.tail<3>());
            load.force.col(which) = force;
            load.normal_force[which] = force.dot(bond.normal);
            load.shear_force[which] = (force - load.normal_force[which] * bond.normal).norm();
            load.energy_share[which] = 0.5 * per_length * r0_ * all.dot(stress);
            normal_energy[which] = 0.5 * per_length * r0_ * all.head<3>().dot(bond.normal) * stress.head<3>().dot(bond.normal);
            shear_energy[which] = 0.5 * per_length * r0_ * all.head<3>().dot(stress.head<3>()) - normal_energy[which];
        }
        load.energy = load.energy_share.sum();
        load.energy_share /= load.energy;
        load.shear_spring_share = std::max(0.0, shear_energy.sum() / load.energy);
        if (normal_energy.sum() < rounding_energy * load.energy) {
            load.normal_force.setZero();
        }
    }

    void share_among_particles(ShearLoad& load) const {
        load.particle_energy_share = Eigen::VectorXd::Zero(packing_.size());
        for (Index bond = 0; bond < bonds_.size(); ++bond) {
            load.particle_energy_share[bonds_.ends(0, bond)] += 0.5 * load.energy_share[bond];
            load.particle_energy_share[bonds_.ends(1, bond)] += 0.5 * load.energy_share[bond];
        }
        load.energy_participation = participation_ratio(load.particle_energy_share, packing_.size());
    }

    /// Displacement of every particle over the mean radius. A periodic network may translate as a whole, so displacements are taken
    /// relative to the median of each component. The mean would follow the few particles that move by thousands.
    Eigen::VectorXd displacement_lengths(Index strain) const {
        const Eigen::Matrix3Xd& u = response_.displacement[static_cast<std::size_t>(strain)];
        Eigen::Vector3d common = Eigen::Vector3d::Zero();
        for (int axis = 0; axis < 3 && options_.held.empty() && !kept_.particle.empty(); ++axis) {
            common[axis] = median_of(u.row(axis)(kept_.particle).transpose());
        }
        Eigen::VectorXd length = Eigen::VectorXd::Zero(packing_.size());
        for (const Index particle : kept_.particle) {
            length[particle] = (u.col(particle) - common).norm() / r0_;
        }
        return length;
    }

    void find_non_affinity(Index strain, ShearLoad& load) const {
        load.particle_non_affinity = displacement_lengths(strain);
        load.non_affinity = non_affinity_of(load.particle_non_affinity(kept_.particle));
        std::vector<bool> in_backbone(static_cast<std::size_t>(packing_.size()), false);
        for (Index bond = 0; bond < bonds_.size(); ++bond) {
            for (int end = 0; end < 2 && load.backbone.bond[static_cast<std::size_t>(bond)]; ++end) {
                in_backbone[static_cast<std::size_t>(bonds_.ends(end, bond))] = true;
            }
        }
        std::vector<Index> moving;
        std::copy_if(kept_.particle.begin(), kept_.particle.end(), std::back_inserter(moving),
                     [&](Index particle) { return in_backbone[static_cast<std::size_t>(particle)]; });
        load.backbone_non_affinity = non_affinity_of(load.particle_non_affinity(moving));
    }

    /// A cluster stores energy under a shear of plane (a, b) only if it reaches around the box along a and along b: otherwise its
    /// particles follow a simple shear and a rotation that leave all its bonds unstrained.
    std::string why_nothing_is_carried(const std::pair<int, int>& plane) const {
        if (bonds_.size() == 0) {
            return "no two particles are bonded";
        }
        if (!packing_.cell.is_periodic()) {
            return "the bonds of the particles that are not held are too few to be rigid";
        }
        const std::string a = axis_names.at(static_cast<std::size_t>(plane.first));
        const std::string b = axis_names.at(static_cast<std::size_t>(plane.second));
        const std::string open = "the bonded network does not reach around the box along ";
        if (!percolates(plane.first)) {
            return open + a + (percolates(plane.second) ? "" : " and " + b);
        }
        if (!percolates(plane.second)) {
            return open + b;
        }
        const bool together = std::any_of(clusters_.begin(), clusters_.end(), [&](const Cluster& cluster) {
            return cluster.percolates(plane.first) && cluster.percolates(plane.second);
        });
        return together ? "the bonded network reaches around the box, but its bonds are too few, or have no shear stiffness, to "
                          "make it rigid"
                        : "no connected part of the bonded network reaches around the box along both " + a + " and " + b;
    }

    const Packing& packing_;
    const ContactNetwork& bonds_;
    const LinearResponse& response_;
    const LoadStructureOptions& options_;
    LoadBearing kept_;
    std::vector<LinearBond> geometry_;  ///< of kept_.bond
    std::vector<Cluster> clusters_;
    double r0_;
    std::vector<Index> bearing_;  ///< bonds that can carry load
};

}  // namespace

ForceDistribution distribution_of_forces(const Eigen::VectorXd& normal_force) {
    ForceDistribution distribution;
    distribution.bonds = normal_force.size();
    distribution.bin_width = histogram_width;
    distribution.density = Eigen::VectorXd::Zero(histogram_bins);
    const double sum = normal_force.cwiseAbs().sum();
    if (!(sum > 0)) {
        return distribution;
    }
    const auto count = static_cast<double>(normal_force.size());
    distribution.mean = sum / count;
    std::vector<double> excess;
    for (const double signed_force : normal_force) {
        const double force = std::abs(signed_force) / distribution.mean;
        if (force < histogram_width * static_cast<double>(histogram_bins)) {
            distribution.density[static_cast<Index>(force / histogram_width)] += 1 / (count * histogram_width);
        } else {
            distribution.beyond += 1 / count;
        }
        if (force > tail_start) {
            excess.push_back(force - tail_start);
        }
    }
    fit_tail(excess, distribution);
    return distribution;
}

LoadStructure find_load_structure(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& response,
                                  const LoadStructureOptions& options) {
    check(packing, bonds, response, options);
    return Analysis(packing, bonds, response, options).run();
}

std::string LoadStructure::summary() const {
    std::vector<std::pair<std::string, std::string>> failures;  // reason, planes
    for (std::size_t plane = shear.size(); plane-- > 0;) {
        if (shear.at(plane).carried) {
            continue;
        }
        const std::string& reason = shear.at(plane).reason;
        const auto same = std::find_if(failures.begin(), failures.end(), [&](const auto& f) { return f.first == reason; });
        if (same == failures.end()) {
            failures.emplace_back(reason, plane_names.at(plane));
        } else {
            same->second += std::string(", ") + plane_names.at(plane);
        }
    }
    std::string text;
    for (const auto& [reason, names] : failures) {
        text += (text.empty() ? "G' = 0 in " : "; in ") + names + ": " + reason;
    }
    return text.empty() ? "shear is carried in xy, xz, yz" : text;
}

}  // namespace coagula::mechanics
