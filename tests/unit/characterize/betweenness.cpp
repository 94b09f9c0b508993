// SPDX-License-Identifier: GPL-3.0-or-later
// Edge betweenness: closed forms, and distances and ways between all pairs.
#include <coagula/characterize/betweenness.hpp>
#include <coagula/characterize/measure.hpp>

#include "named_results.hpp"
#include "networks.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace coagula::characterize {
namespace {

using test::network_of;
using Pairs = std::vector<std::pair<int, int>>;

/// Contact k of a chain joins k and k + 1: all pairs with one end on either side pass.
TEST(Betweenness, OfAChain) {
    constexpr int n = 8;
    Pairs pairs;
    for (int k = 0; k + 1 < n; ++k) {
        pairs.emplace_back(k, k + 1);
    }
    const Betweenness found = measure_betweenness(network_of(n, pairs));
    for (int k = 0; k + 1 < n; ++k) {
        EXPECT_NEAR(found.of_contact[k], (k + 1) * (n - 1 - k) / (n * (n - 1) / 2.0), 1e-14);
    }
    EXPECT_NEAR(found.mean_distance, (n + 1) / 3.0, 1e-14);
    EXPECT_EQ(found.connected_pairs, 1);
}

/// Every contact of a star carries the ways of its own particle to all others.
TEST(Betweenness, OfAStar) {
    constexpr int n = 7;
    Pairs pairs;
    for (int k = 1; k < n; ++k) {
        pairs.emplace_back(0, k);
    }
    const Betweenness found = measure_betweenness(network_of(n, pairs));
    EXPECT_TRUE(found.of_contact.isConstant((n - 1) / (n * (n - 1) / 2.0), 1e-14));
    EXPECT_NEAR(found.spread(), 0, 1e-14);
    EXPECT_NEAR(found.share_of_largest(0.1), 0.1, 1e-14);
}

/// Ring of n: the sum of the distances, shared out over n equal contacts. Of an even ring opposite particles have two ways.
TEST(Betweenness, OfRings) {
    for (const int n : {3, 5, 8}) {
        Pairs pairs;
        for (int k = 0; k + 1 < n; ++k) {
            if (k == 1) {
                pairs.insert(pairs.begin() + 1, {0, n - 1});
            }
            pairs.emplace_back(k, k + 1);
        }
        const double mean_distance = n % 2 == 1 ? (n + 1) / 4.0 : n * n / (4.0 * (n - 1));
        const Betweenness found = measure_betweenness(network_of(n, pairs));
        EXPECT_TRUE(found.of_contact.isConstant(mean_distance / n, 1e-14)) << n;
        EXPECT_NEAR(found.mean_distance, mean_distance, 1e-14) << n;
    }
}

TEST(Betweenness, OfPartsAndOfNothing) {
    const Betweenness parts = measure_betweenness(network_of(5, {{0, 1}, {2, 3}}));
    EXPECT_TRUE(parts.of_contact.isConstant(0.1, 1e-15));
    EXPECT_NEAR(parts.connected_pairs, 0.2, 1e-15);
    EXPECT_EQ(parts.mean_distance, 1);
    for (const Index particles : {1, 4}) {
        const Betweenness nothing = measure_betweenness(network_of(particles, {}));
        EXPECT_EQ(nothing.mean(), 0);
        EXPECT_EQ(nothing.spread(), 0);
        EXPECT_EQ(nothing.share_of_largest(0.1), 0);
        EXPECT_EQ(nothing.mean_distance, 0);
    }
}

/// A particle that meets its own image, and a pair that meets twice: the two contacts share the ways.
TEST(Betweenness, OfContactsWithImages) {
    const Betweenness found = measure_betweenness(network_of(3, {{0, 0}, {0, 1}, {0, 1}, {1, 2}}));
    const Eigen::Vector4d expected(0, 1.0 / 3, 1.0 / 3, 2.0 / 3);
    EXPECT_TRUE(found.of_contact.isApprox(expected, 1e-14)) << found.of_contact.transpose();
}

/// Distances and numbers of shortest ways between all pairs, from powers of the adjacency matrix: the walks of the smallest length
/// that arrive.
struct AllPairs {
    Eigen::MatrixXi distance;
    Eigen::MatrixXd ways;
};

AllPairs count_all_ways(const ContactNetwork& contacts) {
    const Index n = contacts.particles;
    const Eigen::MatrixXd adjacency = test::touching(contacts).cast<double>();
    Eigen::MatrixXd walks = Eigen::MatrixXd::Identity(n, n);
    AllPairs all = {Eigen::MatrixXi::Constant(n, n, 1000), Eigen::MatrixXd::Zero(n, n)};
    for (int length = 0; length < n; ++length) {
        for (Index pair = 0; pair < n * n; ++pair) {
            if (walks(pair) > 0 && all.distance(pair) == 1000) {
                all.distance(pair) = length;
                all.ways(pair) = walks(pair);
            }
        }
        walks = (walks * adjacency).eval();
    }
    return all;
}

/// A contact lies on a shortest way if the ways to its ends and the contact itself add up to the distance.
Eigen::VectorXd betweenness_by_definition(const ContactNetwork& contacts) {
    const AllPairs all = count_all_ways(contacts);
    const Index n = contacts.particles;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(contacts.size());
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const Index u = contacts.ends(0, contact), v = contacts.ends(1, contact);
        for (Index s = 0; s < n; ++s) {
            for (Index t = 0; t < n; ++t) {  // u is met first, or v is, which is the pair (t, s)
                if (all.distance(s, t) < 1000 && all.distance(s, u) + 1 + all.distance(v, t) == all.distance(s, t)) {
                    sum[contact] += all.ways(s, u) * all.ways(v, t) / all.ways(s, t);
                }
            }
        }
    }
    return sum / (0.5 * static_cast<double>(n * (n - 1)));
}

