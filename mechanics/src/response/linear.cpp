// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/linear.hpp>

#include "bond_tangents.hpp"
#include "linear_solution.hpp"
#include "solvers/resisted_strains.hpp"

#include <coagula/common/contact_law.hpp>
#include <coagula/mechanics/orientation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace coagula::mechanics {

namespace {

constexpr std::array<std::pair<int, int>, 6> orientations{{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}};

/// Stiffness of every bond, and what the solver needs to know of it.
struct Springs {
    std::vector<ContactTangent> tangents;
    double normal = 0;  ///< means [N/m]
    double shear = 0;
    bool moments = false;   ///< some bond resists bending or twisting
    bool unstable = false;  ///< some bond has a negative stiffness

    explicit Springs(std::vector<ContactTangent> of_bonds) : tangents(std::move(of_bonds)) {
        const ContactTangent mean = mean_tangent(tangents);
        normal = mean.normal;
        shear = mean.shear;
        moments = resist_moments(tangents);
        unstable = may_be_unstable(tangents);
    }
};

Springs springs_of(const ContactNetwork& bonds, const LinearOptions& options) {
    if (!options.bond_tangents.empty()) {
        return Springs(options.bond_tangents);
    }
    require_positive(options.normal_stiffness, "the normal particle stiffness", "N/m");
    require_non_negative(options.shear_stiffness, "the shear particle stiffness", "N/m");
    const ContactTangent contact{.normal = stiffness_in_series(options.normal_stiffness, options.normal_stiffness),
                                 .shear = stiffness_in_series(options.shear_stiffness, options.shear_stiffness)};
    Springs springs(std::vector<ContactTangent>(static_cast<std::size_t>(bonds.size()), contact));
    springs.normal = contact.normal;  // also where nothing is bonded
    springs.shear = contact.shear;
    return springs;
}

void check(const Packing& packing, const ContactNetwork& bonds, const LinearOptions& options) {
    require(bonds.particles == packing.size(), "the bonds belong to a packing of " + std::to_string(bonds.particles) +
                                                   " particles, the packing has " + std::to_string(packing.size()));
    require_positive(options.tolerance, "the tolerance of the solver");
    require_positive(options.modulus_tolerance, "the tolerance of the moduli");
    require_between(options.shift, 0.0, 1e-3, "the shift of the preconditioner");
    if (!options.bond_tangents.empty()) {
        check_tangents(bonds, options.bond_tangents);
    }
    if (options.held.empty()) {
        require(packing.cell.is_periodic(), "the packing has a free surface: its outer particles must be held to be sheared");
        return;
    }
    require(options.held.size() == static_cast<std::size_t>(packing.size()),
            "the flags of the held particles must be one per particle");
    require_positive(options.volume, "the volume of the particles that are not held", "m^3");
}

void note(const SolvedNetwork& solved, LinearResponse& response) {
    response.solver_used = solved.solver;
    response.predicted_memory = solved.predicted_memory;
    response.floppy_modes = solved.floppy_modes;
    response.iterations = solved.iterations;
    response.residual = solved.residual;
    response.modulus_error = solved.modulus_error;
}

/// Half of every bond belongs to each of its ends; held particles lie outside the measured volume.
std::vector<double> bond_weights(const std::vector<LinearBond>& bonds) {
    std::vector<double> weights;
    weights.reserve(bonds.size());
    for (const LinearBond& bond : bonds) {
        weights.push_back((bond.first >= 0 ? 0.5 : 0.0) + (bond.second >= 0 ? 0.5 : 0.0));
    }
    return weights;
}

/// Writes the motion of the load-bearing particles into fields over all particles.
void store_motion(const Packing& packing, const LoadBearing& kept, const Loads& motion, bool periodic, LinearResponse& response) {
    const double r0 = mean_radius(packing);
    const auto count = static_cast<double>(std::max<std::size_t>(1, kept.particle.size()));
    for (int strain = 0; strain < 6; ++strain) {
        Eigen::Matrix3Xd displacement = Eigen::Matrix3Xd::Zero(3, packing.size());
        Eigen::Matrix3Xd rotation = displacement;
        Eigen::Vector3d drift = Eigen::Vector3d::Zero();
        for (std::size_t place = 0; place < kept.particle.size(); ++place) {
            const Eigen::Matrix<double, 6, 1> all = motion.block<6, 1>(6 * static_cast<Index>(place), strain);
            displacement.col(kept.particle[place]) = all.head<3>();
            rotation.col(kept.particle[place]) = all.tail<3>();
            drift += all.head<3>() / count;
        }
        for (const Index particle : kept.particle) {
            displacement.col(particle) -= periodic ? drift : Eigen::Vector3d::Zero();
        }
        response.non_affinity[strain] = std::sqrt(displacement.squaredNorm() / count);
        response.displacement.emplace_back(displacement * r0);
        response.rotation.push_back(std::move(rotation));
    }
}

/// Affine tensor over all bonds, those of rattlers included, times the volume, in reduced units.
Block affine_energy_of_all(const Packing& packing, const ContactNetwork& bonds, const Springs& springs,
                           const LinearOptions& options) {
    LoadBearing all;
    all.number.assign(static_cast<std::size_t>(packing.size()), -1);
    for (Index particle = 0; particle < packing.size(); ++particle) {
        if (options.held.empty() || !options.held[static_cast<std::size_t>(particle)]) {
            all.number[static_cast<std::size_t>(particle)] = static_cast<Index>(all.particle.size());
            all.particle.push_back(particle);
        }
    }
    all.bond.resize(static_cast<std::size_t>(bonds.size()));
    std::iota(all.bond.begin(), all.bond.end(), Index{0});
    const LinearNetwork network(packing, bonds, all, springs.tangents, springs.normal);
    return network.virial(Loads::Zero(6 * network.particles(), 6), bond_weights(network.bonds()));
}

/// A modulus that the network does not have is zero, and not what the solver left of it.
void clear_rounding(const Packing& packing, const ContactNetwork& bonds, LinearResponse& response) {
    std::array<bool, 6> resisted{};
    resisted.fill(true);
    if (packing.cell.is_periodic()) {
        resisted = resisted_strains(packing, bonds);
    }
    for (int strain = 0; strain < 6; ++strain) {
        const double affine = response.affine_tensor(strain, strain);
        resisted.at(static_cast<std::size_t>(strain)) &=
            std::abs(response.elastic_tensor(strain, strain)) > rounding_modulus * std::abs(affine);
    }
    clear_others(resisted, response.elastic_tensor);
}

}  // namespace

