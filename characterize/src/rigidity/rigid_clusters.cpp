// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_clusters.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace coagula::characterize {

namespace {

/// Two particles up to two contacts apart; `branch` from the first to the second.
struct Pair {
    std::int32_t first;
    std::int32_t second;
    Eigen::Vector3d branch;
};

/// A contact as one of its ends sees it.
struct ClusterStep {
    Index other;
    Eigen::Vector3d branch;
};

std::vector<std::vector<ClusterStep>> steps_of(const ContactNetwork& contacts) {
    std::vector<std::vector<ClusterStep>> steps(static_cast<std::size_t>(contacts.particles));
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const Index first = contacts.ends(0, contact);
        const Index second = contacts.ends(1, contact);
        steps[static_cast<std::size_t>(first)].push_back({second, contacts.branch.col(contact)});
        steps[static_cast<std::size_t>(second)].push_back({first, -contacts.branch.col(contact)});
    }
    return steps;
}

/// Contacts, and pairs that touch one particle; a pair counts once for each way.
std::vector<Pair> near_pairs(const ContactNetwork& contacts) {
    std::vector<Pair> pairs;
    const auto add = [&pairs](Index first, Index second, const Eigen::Vector3d& branch) {
        const auto a = static_cast<std::int32_t>(first);
        const auto b = static_cast<std::int32_t>(second);
        pairs.push_back(a <= b ? Pair{a, b, branch} : Pair{b, a, -branch});
    };
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        add(contacts.ends(0, contact), contacts.ends(1, contact), contacts.branch.col(contact));
    }
    for (const std::vector<ClusterStep>& steps : steps_of(contacts)) {
        for (auto one = steps.begin(); one != steps.end(); ++one) {
            for (auto other = steps.begin(); other != one; ++other) {
                add(one->other, other->other, other->branch - one->branch);
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.first != b.first ? a.first < b.first : a.second < b.second; });
    return pairs;
}

/// Largest motion of the second particle as seen from the first, in mean radii.
double relative_motion(const Pair& pair, const Eigen::MatrixXd& motions, double r0) {
    double largest = 0;
    const Eigen::Vector3d branch = pair.branch / r0;
    for (Index k = 0; k < motions.cols(); ++k) {
        const auto one = motions.col(k).segment<6>(6 * Index{pair.first});
        const auto other = motions.col(k).segment<6>(6 * Index{pair.second});
        const Eigen::Vector3d turn = one.tail<3>();
        const Eigen::Vector3d moved = other.head<3>() - one.head<3>() - turn.cross(branch);
        largest = std::max({largest, moved.cwiseAbs().maxCoeff(), (other.tail<3>() - turn).cwiseAbs().maxCoeff()});
    }
    return largest;
}

ContactNetwork network_of(Index particles, const std::vector<Pair>& pairs) {
    ContactNetwork network;
    network.particles = particles;
    network.ends.resize(2, static_cast<Index>(pairs.size()));
    network.branch.resize(3, static_cast<Index>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        network.ends.col(static_cast<Index>(k)) << pairs[k].first, pairs[k].second;
        network.branch.col(static_cast<Index>(k)) = pairs[k].branch;
    }
    return network;
}

}  // namespace

RigidClusters find_rigid_clusters(const Packing& packing, const ContactNetwork& contacts, const Eigen::MatrixXd& motions,
                                  double tolerance) {
    RigidClusters result;
    const double r0 = mean_radius(packing);
    std::vector<Pair> rigid;
    for (const Pair& pair : near_pairs(contacts)) {
        const double motion = relative_motion(pair, motions, r0);
        if (motion <= tolerance) {
            rigid.push_back(pair);
            result.largest_rigid = std::max(result.largest_rigid, motion);
        } else {
            result.smallest_loose = std::fmin(result.smallest_loose, motion);
        }
    }
    const ContactNetwork network = network_of(packing.size(), rigid);
    result.clusters = find_clusters(packing, network);
    // A particle with its own image is no body of two.
    std::erase_if(result.clusters, [](const Cluster& cluster) { return cluster.particles < 2; });
    result.of_particle = cluster_of_particles(network, result.clusters);
    return result;
}

}  // namespace coagula::characterize
