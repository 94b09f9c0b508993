// SPDX-License-Identifier: GPL-3.0-or-later
// Small systems for the tests of common/dem.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/dem/forces.hpp>
#include <coagula/common/dem/particle_system.hpp>
#include <coagula/common/random.hpp>

namespace coagula::dem {

using Central = Interactions<RepulsiveSpring, BondSpring>;
using Sheared = Interactions<RepulsiveSpring, BondedContact>;

inline const Central central{RepulsiveSpring(2.0), BondSpring(3.0)};
inline const Sheared sheared{RepulsiveSpring(2.0), BondedContact(3.0, 0.7)};

/// N x 3 numbers uniform in (-1, 1), as columns.
inline Eigen::Matrix3Xd noise(Index count, std::uint64_t seed) {
    Eigen::Matrix3Xd values(3, count);
    for (Index i = 0; i < count; ++i) {
        values.col(i) = 2 * random_uniform(seed, RandomPurpose::test, 0, static_cast<std::uint64_t>(i)).array() - 1;
    }
    return values;
}

inline Packing random_packing(const Cell& cell, Index count, double smallest, double largest, std::uint64_t seed) {
    const Eigen::Matrix3Xd places = (noise(count, seed).array() + 1) / 2;
    Packing packing{cell, (cell.lengths().asDiagonal() * places).colwise() + cell.origin(), Eigen::VectorXd(count)};
    packing.radii = smallest + (largest - smallest) * (noise(count, seed + 1000).row(0).array().transpose() + 1) / 2;
    return packing;
}

/// Six touching spheres of three sizes in an open cell, with a little disorder: a cluster that no symmetry helps.
inline Packing cluster() {
    Packing packing{Cell::open({-50, -50, -50}, {100, 100, 100}), Eigen::Matrix3Xd(3, 6), Eigen::VectorXd(6)};
    packing.positions << 0, 2, 1, 1, 3, -0.9, 0, 0, 1.7, 0.6, 1.7, 1.5, 0, 0, 0, 1.7, 0.1, 0.9;
    packing.radii << 1, 1, 1.1, 0.9, 1, 1.05;
    return packing;
}

inline ContactNetwork cluster_bonds() {
    ContactNetwork bonds = find_contacts(cluster(), 0.05);
    return bonds;
}

}  // namespace coagula::dem
