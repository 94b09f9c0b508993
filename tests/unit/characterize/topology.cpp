// SPDX-License-Identifier: GPL-3.0-or-later
// Topology of contact networks: rings and loops of crystals and of random graphs.
#include <coagula/characterize/rings.hpp>
#include <coagula/characterize/topology.hpp>

#include "networks.hpp"
#include "support/lattices.hpp"
#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace coagula::characterize {
namespace {

using test::face_centred;
using test::simple_cubic;

constexpr double radius = 0.25e-6;

Packing diamond(int cells) {
    return test::lattice(
        {{0, 0, 0}, {0, .5, .5}, {.5, 0, .5}, {.5, .5, 0}, {.25, .25, .25}, {.25, .75, .75}, {.75, .25, .75}, {.75, .75, .25}},
        8 * radius / std::sqrt(3.0), {cells, cells, cells}, radius);
}

Eigen::VectorXi rings_of_each(const Packing& packing, int largest) {
    const Rings rings = measure_rings(find_contacts(packing, 0.01), largest);
    for (Index particle = 1; particle < packing.size(); ++particle) {
        EXPECT_EQ(rings.per_particle.col(particle), rings.per_particle.col(0));
    }
    return rings.per_particle.col(0);
}

TEST(Rings, OfCrystals) {
    // Triangles and squares of fcc: 24 edges and 6 squares' diagonals among the neighbours, each diagonal with two squares.
    EXPECT_EQ(rings_of_each(face_centred({3, 3, 3}, radius), 4).tail(2), Eigen::Vector2i(24, 12));
    // Simple cubic: 12 squares, and the hexagons around the body diagonals of the 8 cubes, 3 of each through a corner.
    EXPECT_EQ(rings_of_each(simple_cubic({4, 4, 4}, radius), 6).tail(4), Eigen::Vector4i(0, 12, 0, 24));
    // Diamond: 12 six-membered rings through every atom, none smaller.
    EXPECT_EQ(rings_of_each(diamond(2), 7).tail(5), (Eigen::Matrix<int, 5, 1>() << 0, 0, 0, 12, 0).finished());
}

TEST(Rings, DoNotCloseAroundASmallBox) {
    EXPECT_EQ(rings_of_each(simple_cubic({1, 1, 1}, radius), 6), rings_of_each(simple_cubic({5, 5, 5}, radius), 6));
    EXPECT_EQ(rings_of_each(diamond(1), 6), rings_of_each(diamond(2), 6));
}

/// 1 between particles in contact, else 1000.
Eigen::MatrixXi adjacency(const ContactNetwork& contacts) {
    Eigen::MatrixXi adjacent = Eigen::MatrixXi::Constant(contacts.particles, contacts.particles, 1000);
    for (Index k = 0; k < contacts.size(); ++k) {
        adjacent(contacts.ends(0, k), contacts.ends(1, k)) = adjacent(contacts.ends(1, k), contacts.ends(0, k)) = 1;
    }
    return adjacent;
}

/// Contacts between any two particles (Floyd and Warshall).
Eigen::MatrixXi all_distances(Eigen::MatrixXi distance) {
    const Index n = distance.rows();
    distance.diagonal().setZero();
    for (Index m = 0; m < n; ++m) {
        for (Index i = 0; i < n; ++i) {
            for (Index j = 0; j < n; ++j) {
                distance(i, j) = std::min(distance(i, j), distance(i, m) + distance(m, j));
            }
        }
    }
    return distance;
}

/// Whether no two particles of a cycle are nearer by contacts outside it.
bool is_shortest(const std::vector<Index>& cycle, const Eigen::MatrixXi& distance) {
    const int size = static_cast<int>(cycle.size());
    for (int a = 0; a < size; ++a) {
        for (int b = 0; b < a; ++b) {
            if (distance(cycle[static_cast<std::size_t>(a)], cycle[static_cast<std::size_t>(b)]) != std::min(a - b, size - a + b)) {
                return false;
            }
        }
    }
    return true;
}

/// Straight from the definition: every simple cycle, tested with all distances. Open packings.
Eigen::VectorXi rings_by_definition(const ContactNetwork& contacts, int largest) {
    const Index n = contacts.particles;
    const Eigen::MatrixXi adjacent = adjacency(contacts);
    const Eigen::MatrixXi distance = all_distances(adjacent);
    Eigen::VectorXi count = Eigen::VectorXi::Zero(largest + 1);
    std::vector<Index> walk;
    const std::function<void()> extend = [&] {
        const int size = static_cast<int>(walk.size());
        if (size >= 3 && walk[1] < walk.back() && adjacent(walk.back(), walk[0]) == 1) {
            count[size] += is_shortest(walk, distance) ? 1 : 0;
        }
        for (Index next = walk[0] + 1; size < largest && next < n; ++next) {
            if (adjacent(walk.back(), next) == 1 && std::find(walk.begin(), walk.end(), next) == walk.end()) {
                walk.push_back(next);
                extend();
                walk.pop_back();
            }
        }
    };
    for (Index first = 0; first < n; ++first) {
        walk = {first};
        extend();
    }
    return count;
}

TEST(Rings, AreThoseOfTheDefinition) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const ContactNetwork contacts = find_contacts(test::random_open(40, seed), 0.01);
        const Eigen::VectorXd found = measure_rings(contacts, 8).count();
        EXPECT_EQ(found, rings_by_definition(contacts, 8).cast<double>()) << "seed " << seed;
    }
}

