// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/load_structure.hpp>

#include "networks.hpp"
#include "solvers/stiffness.hpp"
#include "support/lattices.hpp"

#include <omp.h>
#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace coagula::mechanics {
namespace {

using namespace coagula::testing;

constexpr double kn = 50;  // contact values for the default particle stiffnesses 100 and 10 N/m
constexpr double ks = 5;
constexpr std::size_t xy = 2;  // place in LoadStructure::shear

LoadStructure analyse(const Packing& packing, const ContactNetwork& bonds, const LoadStructureOptions& options = {}) {
    return find_load_structure(packing, bonds, solve_linear(packing, bonds), options);
}

/// Two straight chains along the diagonal of the xy plane, in layers of their own, of 4 and 8 bonds between spheres of unlike size.
struct TwoChains {
    double edge = 0;
    Packing packing;
    ContactNetwork bonds;

    TwoChains() {
        const std::vector<double> radii{1.0, 1.4, 0.8, 1.2, 0.5, 0.6, 0.55, 0.45, 0.5, 0.65, 0.6, 0.55};  // 4.4 each chain
        edge = 2 * 4.4 / std::sqrt(2.0);
        packing.cell = Cell::periodic(Eigen::Vector3d::Constant(edge));
        packing.radii = Eigen::Map<const Eigen::VectorXd>(radii.data(), 12);
        packing.positions.resize(3, 12);
        place_chain(0, 4, 0.2 * edge);
        place_chain(4, 8, 0.7 * edge);
        bonds = bonds_between(packing,
                              {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {4, 5}, {5, 6}, {6, 7}, {7, 8}, {8, 9}, {9, 10}, {10, 11}, {4, 11}});
    }

