// SPDX-License-Identifier: GPL-3.0-or-later
// Contact networks that tests of the topology share.
#pragma once

#include <coagula/common/contact_network.hpp>

#include "test_packings.hpp"

#include <utility>
#include <vector>

namespace coagula::characterize::test {

/// Overlapping spheres at random in an open unit cube.
inline Packing random_open(Index particles, std::uint64_t seed) {
    Packing packing = random_spheres(particles, Eigen::Vector3d::Ones(), 0.15, 0.15, seed);
    packing.cell = Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
    return packing;
}

/// A network given by its pairs, first < second, each once and sorted. Its branch vectors are of no meaning.
inline ContactNetwork network_of(Index particles, const std::vector<std::pair<int, int>>& pairs) {
    ContactNetwork network;
    network.particles = particles;
    network.ends.resize(2, std::ssize(pairs));
    network.branch = Eigen::Matrix3Xd::Ones(3, network.ends.cols());
    for (Index contact = 0; contact < network.size(); ++contact) {
        const auto& [first, second] = pairs[static_cast<std::size_t>(contact)];
        network.ends.col(contact) << first, second;
    }
    return network;
}

/// Whether two particles touch.
inline Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> touching(const ContactNetwork& contacts) {
    Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> touch =
        Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>::Constant(contacts.particles, contacts.particles, false);
    for (Index k = 0; k < contacts.size(); ++k) {
        touch(contacts.ends(0, k), contacts.ends(1, k)) = touch(contacts.ends(1, k), contacts.ends(0, k)) = true;
    }
    return touch;
}

}  // namespace coagula::characterize::test