TEST(Betweenness, IsThatOfTheDefinition) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const ContactNetwork contacts = find_contacts(test::random_open(40, seed), 0.01);
        ASSERT_GT(contacts.size(), 40);
        const Betweenness found = measure_betweenness(contacts);
        const Eigen::VectorXd expected = betweenness_by_definition(contacts);
        EXPECT_LT((found.of_contact - expected).cwiseAbs().maxCoeff(), 1e-13) << "seed " << seed;
        // Each way counts once for each of its contacts.
        EXPECT_NEAR(found.of_contact.sum(), found.mean_distance * found.connected_pairs, 1e-12);
    }
}

TEST(Betweenness, SharesOfTheLargest) {
    Betweenness found;
    found.of_contact = (Eigen::VectorXd(5) << 1, 4, 2, 0, 3).finished();
    EXPECT_DOUBLE_EQ(found.share_of_largest(0.2), 0.4);
    EXPECT_DOUBLE_EQ(found.share_of_largest(0.3), 0.55);  // half of the second counts
    EXPECT_DOUBLE_EQ(found.share_of_largest(0), 0);
    EXPECT_DOUBLE_EQ(found.share_of_largest(1), 1);
    EXPECT_DOUBLE_EQ(found.spread(), std::sqrt(2.0) / 2);
}

TEST(Betweenness, HasTheSameBitsForAnyNumberOfThreads) {
    const ContactNetwork contacts = find_contacts(test::random_spheres(300, {1, 1, 1}, 0.05, 0.09, 3), 0.01);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Eigen::VectorXd one = measure_betweenness(contacts).of_contact;
    omp_set_num_threads(3);
    const Eigen::VectorXd three = measure_betweenness(contacts).of_contact;
    omp_set_num_threads(threads);
    EXPECT_EQ(one, three);
}

TEST(Betweenness, CanBeStopped) {
    const Progress stop([](std::string_view, double, std::string_view) { return false; });
    EXPECT_THROW(measure_betweenness(network_of(2, {{0, 1}}), stop), Cancelled);
}

/// The file has the pairs in the order of the values.
TEST(Betweenness, IsKeptForEachContact) {
    const MeasureInput input(test::random_spheres(100, {1, 1, 1}, 0.08, 0.08, 2));
    const MeasureResult result = run_measures(input, {"betweenness"});
    ASSERT_EQ(result.contact_results.size(), 3U);
    const auto contacts = static_cast<std::size_t>(input.contacts().size());
    EXPECT_EQ(result.contact_results[0].shape, (std::vector<std::size_t>{contacts, 2}));
    const auto& pairs = std::get<std::vector<std::int64_t>>(result.contact_results[0].values);
    const auto& values = std::get<std::vector<double>>(result.contact_results[2].values);
    const Betweenness found = measure_betweenness(input.contacts());
    for (std::size_t k = 0; k < contacts; ++k) {
        EXPECT_EQ(pairs[2 * k], input.contacts().ends(0, static_cast<Index>(k)));
        EXPECT_EQ(pairs[2 * k + 1], input.contacts().ends(1, static_cast<Index>(k)));
        EXPECT_EQ(values[k], found.of_contact[static_cast<Index>(k)]);
    }
    EXPECT_EQ(test::scalar(result, "betweenness/mean"), found.mean());
    EXPECT_NEAR(result.fields[0].values.sum(), found.of_contact.sum(), 1e-12);
}

}  // namespace
}  // namespace coagula::characterize