    void place_chain(Index first, Index count, double z) {
        double along = packing.radii[first];
        for (Index i = first; i < first + count; ++i) {
            along += i > first ? packing.radii[i - 1] + packing.radii[i] : 0.0;
            packing.positions.col(i) = packing.cell.wrap(Eigen::Vector3d(along / std::sqrt(2.0), along / std::sqrt(2.0), z));
        }
    }
};

// Springs in series carry the same force whatever their length: a chain of n bonds across the diagonal edge sqrt(2) is drawn out by
// edge / sqrt(2) per unit strain, so f = k_n edge / (sqrt(2) n) and it stores half of that times the elongation.
TEST(LoadStructure, ChainsOfSpringsInSeries) {
    const TwoChains chains;
    const LoadStructure structure = analyse(chains.packing, chains.bonds, {.backbone_energy = 0.6, .held = {}});
    const ShearLoad& load = structure.shear[xy];
    ASSERT_TRUE(load.carried);
    const double elongation = chains.edge / std::sqrt(2.0);
    for (Index bond = 0; bond < 12; ++bond) {
        const double links = bond < 4 ? 4 : 8;
        EXPECT_NEAR(load.normal_force[bond], kn * elongation / links, 1e-7 * kn * elongation);
        EXPECT_NEAR(load.shear_force[bond], 0, 1e-7 * kn * elongation);
        EXPECT_NEAR(load.energy_share[bond], bond < 4 ? 1.0 / 6 : 1.0 / 24, 1e-8);
    }
    EXPECT_NEAR(load.energy, 0.5 * kn * elongation * elongation * (1.0 / 4 + 1.0 / 8), 1e-8 * load.energy);
    EXPECT_NEAR(load.shear_spring_share, 0, 1e-8);
    EXPECT_NEAR(load.strongest_share[0], 1.0 / 6, 1e-8);             // 1.2 bonds are one
    EXPECT_NEAR(load.strongest_share[2], 4.0 / 6 + 2.0 / 24, 1e-8);  // six bonds
    // Participation of 12 particles: 4 hold 1/6, 8 hold 1/24.
    EXPECT_NEAR(load.energy_participation, 1 / (12 * (4.0 / 36 + 8.0 / 576)), 1e-8);
    // Fabric: all bonds along (1, 1, 0) / sqrt(2).
    EXPECT_NEAR(structure.fabric.anisotropy, 1, 1e-12);
    EXPECT_NEAR(structure.fabric.tensor(0, 1), 0.5, 1e-12);

    EXPECT_EQ(load.backbone.bonds, 4);
    EXPECT_EQ(load.backbone.particles, 4);
    EXPECT_EQ(load.backbone.clusters, 1);
    EXPECT_EQ(std::accumulate(load.backbone.bond.begin(), load.backbone.bond.begin() + 4, 0), 4);
    EXPECT_TRUE(load.backbone.largest.percolates(0) && load.backbone.largest.percolates(1));
    EXPECT_FALSE(load.backbone.largest.percolates(2));
}

// Along a chain, every bond is drawn out by the same amount instead of in proportion to its length.
TEST(LoadStructure, NonAffineMotionOfAChain) {
    const TwoChains chains;
    const LinearResponse response = solve_linear(chains.packing, chains.bonds);
    const LoadStructure structure = find_load_structure(chains.packing, chains.bonds, response);
    const Eigen::Vector3d along = Eigen::Vector3d(1, 1, 0).normalized();
    const double average = chains.edge / std::sqrt(2.0) / 4;
    for (Index bond = 0; bond < 3; ++bond) {
        const double step = (response.displacement[5].col(bond + 1) - response.displacement[5].col(bond)).dot(along);
        EXPECT_NEAR(step, average - 0.5 * chains.bonds.branch.col(bond).norm(), 1e-7);
    }
    const Eigen::Matrix3Xd& u = response.displacement[5];
    Eigen::Vector3d median;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> component(12);
        Eigen::Map<Eigen::VectorXd>(component.data(), 12) = u.row(axis);
        std::sort(component.begin(), component.end());
        median[axis] = component[6];
    }
    const Eigen::VectorXd expected = (u.colwise() - median).colwise().norm().transpose() / mean_radius(chains.packing);
    EXPECT_LT((structure.shear[xy].particle_non_affinity - expected).norm(), 1e-12);
    EXPECT_NEAR(structure.shear[xy].non_affinity.mean_square, expected.squaredNorm() / 12, 1e-12);
    EXPECT_EQ(structure.shear[xy].non_affinity.particles, 12);
    Eigen::VectorXd lengths = structure.shear[xy].particle_non_affinity;
    std::sort(lengths.begin(), lengths.end());
    EXPECT_EQ(structure.shear[xy].non_affinity.median, lengths[6]);
}

// The chains reach around the box along x and y as one, but not along z.
TEST(LoadStructure, SaysWhyAPlaneCarriesNothing) {
    const TwoChains chains;
    const LoadStructure structure = analyse(chains.packing, chains.bonds);
    EXPECT_EQ(structure.percolates, (std::array<bool, 3>{true, true, false}));
    EXPECT_EQ(structure.clusters, 2);
    EXPECT_EQ(structure.largest_cluster, 8);
    EXPECT_EQ(structure.summary(), "G' = 0 in xz, yz: the bonded network does not reach around the box along z");
    for (const std::size_t plane : {0U, 1U}) {
        const ShearLoad& load = structure.shear.at(plane);
        EXPECT_FALSE(load.carried);
        EXPECT_TRUE(load.force.isZero() && load.energy_share.isZero() && load.particle_energy_share.isZero());
        EXPECT_EQ(load.backbone.bonds, 0);
        EXPECT_EQ(load.energy_participation, 0);
        EXPECT_EQ(load.force_fabric.anisotropy, 0);
    }
}

/// A straight chain of ten touching spheres that closes through the boundary along `axis`, added to a packing of unit spheres.
void add_row(Packing& packing, std::vector<std::pair<int, int>>& pairs, int axis, const Eigen::Vector3d& start) {
    const auto first = static_cast<int>(packing.size());
    packing.positions.conservativeResize(3, first + 10);
    for (int k = 0; k < 10; ++k) {
        packing.positions.col(first + k) = start + (2 * k) * Eigen::Vector3d::Unit(axis);
        pairs.emplace_back(first + k, k < 9 ? first + k + 1 : first);
    }
    packing.radii = Eigen::VectorXd::Ones(first + 10);
}

