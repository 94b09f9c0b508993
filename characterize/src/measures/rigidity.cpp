// SPDX-License-Identifier: GPL-3.0-or-later
// Measures: local rigidity of the network, with normal-and-shear bonds and with central forces only.
#include "distribution.hpp"
#include "inner_sums.hpp"
#include "measure_options.hpp"

#include <coagula/characterize/rigidity.hpp>
#include <coagula/characterize/topology.hpp>

#include <algorithm>

namespace coagula::characterize {

Measure rigidity_measure();
Measure rigidity_central_measure();

namespace {

/// Writes below one group.
class Writer {
public:
    Writer(const MeasureInput& input, const Rigidity& found, std::string group, MeasureResult& result)
        : input_(input), found_(found), group_(std::move(group)), result_(result) {}

    void write() const {
        add_counts();
        add_shares();
        add_check();
        add_components();
        add_distribution();
        const std::string suffix = group_ == "rigidity" ? "" : "_central";
        result_.add_field("local_redundancy" + suffix, found_.particle_redundancy.transpose(), "1",
                          "redundant constraints at the particle, half of each of its contacts': over-braced where large");
        result_.add_field(
            "local_freedom" + suffix, found_.particle_freedom.transpose(), "1",
            "freedoms of the particle less half of the independent constraints of its contacts: under-braced where large");
        result_.add_line(
            group_ == "rigidity" ? "floppy modes" : "floppy modes, central forces",
            std::to_string(found_.floppy_modes) + ", " + std::to_string(found_.rattler_modes) + " of them motions of rattlers");
        result_.add_line(group_ == "rigidity" ? "states of self-stress" : "states of self-stress, central forces",
                         std::to_string(found_.self_stresses) + " of " + std::to_string(found_.constraints) + " constraints");
    }

    void write_clusters() const {
        const RigidClusters& rigid = found_.rigid;
        const auto count = static_cast<Index>(rigid.clusters.size());
        Eigen::VectorXi sizes(count);
        std::transform(rigid.clusters.begin(), rigid.clusters.end(), sizes.begin(),
                       [](const Cluster& cluster) { return static_cast<int>(cluster.particles); });
        Eigen::MatrixXd values(3, rigid.of_particle.size());
        values << Eigen::RowVectorXd::Ones(values.cols()), (rigid.of_particle.transpose().array() == 0).cast<double>(),
            (rigid.of_particle.transpose().array() < 0).cast<double>();
        const auto shares = [](const Eigen::VectorXd& sums) -> Eigen::VectorXd { return sums.tail<2>() / sums[0]; };
        const Eigen::VectorXd share = shares(sum_inner(input_, values));
        const Eigen::VectorXd error = errors_of_means(input_, values, shares);
        const Index windings = count > 0 ? static_cast<Index>(rigid.clusters.front().windings.size()) : 0;
        count_of("rigid_clusters", count, "clusters of two or more particles that move as one in every floppy motion");
        add("largest_fraction", share[0], "particles in the largest rigid cluster over all", error[0]);
        add("loose_fraction", share[1], "particles that move against all their neighbours over all", error[1]);
        count_of("largest_windings", windings,
                 "linearly independent ways in which the largest rigid cluster reaches around the box");
        result_.add_counts(group_ + "/cluster_particles", sizes, "particles of each rigid cluster, largest first");
        result_.add_vector(group_ + "/cluster_self_stress", rigid.self_stress, "1",
                           "redundant constraints among the contacts within each rigid cluster");
        result_.add_field("rigid_cluster", (rigid.of_particle.array() + 1).cast<double>().matrix().transpose(), "1",
                          "rigid cluster of the particle, 1 the largest; 0: moves against all its neighbours");
        result_.add_line("rigid clusters", std::to_string(count) + ", the largest has " + with_unit(100 * share[0], "%") +
                                               " of the particles and reaches around the box in " + std::to_string(windings) +
                                               " independent ways");
    }

private:
    void add(const std::string& name, double value, const std::string& description, double error = unset) const {
        result_.add(group_ + "/" + name, value, "1", description, error);
    }
    void count_of(const std::string& name, Index value, const std::string& description) const {
        result_.add_count(group_ + "/" + name, value, description);
    }

    void add_counts() const {
        count_of("unknowns", found_.unknowns, "displacements and rotations");
        count_of("constraints", found_.constraints, "relative displacements that contacts constrain");
        count_of("rank", found_.rank, "rank of the rigidity matrix: number of independent constraints");
        count_of("rigid_motions", found_.rigid_motions, "motions of the sample as a whole");
        count_of("floppy_modes", found_.floppy_modes, "other motions without stiffness: unknowns - rank - rigid_motions");
        count_of("rattler_modes", found_.rattler_modes, "floppy modes that are motions of rattlers");
        count_of("self_stresses", found_.self_stresses, "states of self-stress: constraints - rank");
    }

