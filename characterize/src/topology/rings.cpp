// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/rings.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace coagula::characterize {

namespace {

/// An image of a particle, seen from a particle at the origin.
struct Node {
    std::int32_t particle;
    int distance;           ///< through the network, in contacts
    Eigen::Vector3d place;  ///< relative to the origin [m]
};

/// A contact as one of its ends sees it.
struct Step {
    std::int32_t other;
    Eigen::Vector3d branch;
};

/// Walks through the network and all its periodic images.
class Walker {
public:
    explicit Walker(const ContactNetwork& contacts) : steps_(static_cast<std::size_t>(contacts.particles)) {
        double shortest = std::numeric_limits<double>::infinity();
        for (Index contact = 0; contact < contacts.size(); ++contact) {
            const Eigen::Vector3d branch = contacts.branch.col(contact);
            steps_[static_cast<std::size_t>(contacts.ends(0, contact))].push_back({contacts.ends(1, contact), branch});
            steps_[static_cast<std::size_t>(contacts.ends(1, contact))].push_back({contacts.ends(0, contact), -branch});
            shortest = std::min(shortest, branch.norm());
        }
        tolerance_ = 0.25 * shortest;
    }

    Index particles() const { return static_cast<Index>(steps_.size()); }
    const std::vector<Step>& steps(std::int32_t particle) const { return steps_[static_cast<std::size_t>(particle)]; }

    /// Images of one particle lie farther apart than the centres of particles in contact.
    bool same_place(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
        return (a - b).squaredNorm() < tolerance_ * tolerance_;
    }

    /// All images within `depth` contacts of a particle, nearest first. @param seen scratch: the nodes of every particle, all
    /// empty.
    std::vector<Node> ball(std::int32_t centre, int depth, std::vector<std::vector<int>>& seen) const {
        std::vector<Node> nodes = {{centre, 0, Eigen::Vector3d::Zero()}};
        seen[static_cast<std::size_t>(centre)].push_back(0);
        for (std::size_t k = 0; k < nodes.size() && nodes[k].distance < depth; ++k) {
            for (const Step& step : steps(nodes[k].particle)) {
                const Eigen::Vector3d place = nodes[k].place + step.branch;
                if (find(nodes, seen, step.other, place) < 0) {
                    seen[static_cast<std::size_t>(step.other)].push_back(static_cast<int>(nodes.size()));
                    nodes.push_back({step.other, nodes[k].distance + 1, place});
                }
            }
        }
        return nodes;
    }

    /// The node of a particle at a place, or -1.
    int find(const std::vector<Node>& nodes, const std::vector<std::vector<int>>& seen, std::int32_t particle,
             const Eigen::Vector3d& place) const {
        for (const int node : seen[static_cast<std::size_t>(particle)]) {
            if (same_place(nodes[static_cast<std::size_t>(node)].place, place)) {
                return node;
            }
        }
        return -1;
    }

private:
    std::vector<std::vector<Step>> steps_;
    double tolerance_ = 0;
};

void clear(const std::vector<Node>& nodes, std::vector<std::vector<int>>& seen) {
    for (const Node& node : nodes) {
        seen[static_cast<std::size_t>(node.particle)].clear();
    }
}

/// What lies within a few contacts of every particle, for distances.
class Neighbourhoods {
public:
    Neighbourhoods(const Walker& walker, int depth) : walker_(walker), near_(static_cast<std::size_t>(walker.particles())) {
#pragma omp parallel
        {
            std::vector<std::vector<int>> seen(near_.size());
#pragma omp for schedule(static)
            for (Index particle = 0; particle < walker.particles(); ++particle) {
                std::vector<Node> nodes = walker.ball(static_cast<std::int32_t>(particle), depth, seen);
                clear(nodes, seen);
                std::stable_sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.particle < b.particle; });
                near_[static_cast<std::size_t>(particle)] = std::move(nodes);
            }
        }
    }

    /// Whether two nodes seen from the same origin are fewer than `steps` contacts apart.
    bool nearer(const Node& from, const Node& to, int steps) const {
        const std::vector<Node>& nodes = near_[static_cast<std::size_t>(from.particle)];
        const Eigen::Vector3d place = to.place - from.place;
        auto node = std::lower_bound(nodes.begin(), nodes.end(), to.particle,
                                     [](const Node& a, std::int32_t particle) { return a.particle < particle; });
        for (; node != nodes.end() && node->particle == to.particle; ++node) {
            if (node->distance < steps && walker_.same_place(node->place, place)) {
                return true;
            }
        }
        return false;
    }

private:
    const Walker& walker_;
    std::vector<std::vector<Node>> near_;
};

using Path = std::vector<int>;  ///< nodes from the origin outwards, the origin left out

