// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: edge betweenness of the contact network.
#include "measure_options.hpp"

#include <coagula/characterize/betweenness.hpp>

namespace coagula::characterize {

Measure betweenness_measure();

namespace {

/// The betweenness of each contact, with the particles that it joins.
void add_contact_values(const ContactNetwork& contacts, const Betweenness& found, MeasureResult& result) {
    const std::string group = "/characterization/betweenness/";
    const std::string order = ", in the order of betweenness/contacts";
    Dataset bonds = {.path = group + "contacts",
                     .shape = {static_cast<std::size_t>(contacts.size()), 2},
                     .values = std::vector<std::int64_t>(contacts.ends.data(), contacts.ends.data() + contacts.ends.size()),
                     .unit = "1",
                     .description = "ids of the two particles that each contact joins"};
    result.contact_results.push_back(std::move(bonds));
    result.contact_results.push_back(dataset::columns(group + "branch_vectors", contacts.branch, "m",
                                                      "centre of the second minus centre of the first particle" + order));
    result.contact_results.push_back(
        dataset::vector(group + "of_contact", found.of_contact, "1", "betweenness of each contact" + order));
}

/// Half of the sum over the contacts of each particle.
Eigen::VectorXd halves_at_particles(const ContactNetwork& contacts, const Eigen::VectorXd& of_contact) {
    Eigen::VectorXd halves = Eigen::VectorXd::Zero(contacts.particles);
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        halves[contacts.ends(0, contact)] += 0.5 * of_contact[contact];
        halves[contacts.ends(1, contact)] += 0.5 * of_contact[contact];
    }
    return halves;
}

MeasureResult run_betweenness(const MeasureInput& input) {
    const ContactNetwork& contacts = input.contacts();
    const Betweenness found = measure_betweenness(contacts, input.progress());
    const double top = found.share_of_largest(0.1);
    MeasureResult result;
    result.add("betweenness/mean", found.mean(), "1",
               "share of the pairs of particles whose shortest way runs through a contact, mean over the contacts");
    result.add("betweenness/spread", found.spread(), "1", "standard deviation of the betweenness of a contact over its mean");
    result.add("betweenness/top_tenth_share", top, "1",
               "share of the total betweenness on the tenth of the contacts that has most of it");
    result.add("betweenness/mean_distance", found.mean_distance, "1",
               "contacts on the shortest way between two particles, mean over the pairs that a way joins");
    result.add("betweenness/connected_pairs", found.connected_pairs, "1", "share of the pairs of particles that a way joins");
    result.add_field("betweenness", halves_at_particles(contacts, found.of_contact).transpose(), "1",
                     "half of the betweenness of the contacts of the particle");
    add_contact_values(contacts, found, result);
    result.add_line("betweenness of the contacts", "spread " + with_unit(found.spread(), "1") +
                                                       " of the mean; the upper tenth carries " + with_unit(100 * top, "%"));
    result.add_line("distance through the network",
                    with_unit(found.mean_distance, "1") + " contacts between two particles on average");
    return result;
}

}  // namespace

Measure betweenness_measure() {
    return {.name = "betweenness",
            .summary = "shortest ways through the network: how many pass through each contact (Brandes)",
            .run = run_betweenness,
            .options = {contact_tolerance_option()},
            .by_default = false};
}

}  // namespace coagula::characterize
