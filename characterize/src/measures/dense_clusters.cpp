// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: clusters of triangles and of tetrahedra of contacts, and the contacts between them.
#include "inner_sums.hpp"
#include "measure_options.hpp"

#include <coagula/characterize/cliques.hpp>
#include <coagula/common/percolation.hpp>

#include <algorithm>

namespace coagula::characterize {

Measure dense_clusters_measure();

namespace {

/// Means over the particles, from sums of 1 and of the values.
Eigen::VectorXd means_of(const Eigen::VectorXd& sums) {
    return sums.tail(sums.size() - 1) / sums[0];
}

/// Writes below one group: dense_clusters/triangles or dense_clusters/tetrahedra.
class DenseClusterWriter {
public:
    DenseClusterWriter(const MeasureInput& input, const Cliques& cliques, int size, MeasureResult& result)
        : input_(input),
          found_(find_clique_communities(input.contacts(), cliques, size)),
          name_(size == 3 ? "triangles" : "tetrahedra"),
          joined_by_(size == 3 ? "a side" : "a face"),
          result_(result) {}

    void write() const {
        const auto count = static_cast<Index>(found_.communities.size());
        result_.add_count(
            path("clusters"), count,
            "clusters of " + name_ + " of contacts, of which each shares " + joined_by_ + " with another one of its cluster");
        add_sizes();
        add_shares();
        result_.add_count(path("largest_windings"), windings_of_largest(),
                          "linearly independent ways in which the largest cluster reaches around the box, 0 to 3");
        result_.add_field("cluster_of_" + name_, places().transpose(), "1",
                          "largest cluster of " + name_ + " that the particle belongs to, 1 the largest of all; 0: none");
    }

private:
    std::string path(const std::string& key) const { return "dense_clusters/" + name_ + "/" + key; }

    void add_sizes() const {
        double sum = 0, squares = 0;
        for (const CliqueCommunity& one : found_.communities) {
            const auto particles = static_cast<double>(one.particles.size());
            sum += particles;
            squares += particles * particles;
        }
        const auto count = std::max(1.0, static_cast<double>(found_.communities.size()));
        const double weighted = sum > 0 ? squares / sum : 0.0;
        result_.add(path("mean_size"), sum / count, "1", "particles of a cluster, mean over the clusters");
        result_.add(path("weighted_mean_size"), weighted, "1", "particles of a cluster, mean weighted by the particles");
        result_.add_line("clusters of " + name_, std::to_string(found_.communities.size()) + ", of " + with_unit(sum / count, "1") +
                                                     " particles on average, weighted by size " + with_unit(weighted, "1"));
    }

    /// 1, membership of the largest, of any and of several clusters, half of the contacts between clusters and of those that leave
    /// them, per particle.
    Eigen::MatrixXd particle_values() const {
        Eigen::MatrixXd values = Eigen::MatrixXd::Zero(6, input_.packing().size());
        values.row(0).setOnes();
        for (Index particle = 0; particle < values.cols(); ++particle) {
            const std::vector<int>& own = found_.of_particle[static_cast<std::size_t>(particle)];
            values(1, particle) = !own.empty() && own.front() == 0 ? 1 : 0;
            values(2, particle) = own.empty() ? 0 : 1;
            values(3, particle) = own.size() > 1 ? 1 : 0;
        }
        const ContactNetwork& contacts = input_.contacts();
        for (Index contact = 0; contact < contacts.size(); ++contact) {
            const Index first = contacts.ends(0, contact), second = contacts.ends(1, contact);
            if (!found_.share_one(first, second)) {
                const Index row = values(2, first) > 0 && values(2, second) > 0 ? 4 : 5;
                values(row, first) += 0.5;
                values(row, second) += 0.5;
            }
        }
        return values;
    }

    void add_shares() const {
        const Eigen::MatrixXd values = particle_values();
        const Eigen::VectorXd mean = means_of(sum_inner(input_, values));
        Eigen::VectorXd error = errors_of_means(input_, values, means_of);
        constexpr Index fewest = 20;  // particles with a part in the mean; of fewer the blocks say too little
        for (Index one = 0; one < error.size(); ++one) {
            error[one] = (values.row(1 + one).array() > 0).count() < fewest ? unset : error[one];
        }
        result_.add(path("largest_fraction"), mean[0], "1", "particles in the largest cluster over all");
        result_.add(path("fraction"), mean[1], "1", "particles in some cluster over all", error[1]);
        result_.add(path("shared_fraction"), mean[2], "1", "particles that belong to two or more clusters over all", error[2]);
        result_.add(path("contacts_between"), mean[3], "1",
                    "contacts between particles of clusters that have no cluster in common, per particle", error[3]);
        result_.add(path("contacts_outside"), mean[4], "1", "contacts of particles that belong to no cluster, per particle",
                    error[4]);
    }

    Index windings_of_largest() const {
        if (found_.communities.empty()) {
            return 0;
        }
        std::vector<bool> own(static_cast<std::size_t>(input_.contacts().size()));
        for (const Index contact : found_.communities.front().contacts) {
            own[static_cast<std::size_t>(contact)] = true;
        }
        return static_cast<Index>(find_clusters(input_.packing(), input_.contacts(), own).front().windings.size());
    }

    Eigen::VectorXd places() const {
        Eigen::VectorXd places(input_.packing().size());
        for (Index particle = 0; particle < places.size(); ++particle) {
            const std::vector<int>& own = found_.of_particle[static_cast<std::size_t>(particle)];
            places[particle] = own.empty() ? 0 : own.front() + 1;
        }
        return places;
    }

    const MeasureInput& input_;
    CliqueCommunities found_;
    std::string name_;       ///< of the cliques
    std::string joined_by_;  ///< what two of them have in common
    MeasureResult& result_;
};

MeasureResult run_dense_clusters(const MeasureInput& input) {
    const Cliques cliques = find_cliques(input.contacts());
    MeasureResult result;
    for (const int size : {3, 4}) {
        DenseClusterWriter(input, cliques, size, result).write();
    }
    return result;
}

}  // namespace

Measure dense_clusters_measure() {
    return {.name = "dense_clusters",
            .summary = "clusters of triangles and of tetrahedra of contacts: size, contacts between them",
            .run = run_dense_clusters,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
