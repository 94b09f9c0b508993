// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour search for the moving spheres: sorts them in space and finds the pairs of each chunk.
#pragma once

#include <coagula/common/dem/particle_system.hpp>

#include <array>
#include <vector>

namespace coagula::dem {

/// A pair found by the search, or a bond: particles by sorted number, `second` displaced by `images` periods.
struct ListedPair {
    std::int32_t first;
    std::int32_t second;
    Eigen::Vector3i images;
};

/// Particles sorted by boxes that follow a space-filling (Morton) curve, so that neighbours in space are near in memory.
///
/// Where no particle reaches beyond the boxes next to its own, each finds its partners in one half of those boxes (and of the own
/// box). Otherwise each pair is found from its larger particle, whose search reaches 2 r + skin, and equal ones again in one half
/// of the boxes. So a few large spheres do not slow down the search for the small ones, and boxes narrower than a particle's reach
/// see all periodic images.
class NeighbourSearch {
public:
    /// @param position wrapped into the cell; fourth component: radius [m].
    NeighbourSearch(const Cell& cell, const std::vector<Quad>& position, double skin);

    /// Particle of each sorted number.
    const std::vector<std::int32_t>& order() const { return order_; }

    /// Appends the pairs that are found from the particle with sorted number `first`.
    /// @param scratch is overwritten; each thread needs its own.
    void find_pairs_of(std::int32_t first, std::vector<ListedPair>& pairs, std::vector<std::int32_t>& scratch) const;

private:
    /// A box number inside the cell, and how many periods away it was.
    struct Place {
        int box;
        int images;
        Eigen::Vector3d shift;  ///< the same as a length [m]
        bool exists;            ///< false outside an open cell
    };
    void choose_boxes(const std::vector<Quad>& position);
    void list_places(const std::vector<Quad>& position);
    Eigen::Array3i reach_of(double radius) const;
    const Place& place_along(int axis, int box) const;
    void rank_boxes();
    Eigen::Array3i box_of(const Quad& position) const;
    std::size_t number_of(const Eigen::Array3i& box) const;
    void sort_along_rows(const std::vector<std::size_t>& box);
    /// A particle that looks for its partners.
    struct Seeker {
        std::int32_t number;
        Eigen::Array3i home;
        int reach;  ///< boxes along x
        std::vector<std::int32_t>& found;
        std::vector<ListedPair>& pairs;
    };
    bool has_smaller(std::size_t first_box, std::size_t count, int side, double radius) const;
    void search_row(const Seeker& seeker, int side, const Place& y, const Place& z) const;
    void search_boxes(const Seeker& seeker, std::size_t first_box, std::size_t count, int side, const Eigen::Vector3d& shift,
                      const Eigen::Vector3i& images) const;

    Cell cell_;
    double skin_;
    Eigen::Array3i boxes_;
    bool next_boxes_ = false;                   ///< whether all particles reach the boxes next to theirs at most
    Eigen::Array3i margin_;                     ///< boxes that the largest particle looks beyond the cell
    std::array<std::vector<Place>, 3> places_;  ///< along each axis, of the boxes from -margin on
    std::vector<std::int32_t> rank_;            ///< place of each box along the curve
    std::vector<std::int32_t> order_;
    std::vector<Quad> sorted_;
    // Once more, box after box along x, so that neighbouring boxes are searched as one.
    std::vector<std::int32_t> start_;      ///< first place of each box, and the end
    std::vector<Quad> along_rows_;         ///< spheres
    std::vector<std::int32_t> number_of_;  ///< their sorted numbers
    std::vector<double> smallest_;         ///< radius in each box
};

}  // namespace coagula::dem