TEST(LoadStructure, SaysWhyNothingIsCarriedAtAll) {
    const Packing lonely = random_spheres(10, 40.0, 1.0e-6, 2);
    EXPECT_EQ(analyse(lonely, find_contacts(lonely, 0.01)).summary(), "G' = 0 in xy, xz, yz: no two particles are bonded");

    Packing rows;
    rows.cell = Cell::periodic(Eigen::Vector3d::Constant(20));
    rows.positions.resize(3, 0);
    std::vector<std::pair<int, int>> pairs;
    add_row(rows, pairs, 0, {1, 5, 5});
    EXPECT_EQ(
        analyse(rows, bonds_between(rows, pairs)).summary(),
        "G' = 0 in xy: the bonded network does not reach around the box along y; in xz: the bonded network does not reach around "
        "the box along z; in yz: the bonded network does not reach around the box along y and z");
    add_row(rows, pairs, 1, {5, 1, 12});
    add_row(rows, pairs, 2, {12, 12, 1});
    EXPECT_NE(analyse(rows, bonds_between(rows, pairs)).summary().find("along both x and y; in xz: no connected part"),
              std::string::npos);

    // Simple cubic without shear stiffness: sheets and columns slide freely.
    const Packing cubic = make_lattice(simple_cubic(), 3, 3, 3);
    const ContactNetwork bonds = find_contacts(cubic, 0.01);
    LinearOptions soft;
    soft.shear_stiffness = 0;
    const auto structure = find_load_structure(cubic, bonds, solve_linear(cubic, bonds, soft));
    EXPECT_EQ(
        structure.summary(),
        "G' = 0 in xy, xz, yz: the bonded network reaches around the box, but its bonds are too few, or have no shear stiffness, "
        "to make it rigid");
}

// Bonds along z stay as they are; those along x and y are sheared by half of their length per unit strain.
TEST(LoadStructure, SimpleCubicCrystal) {
    const Packing packing = make_lattice(simple_cubic(), 3, 3, 3);
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    const LoadStructure structure = analyse(packing, bonds);
    const ShearLoad& load = structure.shear[xy];
    const double d = 2 * packing.radii[0];
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const bool along_z = std::abs(bonds.branch(2, bond)) > 0.5 * d;
        EXPECT_NEAR(load.shear_force[bond], along_z ? 0 : 0.5 * ks * d, 1e-9 * ks * d);
        EXPECT_NEAR(load.normal_force[bond], 0, 1e-9 * ks * d);
        EXPECT_NEAR(load.energy_share[bond], along_z ? 0 : 1.0 / 54, 1e-10);
    }
    EXPECT_NEAR(load.shear_spring_share, 1, 1e-12);
    EXPECT_NEAR(load.energy_participation, 1, 1e-12);
    EXPECT_EQ(load.non_affinity.participation, 0);
    EXPECT_EQ(load.force_fabric.anisotropy, 0);  // no normal forces
    EXPECT_EQ(load.distribution.mean, 0);
    EXPECT_TRUE(load.backbone.largest.percolates(0) && load.backbone.largest.percolates(1));
    EXPECT_FALSE(load.backbone.largest.percolates(2));
    EXPECT_EQ(load.backbone.bonds, 49);  // the first to store nine tenths of 54 equal parts
    EXPECT_LT(structure.fabric.anisotropy, 1e-12);
}

