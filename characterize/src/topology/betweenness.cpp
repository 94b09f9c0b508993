// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/betweenness.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace coagula::characterize {

namespace {

/// Contacts of each particle, with the particle at the other end.
class Adjacency {
public:
    struct Edge {
        std::int32_t other, contact;
    };

    explicit Adjacency(const ContactNetwork& contacts) {
        const ContactsByParticle grouped = group_by_particle(contacts);
        start_ = grouped.start;
        for (Index particle = 0; particle < contacts.particles; ++particle) {
            for (Index entry = start_[static_cast<std::size_t>(particle)]; entry < start_[static_cast<std::size_t>(particle) + 1];
                 ++entry) {
                const Index contact = grouped.contact[static_cast<std::size_t>(entry)];
                const std::int32_t first = contacts.ends(0, contact);
                edges_.push_back({first == particle ? contacts.ends(1, contact) : first, static_cast<std::int32_t>(contact)});
            }
        }
    }

    template <class Visit>
    void visit(std::int32_t particle, Visit&& visit) const {
        const auto end = static_cast<std::size_t>(start_[static_cast<std::size_t>(particle) + 1]);
        for (auto entry = static_cast<std::size_t>(start_[static_cast<std::size_t>(particle)]); entry < end; ++entry) {
            visit(edges_[entry]);
        }
    }

private:
    std::vector<Index> start_;
    std::vector<Edge> edges_;
};

/// Sums over the ways that begin at some of the particles.
struct WaySums {
    Eigen::VectorXd of_contact;  ///< M
    double distance = 0;
    double pairs = 0;
};

/// The shortest ways from one particle after another. The scratch arrays are kept between calls.
class ShortestWays {
public:
    ShortestWays(const Adjacency& network, Index particles)
        : network_(network),
          distance_(static_cast<std::size_t>(particles)),
          ways_(distance_.size()),
          dependency_(distance_.size()) {}

    void add_from(std::int32_t source, WaySums& sums) {
        search(source);
        for (const std::int32_t particle : order_) {
            sums.distance += at(distance_, particle);
        }
        sums.pairs += static_cast<double>(order_.size()) - 1;
        accumulate(sums.of_contact);
    }

private:
    template <class Value>
    static Value& at(std::vector<Value>& values, std::int32_t particle) {
        return values[static_cast<std::size_t>(particle)];
    }

    /// A contact on a shortest way: `to` is one contact farther from the source than `from`.
    struct Stride {
        std::int32_t from, to, contact;
    };

    /// Breadth first: order, distance and number of shortest ways of each particle reached, and the strides, nearest first.
    void search(std::int32_t source) {
        std::fill(distance_.begin(), distance_.end(), -1);
        order_ = {source};
        strides_.clear();
        at(distance_, source) = 0;
        at(ways_, source) = 1;
        for (std::size_t place = 0; place < order_.size(); ++place) {
            const std::int32_t here = order_[place];
            const int next = at(distance_, here) + 1;
            network_.visit(here, [&](const Adjacency::Edge& edge) {
                if (at(distance_, edge.other) < 0) {
                    at(distance_, edge.other) = next;
                    at(ways_, edge.other) = 0;
                    order_.push_back(edge.other);
                }
                if (at(distance_, edge.other) == next) {
                    at(ways_, edge.other) += at(ways_, here);
                    strides_.push_back({here, edge.other, edge.contact});
                }
            });
        }
    }

    /// Brandes' dependencies, from the farthest particles inwards: each hands 1 and what was handed to it on to the contacts
    /// towards the source, by their shares of the ways.
    void accumulate(Eigen::VectorXd& of_contact) {
        std::fill(dependency_.begin(), dependency_.end(), 0.0);
        for (auto stride = strides_.rbegin(); stride != strides_.rend(); ++stride) {
            const double share = at(ways_, stride->from) / at(ways_, stride->to) * (1 + at(dependency_, stride->to));
            of_contact[stride->contact] += share;
            at(dependency_, stride->from) += share;
        }
    }

    const Adjacency& network_;
    std::vector<int> distance_;  ///< from the source; -1: not reached
    std::vector<double> ways_;
    std::vector<double> dependency_;
    std::vector<std::int32_t> order_;
    std::vector<Stride> strides_;
};

constexpr Index batches = 64;  ///< of sources; their sums are added in order, so that threads do not change a bit

/// One batch of sources after another, each by one thread.
std::vector<WaySums> sums_of_batches(const ContactNetwork& contacts, const Progress& progress) {
    const Adjacency network(contacts);
    std::vector<WaySums> sums(batches, {Eigen::VectorXd::Zero(contacts.size())});
    constexpr Index rounds = 8;
    for (Index round = 0; round < rounds; ++round) {
        progress.update("betweenness", static_cast<double>(round) / rounds);
#pragma omp parallel
        {
            ShortestWays ways(network, contacts.particles);
#pragma omp for schedule(dynamic)
            for (Index batch = round * batches / rounds; batch < (round + 1) * batches / rounds; ++batch) {
                const Index end = (batch + 1) * contacts.particles / batches;
                for (Index source = batch * contacts.particles / batches; source < end; ++source) {
                    ways.add_from(static_cast<std::int32_t>(source), sums[static_cast<std::size_t>(batch)]);
                }
            }
        }
    }
    return sums;
}

}  // namespace

double Betweenness::spread() const {
    const double middle = mean();
    return middle > 0 ? std::sqrt((of_contact.array() - middle).square().mean()) / middle : 0.0;
}

double Betweenness::share_of_largest(double fraction) const {
    Eigen::VectorXd sorted = of_contact;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    const double wanted = fraction * static_cast<double>(sorted.size());
    const auto whole = std::min(static_cast<Index>(wanted), sorted.size());
    const double part = whole < sorted.size() ? (wanted - static_cast<double>(whole)) * sorted[whole] : 0.0;
    const double sum = sorted.sum();
    return sum > 0 ? (sorted.head(whole).sum() + part) / sum : 0.0;
}

Betweenness measure_betweenness(const ContactNetwork& contacts, const Progress& progress) {
    WaySums all = {Eigen::VectorXd::Zero(contacts.size())};
    for (const WaySums& batch : sums_of_batches(contacts, progress)) {
        all.of_contact += batch.of_contact;
        all.distance += batch.distance;
        all.pairs += batch.pairs;
    }
    // Every pair was met from both ends.
    const auto n = static_cast<double>(contacts.particles);
    const double both_ways = std::max(1.0, n * (n - 1));
    return {.of_contact = all.of_contact / both_ways,
            .connected_pairs = all.pairs / both_ways,
            .mean_distance = all.pairs > 0 ? all.distance / all.pairs : 0.0};
}

}  // namespace coagula::characterize
