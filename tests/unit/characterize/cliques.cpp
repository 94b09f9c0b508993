// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles, tetrahedra and clique communities: crystals, and counts over all triples and quadruples.
#include <coagula/characterize/cliques.hpp>
#include <coagula/characterize/rings.hpp>

#include "networks.hpp"
#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace coagula::characterize {
namespace {

using test::face_centred;
using test::simple_cubic;

Cliques cliques_of(const Packing& packing) {
    return find_cliques(find_contacts(packing, 0.01));
}

/// Touching spheres of radius 1 in an open cell.
Packing open_spheres(const Eigen::Matrix3Xd& positions) {
    Packing packing;
    packing.cell = Cell::open({-10, -10, -10}, {20, 20, 20});
    packing.positions = positions;
    packing.radii = Eigen::VectorXd::Constant(positions.cols(), 1);
    return packing;
}

/// The primitive cell of fcc: one particle that touches twelve images of itself.
Packing primitive_face_centred() {
    Packing packing;
    const double h = std::sqrt(2.0);
    packing.cell = Cell::of_edges(Eigen::Vector3d::Zero(), Eigen::Matrix3d{{0, h, h}, {h, 0, h}, {h, h, 0}}, {true, true, true});
    packing.positions = Eigen::Matrix3Xd::Zero(3, 1);
    packing.radii = Eigen::VectorXd::Ones(1);
    return packing;
}

TEST(Cliques, OfCrystals) {
    const Packing fcc = face_centred({3, 3, 3}, 1);
    for (const Packing& packing : {fcc, face_centred({1, 1, 1}, 1), primitive_face_centred()}) {
        const Cliques cliques = cliques_of(packing);
        EXPECT_EQ(cliques.triangles.cols(), 8 * packing.size());
        EXPECT_EQ(cliques.tetrahedra.cols(), 2 * packing.size());
        EXPECT_TRUE((cliques.triangles_of_contact.array() == 4).all());
        EXPECT_TRUE((cliques.triangles_of_particle.array() == 24).all());
        EXPECT_TRUE((cliques.tetrahedra_of_particle.array() == 8).all());
    }
    const Cliques cubic = cliques_of(simple_cubic({3, 3, 3}, 1));  // three contacts in a row close around the box
    EXPECT_EQ(cubic.triangles.cols(), 0);
    EXPECT_EQ(cubic.tetrahedra.cols(), 0);
}

/// Sets of particles that all touch, in ascending order, of an open packing.
std::set<std::set<Index>> cliques_by_definition(const ContactNetwork& contacts, std::size_t size) {
    const auto touch = test::touching(contacts);
    std::set<std::set<Index>> cliques;
    for (Index i = 0; i < contacts.particles; ++i) {
        cliques.insert({i});
    }
    for (std::size_t grown = 1; grown < size; ++grown) {
        std::set<std::set<Index>> larger;
        for (const std::set<Index>& clique : cliques) {
            for (Index next = *clique.rbegin() + 1; next < contacts.particles; ++next) {
                if (std::all_of(clique.begin(), clique.end(), [&](Index member) { return touch(member, next); })) {
                    std::set<Index> with = clique;
                    with.insert(next);
                    larger.insert(with);
                }
            }
        }
        cliques = larger;
    }
    return cliques;
}

std::set<std::set<Index>> triangles_found(const Cliques& cliques) {
    std::set<std::set<Index>> found;
    for (Index k = 0; k < cliques.triangles.cols(); ++k) {
        found.insert({cliques.triangles(0, k), cliques.triangles(1, k), cliques.triangles(2, k)});
    }
    return found;
}

std::set<std::set<Index>> tetrahedra_found(const Cliques& cliques) {
    std::set<std::set<Index>> found;
    for (Index k = 0; k < cliques.tetrahedra.cols(); ++k) {
        std::set<Index> corners;
        for (const Index face : cliques.tetrahedra.col(k)) {
            corners.insert(cliques.triangles.col(face).begin(), cliques.triangles.col(face).end());
        }
        found.insert(corners);
    }
    return found;
}

TEST(Cliques, AreThoseOfTheDefinition) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const ContactNetwork contacts = find_contacts(test::random_open(40, seed), 0.01);
        const Cliques cliques = find_cliques(contacts);
        const auto triangles = cliques_by_definition(contacts, 3), tetrahedra = cliques_by_definition(contacts, 4);
        ASSERT_FALSE(tetrahedra.empty());
        EXPECT_EQ(triangles_found(cliques), triangles);
        EXPECT_EQ(tetrahedra_found(cliques), tetrahedra);
        EXPECT_EQ(cliques.triangles.cols(), std::ssize(triangles));
        EXPECT_EQ(cliques.tetrahedra.cols(), std::ssize(tetrahedra));
        EXPECT_EQ(cliques.tetrahedra_of_particle.sum(), 4 * std::ssize(tetrahedra));
        EXPECT_EQ(cliques.triangles_of_contact.sum(), 3 * std::ssize(triangles));
    }
}

TEST(Cliques, TrianglesAreRingsOfThree) {
    const ContactNetwork contacts = find_contacts(test::random_spheres(200, {1, 1, 1}, 0.06, 0.12, 3), 0.01);
    const Cliques cliques = find_cliques(contacts);
    EXPECT_GT(cliques.triangles.cols(), 100);
    EXPECT_EQ(cliques.triangles_of_particle.transpose(), measure_rings(contacts, 3).per_particle.row(3));
}