// A third of the bonds, those in the plane of the shear, is drawn or pressed by k_n d / 2 and stores k_n / (k_n + k_s).
TEST(LoadStructure, FaceCentredCubicCrystal) {
    const Packing packing = make_lattice(face_centred_cubic(), 3, 3, 3);
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    const LoadStructure structure = analyse(packing, bonds);
    EXPECT_LT((structure.fabric.tensor - Eigen::Matrix3d::Identity() / 3).norm(), 1e-12);
    EXPECT_LT((structure.fabric.eigenvalues - Eigen::Vector3d::Constant(1.0 / 3)).norm(), 1e-12);
    const ShearLoad& load = structure.shear[xy];
    const double d = 2 * packing.radii[0];
    double pulled = 0;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const Eigen::Vector3d n = bonds.branch.col(bond) / d;
        EXPECT_NEAR(load.normal_force[bond], kn * d * n.x() * n.y(), 1e-9 * kn * d);
        EXPECT_NEAR(load.shear_force[bond], std::abs(n.z()) < 0.1 ? 0 : ks * d / (2 * std::sqrt(2.0)), 1e-9 * kn * d);
        pulled += load.normal_force[bond] > 0.1 * kn * d ? 1 : 0;
    }
    EXPECT_EQ(pulled, static_cast<double>(bonds.size()) / 6);
    EXPECT_NEAR(load.shear_spring_share, ks / (kn + ks), 1e-12);
    EXPECT_NEAR(load.force_fabric.tensor(0, 0), 0.5, 1e-9);
    EXPECT_NEAR(load.force_fabric.tensor(2, 2), 0, 1e-9);
    EXPECT_NEAR(load.force_fabric.anisotropy, 0.5, 1e-9);
    // 216 equal bonds hold 10/11 of the energy; the least number with 9/10 is 213.84.
    EXPECT_EQ(load.backbone.bonds, 214);
    // Two thirds of the forces vanish, the rest is three times the mean.
    EXPECT_NEAR(load.distribution.mean, kn * d / 6, 1e-9 * kn * d);
    EXPECT_NEAR(load.distribution.density[0] * load.distribution.bin_width, 2.0 / 3, 1e-12);
    EXPECT_EQ(load.distribution.tail_bonds, 216);
    EXPECT_NEAR(load.distribution.tail_slope, 1, 1e-9);
}

/// A random network with rattlers and floppy modes.
struct LoadedNetwork {
    Packing packing = random_spheres(700, 17.0, 1.0e-6, 4);
    ContactNetwork bonds = find_contacts(packing, 0.05);
    LinearResponse response = solve_linear(packing, bonds);
    LoadStructure structure = find_load_structure(packing, bonds, response);
};

TEST(LoadStructure, EnergyAndStressAreThoseOfTheElasticTensor) {
    const LoadedNetwork network;
    ASSERT_GT(network.response.rattlers, 0);
    const double volume = network.packing.cell.volume();
    for (std::size_t plane = 0; plane < 3; ++plane) {
        const ShearLoad& load = network.structure.shear.at(plane);
        const auto strain = static_cast<Index>(plane + 3);
        const double modulus = network.response.elastic_tensor(strain, strain);
        ASSERT_TRUE(load.carried);
        EXPECT_NEAR(2 * load.energy / volume, modulus, 1e-8 * modulus);
        EXPECT_NEAR(load.energy_share.sum(), 1, 1e-12);
        EXPECT_NEAR(load.particle_energy_share.sum(), 1, 1e-12);
        Eigen::Matrix<double, 6, 1> stress = Eigen::Matrix<double, 6, 1>::Zero();
        for (Index bond = 0; bond < network.bonds.size(); ++bond) {
            stress += affine_displacements(network.bonds.branch.col(bond)).transpose() * load.force.col(bond) / volume;
        }
        EXPECT_LT((stress - network.response.elastic_tensor.col(strain)).norm(), 1e-7 * modulus);
    }
}

TEST(LoadStructure, ForcesAndTorquesBalanceOnEveryParticle) {
    const LoadedNetwork network;
    for (const ShearLoad& load : network.structure.shear) {
        Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, network.packing.size());
        Eigen::Matrix3Xd torque = force;
        for (Index bond = 0; bond < network.bonds.size(); ++bond) {
            const Eigen::Vector3d pull = load.force.col(bond);
            const Eigen::Vector3d arm = 0.5 * network.bonds.branch.col(bond);  // equal radii
            force.col(network.bonds.ends(0, bond)) += pull;
            force.col(network.bonds.ends(1, bond)) -= pull;
            torque.col(network.bonds.ends(0, bond)) += arm.cross(pull);
            torque.col(network.bonds.ends(1, bond)) += arm.cross(pull);
        }
        const double largest = load.force.colwise().norm().maxCoeff();
        EXPECT_LT(force.colwise().norm().maxCoeff(), 1e-7 * largest);
        EXPECT_LT(torque.colwise().norm().maxCoeff(), 1e-7 * largest * network.packing.radii[0]);
    }
}

