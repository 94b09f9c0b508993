// SPDX-License-Identifier: GPL-3.0-or-later
// Small networks for the tests of mechanics.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/random.hpp>

namespace coagula::testing {

/// Spheres at random places of a periodic cube, joined wherever they are closer than `reach` radii: an irregular network.
inline Packing random_spheres(Index particles, double edge_in_radii, double radius, std::uint64_t seed = 1) {
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(edge_in_radii * radius));
    packing.positions.resize(3, particles);
    for (Index i = 0; i < particles; ++i) {
        packing.positions.col(i) =
            edge_in_radii * radius * random_uniform(seed, RandomPurpose::test, 0, static_cast<std::uint64_t>(i));
    }
    packing.radii = Eigen::VectorXd::Constant(particles, radius);
    return packing;
}

/// Bonds given by their ends, with the branch vectors of the packing.
inline ContactNetwork bonds_between(const Packing& packing, const std::vector<std::pair<int, int>>& pairs) {
    ContactNetwork network;
    network.particles = packing.size();
    network.ends.resize(2, static_cast<Index>(pairs.size()));
    network.branch.resize(3, static_cast<Index>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [i, j] = pairs[k];
        network.ends.col(static_cast<Index>(k)) << i, j;
        network.branch.col(static_cast<Index>(k)) = packing.cell.minimum_image(packing.positions.col(j) - packing.positions.col(i));
    }
    return network;
}

/// The same stiffness for every bond.
inline std::vector<ContactTangent> alike(const ContactNetwork& bonds, const ContactTangent& tangent) {
    std::vector<ContactTangent> all(static_cast<std::size_t>(bonds.size()), tangent);
    return all;
}

}  // namespace coagula::testing