    void add_shares() const {
        const ContactNetwork& contacts = input_.contacts();
        Eigen::MatrixXd values(5, found_.particle_redundancy.size());
        values << Eigen::RowVectorXd::Ones(values.cols()), found_.particle_freedom.transpose(),
            found_.particle_redundancy.transpose(), contact_counts(contacts).cast<double>().transpose(),
            Eigen::RowVectorXd::Zero(values.cols());
        for (Index contact = 0; contact < contacts.size(); ++contact) {
            for (int end = 0; end < 2; ++end) {
                values(4, contacts.ends(end, contact)) += 0.5 * found_.normal_redundancy[contact];
            }
        }
        const auto shares = [](const Eigen::VectorXd& sums) -> Eigen::VectorXd {
            const double contact_sum = std::max(0.5 * sums[3], 0.5);
            return Eigen::Vector4d(sums[1] / sums[0], sums[2] / sums[0], sums[2] / contact_sum, sums[4] / contact_sum);
        };
        const Eigen::VectorXd value = shares(sum_inner(input_, values));
        const Eigen::VectorXd error = errors_of_means(input_, values, shares);
        add("freedom_per_particle", value[0], "motions without stiffness per particle", error[0]);
        add("redundancy_per_particle", value[1], "states of self-stress per particle", error[1]);
        add("redundancy_per_contact", value[2], "states of self-stress per contact", error[2]);
        add("normal_redundancy_per_contact", value[3], "their part along the lines of centres", error[3]);
    }

    void add_check() const {
        add("largest_zero", found_.largest_zero, "largest |A x| / |x| of the motions that count as floppy, A the rigidity matrix");
        if (std::isfinite(found_.smallest_nonzero)) {
            add("smallest_nonzero", found_.smallest_nonzero, "lower estimate of the smallest other singular value of A");
        }
        add("trace_defect", found_.trace_defect, "|sum of the local redundancies - self_stresses|: rounding errors");
    }

    void add_distribution() const {
        constexpr Index bins = 40;
        const double high = std::max(1.0, std::ceil(found_.particle_redundancy.maxCoeff() * (1 + 1e-9)));
        result_.add_vector(group_ + "/redundancy", middles_of_bins(0, high, bins), "1",
                           "middles of the bins of the local redundancy");
        result_.add_vector(group_ + "/redundancy_density", density_in_bins(found_.particle_redundancy, 0, high, bins), "1",
                           "probability density of the local redundancy of a particle");
    }

    /// The null spaces split into those of the connected clusters, so these sums are whole numbers.
    void add_components() const {
        const Topology topology = measure_topology(input_.packing(), input_.contacts());
        const auto count = static_cast<Index>(topology.clusters.size());
        Eigen::VectorXd freedom = Eigen::VectorXd::Zero(count);
        Eigen::VectorXd redundancy = Eigen::VectorXd::Zero(count);
        for (Index particle = 0; particle < topology.of_particle.size(); ++particle) {
            if (topology.of_particle[particle] >= 0) {
                freedom[topology.of_particle[particle]] += found_.particle_freedom[particle];
                redundancy[topology.of_particle[particle]] += found_.particle_redundancy[particle];
            }
        }
        result_.add_vector(
            group_ + "/connected_modes", freedom.array().round(), "1",
            "motions without stiffness of each connected cluster, its own as a whole included, largest cluster first");
        result_.add_vector(group_ + "/connected_self_stress", redundancy.array().round(), "1",
                           "states of self-stress of each connected cluster");
    }

    const MeasureInput& input_;
    const Rigidity& found_;
    std::string group_;
    MeasureResult& result_;
};

MeasureResult measure(const MeasureInput& input, Bonds bonds, const std::string& group) {
    Rigidity found;
    try {
        found = measure_rigidity(input.packing(), input.contacts(), {.bonds = bonds, .seed = input.seed()}, input.progress());
    } catch (const TooLarge& error) {
        throw NotApplicable(error.what());
    }
    MeasureResult result;
    const Writer writer(input, found, group, result);
    writer.write();
    if (bonds == Bonds::normal_and_shear) {
        writer.write_clusters();
    }
    return result;
}

}  // namespace

Measure rigidity_measure() {
    return {.name = "rigidity",
            .summary = "floppy modes, self-stress, local redundancy, rigid clusters",
            .run = [](const MeasureInput& input) { return measure(input, Bonds::normal_and_shear, "rigidity"); },
            .options = {contact_tolerance_option()},
            .by_default = false};
}

Measure rigidity_central_measure() {
    return {.name = "rigidity_central",
            .summary = "floppy modes, self-stress, local redundancy, rigid clusters with central contact forces only",
            .run = [](const MeasureInput& input) { return measure(input, Bonds::central, "rigidity_central"); },
            .options = {contact_tolerance_option()},
            .by_default = false};
}

}  // namespace coagula::characterize
