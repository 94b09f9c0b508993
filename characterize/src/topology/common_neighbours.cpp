// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/local_structure.hpp>

#include <coagula/common/contact_network.hpp>

#include "geometry/nearest.hpp"
#include "sample/averaged_particles.hpp"

#include <numeric>

namespace coagula::characterize {

namespace {

using Signature = std::array<int, 3>;

/// Who of the neighbours of a particle is bonded to whom.
class Bonds {
public:
    template <class Bonded>
    Bonds(std::size_t count, Bonded&& bonded) : to_(count) {
        for (std::size_t one = 0; one < count; ++one) {
            for (std::size_t other = one + 1; other < count; ++other) {
                if (bonded(one, other)) {
                    to_[one].push_back(other);
                    to_[other].push_back(one);
                }
            }
        }
    }

    /// Signature of the bond between the particle and one of its neighbours.
    Signature signature(std::size_t neighbour) const {
        const std::vector<std::size_t>& common = to_[neighbour];
        std::vector<std::array<std::size_t, 2>> bonds;
        for (std::size_t a = 0; a < common.size(); ++a) {
            for (std::size_t b = a + 1; b < common.size(); ++b) {
                const auto& row = to_[common[a]];
                if (std::find(row.begin(), row.end(), common[b]) != row.end()) {
                    bonds.push_back({a, b});
                }
            }
        }
        return {static_cast<int>(common.size()), static_cast<int>(bonds.size()), largest_chain(common.size(), bonds)};
    }

    Index common(std::size_t neighbour) const { return std::ssize(to_[neighbour]); }

private:
    /// Bonds of the largest connected set.
    static int largest_chain(std::size_t count, const std::vector<std::array<std::size_t, 2>>& bonds) {
        std::vector<std::size_t> set(count);
        std::iota(set.begin(), set.end(), std::size_t{0});
        for (const auto& [a, b] : bonds) {
            const std::size_t from = set[b], into = set[a];
            std::replace(set.begin(), set.end(), from, into);
        }
        std::vector<int> size(count, 0);
        int largest = 0;
        for (const auto& bond : bonds) {
            largest = std::max(largest, ++size[set[bond[0]]]);
        }
        return largest;
    }