/// The contacts of a triangle join its particles, and the faces of a tetrahedron have six contacts.
TEST(Cliques, HaveTheContactsOfTheirParticles) {
    const ContactNetwork contacts = find_contacts(test::random_open(40, 7), 0.01);
    const Cliques cliques = find_cliques(contacts);
    for (Index k = 0; k < cliques.triangles.cols(); ++k) {
        std::set<Index> ends;
        for (const Index contact : cliques.triangle_contacts.col(k)) {
            ends.insert({contacts.ends(0, contact), contacts.ends(1, contact)});
        }
        EXPECT_EQ(ends, (std::set<Index>{cliques.triangles(0, k), cliques.triangles(1, k), cliques.triangles(2, k)}));
    }
    for (Index k = 0; k < cliques.tetrahedra.cols(); ++k) {
        std::set<Index> sides;
        for (const Index face : cliques.tetrahedra.col(k)) {
            sides.insert(cliques.triangle_contacts.col(face).begin(), cliques.triangle_contacts.col(face).end());
        }
        EXPECT_EQ(sides.size(), 6U);
    }
}

/// Communities straight from the definition: cliques are joined as long as two of them share all particles but one.
std::multiset<std::set<Index>> communities_by_definition(const std::set<std::set<Index>>& cliques) {
    std::vector<std::vector<std::set<Index>>> groups;
    for (const std::set<Index>& clique : cliques) {
        std::vector<std::set<Index>> joined = {clique};
        for (std::vector<std::set<Index>>& group : groups) {
            if (std::any_of(group.begin(), group.end(), [&](const std::set<Index>& other) {
                    return std::count_if(other.begin(), other.end(), [&](Index one) { return clique.contains(one); }) + 1 ==
                           std::ssize(clique);
                })) {
                joined.insert(joined.end(), group.begin(), group.end());
                group.clear();
            }
        }
        std::erase_if(groups, [](const auto& group) { return group.empty(); });
        groups.push_back(joined);
    }
    std::multiset<std::set<Index>> particles;
    for (const auto& group : groups) {
        std::set<Index> all;
        for (const std::set<Index>& clique : group) {
            all.insert(clique.begin(), clique.end());
        }
        particles.insert(all);
    }
    return particles;
}

TEST(CliqueCommunities, AreThoseOfTheDefinition) {
    for (const int size : {3, 4}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const ContactNetwork contacts = find_contacts(test::random_open(40, seed), 0.01);
            const CliqueCommunities found = find_clique_communities(contacts, find_cliques(contacts), size);
            std::multiset<std::set<Index>> sets;
            for (const CliqueCommunity& one : found.communities) {
                sets.insert({one.particles.begin(), one.particles.end()});
            }
            EXPECT_EQ(sets, communities_by_definition(cliques_by_definition(contacts, static_cast<std::size_t>(size)))) << seed;
        }
    }
}

/// Two triangles that share a side, a chain from them, and a tetrahedron.
TEST(CliqueCommunities, OfAHandMadeNetwork) {
    const double h = std::sqrt(3.0);
    Eigen::Matrix3Xd positions(3, 9);
    positions << 0, 2, 1, 3, 5, 7, 9, 8, 8,     //
        0, 0, h, h, h, h, h, 2 * h, h + 1 / h,  //
        0, 0, 0, 0, 0, 0, 0, 0, std::sqrt(8.0 / 3);
    const ContactNetwork contacts = find_contacts(open_spheres(positions), 0.001);
    const Cliques cliques = find_cliques(contacts);
    const CliqueCommunities by_sides = find_clique_communities(contacts, cliques, 3);
    ASSERT_EQ(by_sides.communities.size(), 2U);
    EXPECT_EQ(by_sides.communities[0].particles, (std::vector<std::int32_t>{5, 6, 7, 8}));  // six contacts come before five
    EXPECT_EQ(by_sides.communities[0].contacts.size(), 6U);
    EXPECT_EQ(by_sides.communities[1].particles, (std::vector<std::int32_t>{0, 1, 2, 3}));
    EXPECT_EQ(by_sides.communities[1].contacts.size(), 5U);
    EXPECT_TRUE(by_sides.share_one(0, 3));  // they do not touch
    EXPECT_FALSE(by_sides.share_one(3, 5));
    EXPECT_TRUE(by_sides.of_particle[4].empty());
    const CliqueCommunities by_faces = find_clique_communities(contacts, cliques, 4);
    ASSERT_EQ(by_faces.communities.size(), 1U);
    EXPECT_EQ(by_faces.communities[0].particles, (std::vector<std::int32_t>{5, 6, 7, 8}));
    EXPECT_THROW(find_clique_communities(contacts, cliques, 2), std::invalid_argument);
}

TEST(CliqueCommunities, OfFaceCentredCubic) {
    const Packing packing = face_centred({3, 3, 3}, 1);
    const ContactNetwork contacts = find_contacts(packing, 0.01);
    const Cliques cliques = find_cliques(contacts);
    // All triangles hang together by their sides; no two tetrahedra have a face in common, and each particle belongs to eight.
    EXPECT_EQ(find_clique_communities(contacts, cliques, 3).communities.size(), 1U);
    const CliqueCommunities alone = find_clique_communities(contacts, cliques, 4);
    EXPECT_EQ(std::ssize(alone.communities), 2 * packing.size());
    for (const std::vector<int>& own : alone.of_particle) {
        EXPECT_EQ(own.size(), 8U);
    }
}

}  // namespace
}  // namespace coagula::characterize
