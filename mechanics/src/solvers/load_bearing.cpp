// SPDX-License-Identifier: GPL-3.0-or-later
#include "load_bearing.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <utility>

namespace coagula::mechanics {

namespace {

/// Sine of the angle between two links above which they certainly do not lie on one line.
constexpr double certainly_bent = 1e-3;

/// Particles whose stiffness matrix, about 1.7 kB each, does not fit the cache.
constexpr std::size_t large_network = 6000;

/// Bonds of a network while some of them are being removed.
class Pruner {
public:
    Pruner(const ContactNetwork& network, const std::vector<bool>& held, bool moments)
        : network_(network),
          moments_(moments),
          held_(held.empty() ? std::vector<bool>(static_cast<std::size_t>(network.particles), false) : held),
          groups_(group_by_particle(network)),
          alive_(static_cast<std::size_t>(network.size()), true),
          degree_(contact_counts(network)) {
        for (Index particle = 0; particle < network.particles; ++particle) {
            queue_.push_back(particle);
        }
    }

    void run() {
        while (!queue_.empty()) {
            const Index particle = queue_.front();
            queue_.pop_front();
            if (is_held(particle)) {
                continue;
            }
            if (degree_[particle] == 1 || (!moments_ && degree_[particle] == 2 && begins_slack_chain(particle))) {
                remove_bonds(particle);
            }
        }
    }

    LoadBearing result() const {
        LoadBearing kept;
        kept.number.assign(static_cast<std::size_t>(network_.particles), -1);
        for (Index particle = 0; particle < network_.particles; ++particle) {
            if (degree_[particle] > 0 && !is_held(particle)) {
                kept.number[static_cast<std::size_t>(particle)] = static_cast<Index>(kept.particle.size());
                kept.particle.push_back(particle);
            }
        }
        for (Index bond = 0; bond < network_.size(); ++bond) {
            if (alive_[static_cast<std::size_t>(bond)]) {
                kept.bond.push_back(bond);
            }
        }
        return kept;
    }

private:
    bool is_held(Index particle) const { return held_[static_cast<std::size_t>(particle)]; }

    Index other_end(Index bond, Index particle) const {
        return network_.ends(0, bond) == particle ? network_.ends(1, bond) : network_.ends(0, bond);
    }

    /// The two bonds of a particle of degree two.
    std::array<Index, 2> two_bonds(Index particle) const {
        std::array<Index, 2> bonds{-1, -1};
        std::size_t found = 0;
        const auto row = static_cast<std::size_t>(particle);
        for (Index entry = groups_.start[row]; entry < groups_.start[row + 1]; ++entry) {
            const Index bond = groups_.contact[static_cast<std::size_t>(entry)];
            if (alive_[static_cast<std::size_t>(bond)]) {
                bonds[found++] = bond;
            }
        }
        return bonds;
    }

    /// Direction of the link that a particle of degree two makes between its two contact points.
    Eigen::Vector3d link(Index particle) const {
        const auto bonds = two_bonds(particle);
        Eigen::Vector3d direction = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < 2; ++k) {
            const double away = network_.ends(0, bonds[k]) == particle ? 1.0 : -1.0;
            direction += (k == 0 ? -away : away) * network_.branch.col(bonds[k]);
        }
        return direction;
    }

    bool begins_slack_chain(Index particle) const {
        const auto bonds = two_bonds(particle);
        return std::any_of(bonds.begin(), bonds.end(), [&](Index bond) {
            const Index neighbour = other_end(bond, particle);
            return neighbour != particle && degree_[neighbour] == 2 && !is_held(neighbour) && bent(particle, neighbour);
        });
    }

    bool bent(Index first, Index second) const {
        const Eigen::Vector3d one = link(first);
        const Eigen::Vector3d other = link(second);
        return one.cross(other).norm() > certainly_bent * one.norm() * other.norm();
    }

    void remove_bonds(Index particle) {
        const auto row = static_cast<std::size_t>(particle);
        for (Index entry = groups_.start[row]; entry < groups_.start[row + 1]; ++entry) {
            const Index bond = groups_.contact[static_cast<std::size_t>(entry)];
            if (alive_[static_cast<std::size_t>(bond)]) {
                alive_[static_cast<std::size_t>(bond)] = false;
                for (int end = 0; end < 2; ++end) {
                    --degree_[network_.ends(end, bond)];
                    queue_.push_back(network_.ends(end, bond));
                }
            }
        }
    }

    const ContactNetwork& network_;
    bool moments_;
    std::vector<bool> held_;
    ContactsByParticle groups_;
    std::vector<bool> alive_;
    Eigen::VectorXi degree_;
    std::deque<Index> queue_;
};

/// Place on the Morton curve through 1024^3 boxes: the bits of the three coordinates in turn.
std::uint32_t morton_number(const Eigen::Vector3d& fraction) {
    std::uint32_t number = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto box = static_cast<std::uint32_t>(std::clamp(1024 * fraction[axis], 0.0, 1023.0));
        for (unsigned bit = 0; bit < 10; ++bit) {
            number |= ((box >> bit) & 1U) << (3 * bit + axis);
        }
    }
    return number;
}

}  // namespace

LoadBearing find_load_bearing(const ContactNetwork& network, const std::vector<bool>& held, bool moments) {
    Pruner pruner(network, held, moments);
    pruner.run();
    return pruner.result();
}

void sort_along_curve(LoadBearing& kept, const ContactNetwork& network, const Packing& packing) {
    if (kept.particle.size() < large_network) {
        return;
    }
    std::vector<std::pair<std::uint32_t, Index>> order;
    order.reserve(kept.particle.size());
    for (const Index particle : kept.particle) {
        order.emplace_back(morton_number(packing.cell.fraction(packing.cell.wrap(packing.positions.col(particle)))), particle);
    }
    std::sort(order.begin(), order.end());
    for (std::size_t place = 0; place < order.size(); ++place) {
        kept.particle[place] = order[place].second;
        kept.number[static_cast<std::size_t>(order[place].second)] = static_cast<Index>(place);
    }
    const auto ends = [&](Index bond) {
        const Index first = kept.number[static_cast<std::size_t>(network.ends(0, bond))];
        const Index second = kept.number[static_cast<std::size_t>(network.ends(1, bond))];
        return std::pair(std::min(first, second), std::max(first, second));
    };
    std::sort(kept.bond.begin(), kept.bond.end(), [&](Index a, Index b) { return std::pair(ends(a), a) < std::pair(ends(b), b); });
}

}  // namespace coagula::mechanics