    std::vector<std::vector<std::size_t>> to_;
};

/// Particles or images in contact with a particle.
std::vector<std::vector<Neighbour>> contact_neighbours(const ContactNetwork& contacts) {
    std::vector<std::vector<Neighbour>> neighbours(static_cast<std::size_t>(contacts.particles));
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const Eigen::Vector3d branch = contacts.branch.col(contact);
        const int first = contacts.ends(0, contact), second = contacts.ends(1, contact);
        neighbours[static_cast<std::size_t>(first)].push_back({second, branch, branch.squaredNorm()});
        neighbours[static_cast<std::size_t>(second)].push_back({first, -branch, branch.squaredNorm()});
    }
    return neighbours;
}

void add_contacts(const Packing& packing, double tolerance, const AveragedParticles& averaged, CommonNeighbours& result) {
    const auto neighbours = contact_neighbours(find_contacts(packing, tolerance));
    BlockSums common(averaged.blocks);
    for (std::size_t k = 0; k < averaged.particles.size(); ++k) {
        const auto& own = neighbours[static_cast<std::size_t>(averaged.particles[k])];
        const Bonds bonds(own.size(), [&](std::size_t one, std::size_t other) {
            const double reach = (1 + tolerance) * (packing.radii[own[one].particle] + packing.radii[own[other].particle]);
            return (own[one].separation - own[other].separation).squaredNorm() < reach * reach;
        });
        for (std::size_t neighbour = 0; neighbour < own.size(); ++neighbour) {
            common.add(averaged.block[k], static_cast<double>(bonds.common(neighbour)));
            result.fraction[bonds.signature(neighbour)] += 1;
        }
    }
    for (auto& [signature, count] : result.fraction) {
        count /= common.weight();
    }
    result.mean = common.mean();
    result.mean_stderr = common.mean_stderr();
}

enum class Lattice { none, fcc, hcp, bcc, icosahedral };

/// How many of the first `count` neighbours have each of two signatures, with bonds shorter than the cut-off.
std::array<int, 2> count_signatures(const std::vector<Neighbour>& neighbours, std::size_t count, double cutoff,
                                    const std::array<Signature, 2>& wanted) {
    const Bonds bonds(count, [&](std::size_t one, std::size_t other) {
        return (neighbours[one].separation - neighbours[other].separation).squaredNorm() < cutoff * cutoff;
    });
    std::array<int, 2> found{};
    for (std::size_t neighbour = 0; neighbour < count; ++neighbour) {
        const Signature signature = bonds.signature(neighbour);
        found[0] += signature == wanted[0] ? 1 : 0;
        found[1] += signature == wanted[1] ? 1 : 0;
    }
    return found;
}

/// Cut-offs half-way between the shells, from the distances themselves (Stukowski 2012, equations 1 and 2).
Lattice lattice_around(const std::vector<Neighbour>& neighbours) {
    constexpr double between = (1 + 1.4142135623730951) / 2;
    constexpr std::size_t close_packed = 12, body_centred = 14, first_shell = 8;
    double distances = 0, edges = 0;
    for (std::size_t k = 0; k < body_centred; ++k) {
        const double distance = std::sqrt(neighbours[k].squared_distance);
        distances += k < close_packed ? distance : 0.0;
        edges += k < first_shell ? 2 / std::sqrt(3.0) * distance : distance;
    }
    const double cutoff = between * distances / close_packed;
    const auto [fcc, hcp] = count_signatures(neighbours, close_packed, cutoff, {{{4, 2, 1}, {4, 2, 2}}});
    if (fcc == close_packed) {
        return Lattice::fcc;
    }
    if (fcc == 6 && hcp == 6) {
        return Lattice::hcp;
    }
    if (count_signatures(neighbours, close_packed, cutoff, {{{5, 5, 5}, {5, 5, 5}}})[0] == close_packed) {
        return Lattice::icosahedral;
    }
    const auto [six, four] = count_signatures(neighbours, body_centred, between * edges / body_centred, {{{6, 6, 6}, {4, 4, 4}}});
    return six == 8 && four == 6 ? Lattice::bcc : Lattice::none;
}

void add_lattices(const Packing& packing, const AveragedParticles& averaged, CommonNeighbours& result) {
    constexpr std::size_t needed = 14;
    const auto nearest = nearest_neighbours(packing, needed);
    std::vector<BlockSums> sums(5, BlockSums(averaged.blocks));
    for (std::size_t k = 0; k < averaged.particles.size(); ++k) {
        const auto& neighbours = nearest[static_cast<std::size_t>(averaged.particles[k])];
        const Lattice found = neighbours.size() < needed ? Lattice::none : lattice_around(neighbours);
        for (std::size_t kind = 0; kind < sums.size(); ++kind) {
            sums[kind].add(averaged.block[k], static_cast<std::size_t>(found) == kind ? 1 : 0);
        }
    }
    const auto set = [&](Lattice lattice, double& fraction, double& error) {
        fraction = sums[static_cast<std::size_t>(lattice)].mean();
        error = sums[static_cast<std::size_t>(lattice)].mean_stderr();
    };
    set(Lattice::fcc, result.fcc, result.fcc_stderr);
    set(Lattice::hcp, result.hcp, result.hcp_stderr);
    set(Lattice::bcc, result.bcc, result.bcc_stderr);
    set(Lattice::icosahedral, result.icosahedral, result.icosahedral_stderr);
}

}  // namespace

CommonNeighbours measure_common_neighbours(const Packing& packing, const CommonNeighbourOptions& options) {
    check(packing);
    const AveragedParticles averaged(packing);
    CommonNeighbours result;
    add_contacts(packing, options.contact_tolerance, averaged, result);
    add_lattices(packing, averaged, result);
    return result;
}

}  // namespace coagula::characterize