// A periodic network may translate freely, and one particle that swings far must not pass for the motion of all.
TEST(LoadStructure, NonAffinityDoesNotDependOnATranslation) {
    LoadedNetwork network;
    for (Eigen::Matrix3Xd& u : network.response.displacement) {
        u.colwise() += Eigen::Vector3d(3e-4, -2e-4, 5e-4);
    }
    const LoadStructure moved = find_load_structure(network.packing, network.bonds, network.response);
    for (std::size_t plane = 0; plane < 3; ++plane) {
        const NonAffinity& before = network.structure.shear.at(plane).non_affinity;
        const NonAffinity& after = moved.shear.at(plane).non_affinity;
        EXPECT_NEAR(after.median, before.median, 1e-9 * before.median);
        EXPECT_NEAR(after.mean_square, before.mean_square, 1e-9 * before.mean_square);
        EXPECT_NEAR(after.participation, before.participation, 1e-9);
    }
}

TEST(LoadStructure, BackboneIsTheSmallestSetOfBonds) {
    const LoadedNetwork network;
    for (const ShearLoad& load : network.structure.shear) {
        double inside = 0;
        double weakest = 1;
        double strongest_outside = 0;
        Index count = 0;
        for (Index bond = 0; bond < network.bonds.size(); ++bond) {
            const double share = load.energy_share[bond];
            if (load.backbone.bond[static_cast<std::size_t>(bond)]) {
                inside += share;
                weakest = std::min(weakest, share);
                ++count;
            } else {
                strongest_outside = std::max(strongest_outside, share);
            }
        }
        EXPECT_EQ(count, load.backbone.bonds);
        EXPECT_GE(inside, 0.9 - 1e-12);
        EXPECT_LT(inside - weakest, 0.9 + 1e-12);
        EXPECT_GE(weakest, strongest_outside);
        EXPECT_LT(load.strongest_share[0], load.strongest_share[1]);
        EXPECT_LT(load.strongest_share[1], load.strongest_share[2]);
        EXPECT_LT(load.backbone.particles, network.packing.size());
        EXPECT_GT(load.non_affinity.participation, 0);
        EXPECT_LT(load.non_affinity.participation, 1);
        EXPECT_EQ(load.backbone_non_affinity.particles, load.backbone.particles);
        EXPECT_EQ(load.non_affinity.particles, network.packing.size() - network.response.rattlers);
        EXPECT_LT(load.backbone_non_affinity.mean_square, load.non_affinity.mean_square);
        EXPECT_LT(load.non_affinity.median * load.non_affinity.median, load.non_affinity.mean_square);
        const double bins = load.distribution.density.sum() * load.distribution.bin_width;
        EXPECT_NEAR(bins + load.distribution.beyond, 1, 1e-12);
    }
}

TEST(LoadStructure, SameBitsForOneAndTwoThreads) {
    const LoadedNetwork network;
    omp_set_num_threads(1);
    const LoadStructure one = find_load_structure(network.packing, network.bonds, network.response);
    omp_set_num_threads(2);
    const LoadStructure two = find_load_structure(network.packing, network.bonds, network.response);
    for (std::size_t plane = 0; plane < 3; ++plane) {
        EXPECT_TRUE(one.shear.at(plane).force == two.shear.at(plane).force);
        EXPECT_TRUE(one.shear.at(plane).energy_share == two.shear.at(plane).energy_share);
        EXPECT_TRUE(one.shear.at(plane).backbone.bond == two.shear.at(plane).backbone.bond);
        EXPECT_EQ(one.shear.at(plane).energy_participation, two.shear.at(plane).energy_participation);
    }
}