/// The rings through one particle.
class RingSearch {
public:
    RingSearch(const Walker& walker, const Neighbourhoods& near, int largest, std::vector<std::vector<int>>& seen)
        : near_(near), largest_(largest), count_(Eigen::VectorXi::Zero(largest + 1)), walker_(walker), seen_(seen) {}

    Eigen::VectorXi run(std::int32_t particle) {
        nodes_ = walker_.ball(particle, largest_ / 2, seen_);
        paths_.assign(nodes_.size(), {});
        beside_.assign(nodes_.size(), {});
        find_paths();
        clear(nodes_, seen_);
        for (std::size_t k = 1; k < nodes_.size(); ++k) {
            count_between(k, k, 2 * nodes_[k].distance);
            for (const int other : beside_[k]) {
                count_between(k, static_cast<std::size_t>(other), 2 * nodes_[k].distance + 1);
            }
        }
        return count_;
    }

private:
    /// All shortest paths from the origin to every node, and the neighbours at the same distance.
    void find_paths() {
        paths_[0] = {{}};
        for (std::size_t k = 1; k < nodes_.size(); ++k) {
            for (const Step& step : walker_.steps(nodes_[k].particle)) {
                const int other = walker_.find(nodes_, seen_, step.other, nodes_[k].place + step.branch);
                if (other < 0) {
                    continue;
                }
                const auto place = static_cast<std::size_t>(other);
                if (nodes_[place].distance < nodes_[k].distance) {
                    for (Path path : paths_[place]) {
                        path.push_back(static_cast<int>(k));
                        paths_[k].push_back(std::move(path));
                    }
                } else if (nodes_[place].distance == nodes_[k].distance && place < k) {
                    beside_[k].push_back(other);
                }
            }
        }
    }

    /// Rings of one path to each of two nodes, which are the same (even size) or neighbours (odd).
    void count_between(std::size_t one, std::size_t other, int size) {
        if (size < 3 || size > largest_) {
            return;
        }
        for (std::size_t a = 0; a < paths_[one].size(); ++a) {
            for (std::size_t b = 0; b < (one == other ? a : paths_[other].size()); ++b) {
                std::vector<int> ring = {0};
                ring.insert(ring.end(), paths_[one][a].begin(), paths_[one][a].end());
                const Path& back = paths_[other][b];
                ring.insert(ring.end(), back.rbegin() + (one == other ? 1 : 0), back.rend());
                count_[size] += is_shortest(ring) ? 1 : 0;
            }
        }
    }

    /// It suffices that opposite nodes are not nearer: from a shorter way between two others one to their opposites would follow.
    bool is_shortest(const std::vector<int>& ring) const {
        const std::size_t half = ring.size() / 2;
        for (std::size_t k = 1; k < ring.size(); ++k) {
            const Node& from = nodes_[static_cast<std::size_t>(ring[k])];
            const Node& to = nodes_[static_cast<std::size_t>(ring[(k + half) % ring.size()])];
            if (near_.nearer(from, to, static_cast<int>(half))) {
                return false;
            }
        }
        return true;
    }

    const Neighbourhoods& near_;
    int largest_;
    Eigen::VectorXi count_;
    const Walker& walker_;
    std::vector<std::vector<int>>& seen_;
    std::vector<Node> nodes_;
    std::vector<std::vector<Path>> paths_;
    std::vector<std::vector<int>> beside_;
};

}  // namespace

Eigen::VectorXd Rings::count() const {
    Eigen::VectorXd count = per_particle.cast<double>().rowwise().sum();
    for (Index size = 1; size < count.size(); ++size) {
        count[size] /= static_cast<double>(size);
    }
    return count;
}

Rings measure_rings(const ContactNetwork& contacts, int largest, const Progress& progress) {
    require(largest >= 3 && largest <= 12, "the largest size of rings must be from 3 to 12");
    const Walker walker(contacts);
    const Neighbourhoods near(walker, largest / 2 - 1);
    Rings rings;
    rings.largest = largest;
    rings.per_particle.resize(largest + 1, contacts.particles);
    constexpr Index batches = 32;
    for (Index batch = 0; batch < batches; ++batch) {
        progress.update("rings", static_cast<double>(batch) / batches);
        const Index end = (batch + 1) * contacts.particles / batches;
#pragma omp parallel
        {
            std::vector<std::vector<int>> seen(static_cast<std::size_t>(contacts.particles));
#pragma omp for schedule(dynamic, 8)
            for (Index particle = batch * contacts.particles / batches; particle < end; ++particle) {
                rings.per_particle.col(particle) = RingSearch(walker, near, largest, seen).run(static_cast<std::int32_t>(particle));
            }
        }
    }
    return rings;
}

}  // namespace coagula::characterize
