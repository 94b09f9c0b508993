// SPDX-License-Identifier: GPL-3.0-or-later
#include "frequency_pairs.hpp"

#include <coagula/mechanics/linear.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace coagula::mechanics {

namespace {

/// Finds whether a pair of particles is bonded through the same image of the cell.
class BondFinder {
public:
    BondFinder(const Packing& packing, const ContactNetwork& bonds) : bonds_(bonds), same_(1e-3 * mean_radius(packing)) {
        for (Index bond = 0; bond < bonds.size(); ++bond) {
            bonds_of_[ends(bonds, bond)].push_back(bond);
        }
    }
    bool has(const ContactNetwork& pairs, Index pair) const {
        const auto found = bonds_of_.find(ends(pairs, pair));
        return found != bonds_of_.end() && std::any_of(found->second.begin(), found->second.end(), [&](Index bond) {
                   return (oriented(bonds_, bond) - oriented(pairs, pair)).norm() < same_ ||
                          (is_own_image(bond) && (oriented(bonds_, bond) + oriented(pairs, pair)).norm() < same_);
               });
    }

private:
    static std::array<std::int32_t, 2> ends(const ContactNetwork& pairs, Index pair) {
        return {std::min(pairs.ends(0, pair), pairs.ends(1, pair)), std::max(pairs.ends(0, pair), pairs.ends(1, pair))};
    }
    static Eigen::Vector3d oriented(const ContactNetwork& pairs, Index pair) {
        return pairs.ends(0, pair) <= pairs.ends(1, pair) ? Eigen::Vector3d(pairs.branch.col(pair))
                                                          : Eigen::Vector3d(-pairs.branch.col(pair));
    }
    bool is_own_image(Index bond) const { return bonds_.ends(0, bond) == bonds_.ends(1, bond); }

    const ContactNetwork& bonds_;
    double same_;
    std::map<std::array<std::int32_t, 2>, std::vector<Index>> bonds_of_;
};

double gap_of(const Packing& packing, const ContactNetwork& pairs, Index pair) {
    return pairs.branch.col(pair).norm() - packing.radii[pairs.ends(0, pair)] - packing.radii[pairs.ends(1, pair)];
}

/// The bonds, then the neighbours in `near` that have a film and no bond.
ContactNetwork joined(const Packing& packing, const ContactNetwork& bonds, const ContactNetwork& near, double cutoff) {
    const BondFinder finder(packing, bonds);
    std::vector<Index> films;
    for (Index pair = 0; pair < near.size(); ++pair) {
        if (gap_of(packing, near, pair) < cutoff && !finder.has(near, pair)) {
            films.push_back(pair);
        }
    }
    ContactNetwork all = bonds;
    const auto count = bonds.size() + static_cast<Index>(films.size());
    all.ends.conservativeResize(Eigen::NoChange, count);
    all.branch.conservativeResize(Eigen::NoChange, count);
    for (std::size_t k = 0; k < films.size(); ++k) {
        const Index place = bonds.size() + static_cast<Index>(k);
        all.ends.col(place) = near.ends.col(films[k]);
        all.branch.col(place) = near.branch.col(films[k]);
    }
    return all;
}

}  // namespace

FrequencyPairs find_frequency_pairs(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model) {
    FrequencyPairs pairs{bonds, bonds.size(), bond_tangents(packing, bonds, model), {}, {}};
    const double cutoff = model.lubrication_cutoff;
    if (!std::isnan(cutoff)) {
        pairs.network = joined(packing, bonds, find_pairs(packing, 2 * packing.radii.maxCoeff() + cutoff), cutoff);
    }
    const auto count = static_cast<std::size_t>(pairs.network.size());
    pairs.tangents.resize(count);
    pairs.film.assign(count, 0.0);
    pairs.rough.assign(count, false);
    for (std::size_t pair = 0; pair < count && !std::isnan(cutoff); ++pair) {
        const double gap = gap_of(packing, pairs.network, static_cast<Index>(pair));
        const double first = packing.radii[pairs.network.ends(0, static_cast<Index>(pair))];
        const double second = packing.radii[pairs.network.ends(1, static_cast<Index>(pair))];
        const double radius = first * second / (first + second);
        if (gap < cutoff) {
            pairs.rough[pair] = gap < model.lubrication_gap;
            pairs.film[pair] = 6 * std::numbers::pi * radius * radius / std::max(gap, model.lubrication_gap);
        }
    }
    return pairs;
}

}  // namespace coagula::mechanics