// Half of every bond belongs to each of its ends; held particles lie outside the measured volume.
TEST(LoadStructure, SampleWithAFreeSurface) {
    LoadedNetwork network;
    network.packing.cell = Cell::open(Eigen::Vector3d::Zero(), network.packing.cell.lengths());
    const ContactNetwork bonds = find_contacts(network.packing, 0.05);
    LinearOptions options;
    for (Index i = 0; i < network.packing.size(); ++i) {
        const Eigen::Vector3d x = network.packing.positions.col(i);
        options.held.push_back(x.minCoeff() < 3e-6 || x.maxCoeff() > 14e-6);
    }
    options.volume = 1e-15;
    const LinearResponse response = solve_linear(network.packing, bonds, options);
    EXPECT_THROW(find_load_structure(network.packing, bonds, response), std::invalid_argument);
    const LoadStructure structure = find_load_structure(network.packing, bonds, response, {.held = options.held});
    EXPECT_EQ(structure.percolates, (std::array<bool, 3>{false, false, false}));
    const ShearLoad& load = structure.shear[xy];
    ASSERT_TRUE(load.carried);
    EXPECT_EQ(structure.summary(), "shear is carried in xy, xz, yz");
    double stress = 0;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const int free_ends = (options.held[static_cast<std::size_t>(bonds.ends(0, bond))] ? 0 : 1) +
                              (options.held[static_cast<std::size_t>(bonds.ends(1, bond))] ? 0 : 1);
        EXPECT_TRUE(free_ends > 0 || load.force.col(bond).isZero());
        stress += 0.5 * free_ends * affine_displacements(bonds.branch.col(bond)).col(5).dot(load.force.col(bond));
    }
    EXPECT_NEAR(stress / options.volume, response.elastic_tensor(5, 5), 1e-8 * response.elastic_tensor(5, 5));
}

TEST(LoadStructure, SlopeOfAnExponentialTail) {
    constexpr Index count = 20000;
    Eigen::VectorXd force(count);
    for (Index i = 0; i < count; ++i) {
        const Eigen::Vector3d uniform = random_uniform(8, RandomPurpose::test, 0, static_cast<std::uint64_t>(i));
        force[i] = (uniform[1] < 0.5 ? -7.0 : 7.0) * std::log(1 - uniform[0]);
    }
    const ForceDistribution distribution = distribution_of_forces(force);
    EXPECT_NEAR(distribution.mean, 7, 5 * 7 / std::sqrt(static_cast<double>(count)));
    EXPECT_NEAR(static_cast<double>(distribution.tail_bonds), std::exp(-2) * count, 5 * std::sqrt(std::exp(-2) * count));
    EXPECT_NEAR(distribution.tail_slope, 1, 4 * distribution.tail_slope_error);
    EXPECT_LT(distribution.tail_slope_error, 0.03);
    EXPECT_NEAR(distribution.tail_variation, 1, 0.08);
    EXPECT_NEAR(distribution.density[8], std::exp(-2.125), 0.02);
}

TEST(LoadStructure, RefusesWhatDoesNotBelongTogether) {
    const TwoChains chains;
    const LinearResponse response = solve_linear(chains.packing, chains.bonds);
    EXPECT_THROW(find_load_structure(chains.packing, chains.bonds, response, {.backbone_energy = 1.0, .held = {}}),
                 std::invalid_argument);
    EXPECT_THROW(find_load_structure(chains.packing, chains.bonds, LinearResponse{}), std::invalid_argument);
    const Packing other = random_spheres(20, 10.0, 1.0);
    EXPECT_THROW(find_load_structure(other, find_contacts(other, 0.1), response), std::invalid_argument);
    EXPECT_THROW(find_load_structure(other, chains.bonds, response), std::invalid_argument);
    EXPECT_THROW(find_fabric(chains.bonds, Eigen::VectorXd::Ones(3)), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