TEST(Rings, RefuseImpossibleSizes) {
    const ContactNetwork contacts = find_contacts(simple_cubic({2, 2, 2}, radius), 0.01);
    EXPECT_THROW(measure_rings(contacts, 2), std::invalid_argument);
    EXPECT_THROW(measure_rings(contacts, 13), std::invalid_argument);
}

TEST(Rings, CanBeStopped) {
    const ContactNetwork contacts = find_contacts(simple_cubic({2, 2, 2}, radius), 0.01);
    const Progress stop([](std::string_view, double, std::string_view) { return false; });
    EXPECT_THROW(measure_rings(contacts, 8, stop), Cancelled);
}

TEST(Topology, OfCrystals) {
    const Packing packing = face_centred({3, 3, 3}, radius);
    const Topology topology = measure_topology(packing, find_contacts(packing, 0.01));
    EXPECT_EQ(topology.mean, 12);
    EXPECT_EQ(topology.variance, 0);
    EXPECT_EQ(topology.triangle_count, 8 * packing.size());
    EXPECT_EQ(topology.tetrahedron_count, 2 * packing.size());
    EXPECT_TRUE((topology.triangles_of_contact.array() == 4).all());
    EXPECT_EQ(topology.loops, 5 * packing.size() + 1);
    EXPECT_EQ(topology.windings(), 3);
    EXPECT_TRUE(topology.percolates(0) && topology.percolates(1) && topology.percolates(2));
}

TEST(Topology, OfAChainATriangleAndALoneParticle) {
    Packing packing;
    packing.cell = Cell::periodic({10, 10, 10});
    packing.radii = Eigen::VectorXd::Constant(9, 1);
    packing.positions.resize(3, 9);
    packing.positions << 1, 3, 5, 7, 9, 1, 3, 2, 5,  //
        1, 1, 1, 1, 1, 5, 5, 5 + std::sqrt(3.0), 7,  //
        1, 1, 1, 1, 1, 5, 5, 5, 9;
    const Topology topology = measure_topology(packing, find_contacts(packing, 0.001));
    ASSERT_EQ(topology.clusters.size(), 2);
    EXPECT_EQ(topology.clusters[0].particles, 5);  // the chain, around the box along x
    EXPECT_TRUE(topology.percolates(0));
    EXPECT_FALSE(topology.percolates(1));
    EXPECT_EQ(topology.windings(), 1);
    EXPECT_EQ(topology.lone_particles, 1);
    EXPECT_EQ(topology.loops, 2);
    EXPECT_EQ(topology.triangle_count, 1);
    EXPECT_EQ(topology.tetrahedron_count, 0);
    EXPECT_EQ(topology.of_particle, (Eigen::VectorXi(9) << 0, 0, 0, 0, 0, 1, 1, 1, -1).finished());
    EXPECT_DOUBLE_EQ(topology.mean, 16.0 / 9);
    EXPECT_DOUBLE_EQ(topology.variance, 32.0 / 9 - 256.0 / 81);
}

}  // namespace
}  // namespace coagula::characterize