LinearResponse solve_linear(const Packing& packing, const ContactNetwork& bonds, const LinearOptions& options,
                            const Progress& progress) {
    check(packing, bonds, options);
    const Springs springs = springs_of(bonds, options);
    const bool periodic = options.held.empty();
    LoadBearing kept = find_load_bearing(bonds, options.held, springs.moments);
    sort_along_curve(kept, bonds, packing);
    const auto held = std::count(options.held.begin(), options.held.end(), true);

    LinearResponse response;
    response.bond_tangents = springs.tangents;
    response.contact_normal_stiffness = springs.normal;
    response.contact_shear_stiffness = springs.shear;
    response.contacts = bonds.size();
    response.rattlers = packing.size() - static_cast<Index>(kept.particle.size()) - held;
    const double r0 = mean_radius(packing);
    const double volume = periodic ? packing.cell.volume() : options.volume;
    const double scale = springs.normal * r0 * r0 / volume;
    response.affine_tensor = scale * affine_energy_of_all(packing, bonds, springs, options);
    response.elastic_tensor.setZero();

    Loads motion = Loads::Zero(6 * static_cast<Index>(kept.particle.size()), 6);
    if (kept.particle.empty()) {
        response.floppy_modes = 0;
    } else {
        const LinearNetwork network(packing, bonds, kept, springs.tangents, springs.normal);
        try {
            SolvedNetwork solved = solve_network(network, packing, kept, options, progress);
            note(solved, response);
            motion = std::move(solved.motion);
        } catch (const std::runtime_error& error) {
            if (!springs.unstable) {
                throw;
            }
            throw std::runtime_error(std::string("the bonded network is not stable under its prestress: ") + error.what());
        }
        response.floppy_modes -= periodic && response.floppy_modes >= 3 ? 3 : 0;  // rigid translation
        response.elastic_tensor =
            scale * (periodic ? network.energy(motion) : network.virial(motion, bond_weights(network.bonds())));
        clear_rounding(packing, bonds, response);
    }
    store_motion(packing, kept, motion, periodic, response);
    return response;
}

double LinearResponse::shear_modulus(int a, int b) const {
    require(a >= 0 && a < 3 && b >= 0 && b < 3 && a != b, "a shear orientation is named by two different axes of 0, 1, 2");
    const int place = ShearOrientation{a, b}.voigt();
    return elastic_tensor(place, place);
}

double LinearResponse::mean_shear_modulus() const {
    double sum = 0;
    for (const auto& [a, b] : orientations) {
        sum += shear_modulus(a, b);
    }
    return sum / 6;
}

double LinearResponse::shear_modulus_deviation() const {
    const double mean = mean_shear_modulus();
    double sum = 0;
    for (const auto& [a, b] : orientations) {
        sum += (shear_modulus(a, b) - mean) * (shear_modulus(a, b) - mean);
    }
    return std::sqrt(sum / 6);
}

double LinearResponse::mean_affine_modulus() const {
    return affine_tensor.diagonal().tail<3>().mean();
}

}  // namespace coagula::mechanics
