// SPDX-License-Identifier: GPL-3.0-or-later
// Division of the particles into chunks: which pairs, bonds and ghosts each gets.
#pragma once

#include <coagula/common/dem/particle_system.hpp>

#include <cstdint>
#include <vector>

#include "neighbour_list.hpp"

namespace coagula::dem {

/// An index as the standard containers want it.
inline std::size_t at(std::int32_t index) {
    return static_cast<std::size_t>(index);
}

/// A particle image in one sortable word: sorted number and periods, each of these within -512 .. 511.
std::uint64_t image_key(std::int32_t number, const Eigen::Vector3i& images);
std::int32_t number_in(std::uint64_t image_key);
Eigen::Vector3i images_in(std::uint64_t image_key);

/// The particles of one chunk and the pairs and bonds it evaluates, before slots are known.
struct ChunkPlan {
    std::int32_t first = 0;  ///< sorted numbers [first, last)
    std::int32_t last = 0;
    std::vector<ListedPair> pairs;
    std::vector<ListedPair> bonds;
    std::vector<std::size_t> bond_numbers;  ///< of `bonds` in the list of all
    std::vector<std::uint64_t> ghosts;      ///< keys of the images that the chunk needs, sorted

    bool owns(const ListedPair& pair) const { return pair.images.isZero() && pair.second >= first && pair.second < last; }
    void list_ghosts();
    /// Slots of a pair when the chunk's own slots start at `begin` and its ghosts follow them.
    SlotPair slots_of(const ListedPair& pair, std::int32_t begin) const;
};

/// Finds the pairs and ghosts of every chunk; bonded pairs are listed among the bonds only.
std::vector<ChunkPlan> plan_chunks(const NeighbourSearch& search, const std::vector<Bond>& bonds);

}  // namespace coagula::dem
