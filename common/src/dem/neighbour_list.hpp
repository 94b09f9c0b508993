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
/// Each pair is found from its larger particle, whose search reaches 2 r + skin; equal ones find each other once because only one
/// half of the boxes around (and of the own box) is looked at. So a few large spheres do not slow down the search for the small
/// ones, and boxes narrower than a particle's reach see all periodic images.
class NeighbourSearch {
public:
    /// @param position wrapped into the cell; fourth component: radius [m].
    NeighbourSearch(const Cell& cell, const std::vector<Quad>& position, double skin);

    /// Particle of each sorted number.
    const std::vector<std::int32_t>& order() const { return order_; }

    /// Appends the pairs whose larger (or first) particle has sorted number `first`.
    void find_pairs_of(std::int32_t first, std::vector<ListedPair>& pairs) const;

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
    std::size_t rank_of(const Eigen::Array3i& box) const;
    void search_box(std::int32_t first, std::size_t place, int side, const Place& x, const Place& y, const Place& z,
                    std::vector<ListedPair>& pairs) const;

    Cell cell_;
    double skin_;
    Eigen::Array3i boxes_;
    Eigen::Array3i margin_;                     ///< boxes that the largest particle looks beyond the cell
    std::array<std::vector<Place>, 3> places_;  ///< along each axis, of the boxes from -margin on
    std::vector<std::int32_t> rank_;            ///< place of each box along the curve
    std::vector<std::int32_t> start_;           ///< first sorted number of each place, and the end
    std::vector<double> smallest_;              ///< radius in each place
    std::vector<std::int32_t> order_;
    std::vector<Quad> sorted_;
};

}  // namespace coagula::dem
