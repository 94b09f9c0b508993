// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/coordination.hpp>

#include <coagula/characterize/inner_particles.hpp>

#include <algorithm>

namespace coagula::characterize {

namespace {

void add_means(const std::vector<bool>& inner, const Eigen::VectorXi& left, Coordination& result) {
    const bool any_inner = std::find(inner.begin(), inner.end(), true) != inner.end();
    double particles = 0, contacts = 0, rattlers = 0, below_three = 0, kept_contacts = 0;
    for (Index i = 0; i < result.counts.size(); ++i) {
        if (any_inner && !inner[static_cast<std::size_t>(i)]) {
            continue;
        }
        particles += 1;
        contacts += result.counts[i];
        rattlers += left[i] < 0 ? 1 : 0;
        below_three += result.counts[i] < 3 ? 1 : 0;
        kept_contacts += std::max(left[i], 0);
    }
    result.mean = contacts / particles;
    result.mean_without_rattlers = particles > rattlers ? kept_contacts / (particles - rattlers) : 0.0;
    result.rattler_fraction = rattlers / particles;
    result.below_three_fraction = below_three / particles;
    result.inner_particles = any_inner ? static_cast<Index>(particles) : 0;
}

}  // namespace

Eigen::VectorXi prune_rattlers(const ContactNetwork& contacts) {
    const ContactsByParticle groups = group_by_particle(contacts);
    Eigen::VectorXi left = contact_counts(contacts);
    std::vector<char> broken(static_cast<std::size_t>(contacts.size()), 0);
    std::vector<Index> pending;
    for (Index particle = 0; particle < left.size(); ++particle) {
        if (left[particle] < 2) {
            pending.push_back(particle);
        }
    }
    while (!pending.empty()) {
        const auto particle = static_cast<std::size_t>(pending.back());
        pending.pop_back();
        left[static_cast<Index>(particle)] = -1;
        for (Index entry = groups.start[particle]; entry < groups.start[particle + 1]; ++entry) {
            const Index contact = groups.contact[static_cast<std::size_t>(entry)];
            const Index first = contacts.ends(0, contact);
            const Index other = first == static_cast<Index>(particle) ? contacts.ends(1, contact) : first;
            if (broken[static_cast<std::size_t>(contact)] == 0 && left[other] >= 0 && --left[other] == 1) {
                pending.push_back(other);
            }
            broken[static_cast<std::size_t>(contact)] = 1;
        }
    }
    return left;
}

Coordination measure_coordination(const Packing& packing, const CoordinationOptions& options) {
    const std::vector<bool> inner = inner_particles(packing);
    Coordination result;
    result.contacts = find_contacts(packing, options.contact_tolerance);
    result.counts = contact_counts(result.contacts);
    result.mean_all = coordination_number(result.contacts);
    result.histogram = Eigen::VectorXi::Zero(result.counts.maxCoeff() + 1);
    for (const int count : result.counts) {
        ++result.histogram[count];
    }
    add_means(inner, prune_rattlers(result.contacts), result);
    return result;
}

Overlaps measure_overlaps(const Packing& packing) {
    check(packing);
    const ContactNetwork contacts = find_contacts(packing, 0);
    Overlaps overlaps{0, 0, 0, contacts.size(), 0};
    for (Index pair = 0; pair < contacts.size(); ++pair) {
        const double touching = packing.radii[contacts.ends(0, pair)] + packing.radii[contacts.ends(1, pair)];
        const double overlap = 1 - contacts.branch.col(pair).norm() / touching;
        overlaps.mean += overlap;
        overlaps.rms += overlap * overlap;
        overlaps.max = std::max(overlaps.max, overlap);
        overlaps.implied_noise += overlap * overlap * touching * touching;
    }
    if (overlaps.pairs > 0) {
        overlaps.mean /= static_cast<double>(overlaps.pairs);
        overlaps.implied_noise = std::sqrt(overlaps.implied_noise / (2 * static_cast<double>(overlaps.pairs)));
        overlaps.rms = std::sqrt(overlaps.rms / static_cast<double>(overlaps.pairs));
    }
    return overlaps;
}

}  // namespace coagula::characterize
