// SPDX-License-Identifier: GPL-3.0-or-later
// The simulation cell: a parallelepiped, periodic along any of its edges.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace coagula {

/// A box that three edge vectors span (general; LAMMPS writes those of a restricted triclinic one), periodic along each edge or
/// open there. Lengths in metres.
class Cell {
public:
    Cell() = default;

    /// A rectangular periodic box with one corner at the origin. Throws std::invalid_argument unless all lengths are finite and
    /// positive.
    static Cell periodic(const Eigen::Vector3d& lengths);

    /// A rectangular box without periodicity (a sample with a free surface) from `lower` to `lower + lengths`.
    static Cell open(const Eigen::Vector3d& lower, const Eigen::Vector3d& lengths);

    /// Any box. @param edges columns are the edge vectors [m]. @param periodic along each edge.
    /// Throws std::invalid_argument unless the edges are finite and span a volume.
    static Cell of_edges(const Eigen::Vector3d& origin, const Eigen::Matrix3d& edges, const std::array<bool, 3>& periodic);

    const Eigen::Matrix3d& edges() const { return edges_; }
    const Eigen::Vector3d& origin() const { return origin_; }
    double volume() const { return volume_; }

    /// Whether the edges lie along x, y and z.
    bool is_rectangular() const { return rectangular_; }
    /// The edge lengths of a rectangular box [m]; throws std::invalid_argument where the box is tilted.
    Eigen::Vector3d lengths() const;
    /// The lengths of the edge vectors [m].
    Eigen::Vector3d edge_lengths() const { return rectangular_ ? edges_.diagonal() : edges_.colwise().norm().transpose().eval(); }
    /// The distances between opposite faces [m]: the edge lengths of a rectangular box.
    const Eigen::Vector3d& widths() const { return widths_; }
    Eigen::Vector3d centre() const { return origin_ + edges_.rowwise().sum() / 2; }
    /// The smallest box along x, y and z that encloses this one, without its periodicity.
    Cell bounds() const;

    /// Whether the box is periodic along all edges: there is no free surface.
    bool is_periodic() const { return periodic_[0] && periodic_[1] && periodic_[2]; }
    bool is_periodic(int axis) const { return periodic_[static_cast<std::size_t>(axis)]; }
    /// Whether the box is periodic along none of its edges.
    bool is_open() const { return !periodic_[0] && !periodic_[1] && !periodic_[2]; }
    const std::array<bool, 3>& periodicity() const { return periodic_; }

    /// Components of a vector [m] along the edges, in edges.
    Eigen::Vector3d in_edges(const Eigen::Vector3d& vector) const {
        return rectangular_ ? vector.cwiseQuotient(edges_.diagonal()).eval() : (inverse_ * vector).eval();
    }
    /// Where a position lies along each edge: 0 to 1 within the box.
    Eigen::Vector3d fraction(const Eigen::Vector3d& position) const { return in_edges(position - origin_); }
    /// The position [m] at a fraction of each edge.
    Eigen::Vector3d place(const Eigen::Vector3d& fraction) const {
        return rectangular_ ? (origin_ + edges_.diagonal().cwiseProduct(fraction)).eval() : (origin_ + edges_ * fraction).eval();
    }

    /// The shortest of the periodic images of a separation (3-vector, m); unchanged along open edges.
    Eigen::Vector3d minimum_image(Eigen::Vector3d separation) const {
        if (!rectangular_) {
            return shortest_image(separation);
        }
        for (int axis = 0; axis < 3; ++axis) {
            separation[axis] -= edges_(axis, axis) * std::nearbyint(separation[axis] * inverse_periods_[axis]);
        }
        return separation;
    }

    /// The image of a position inside [0, 1) of each periodic edge; unchanged along open ones.
    Eigen::Vector3d wrap(const Eigen::Vector3d& position) const;

    /// The same lattice of periodic images by its shortest vectors (Minkowski-reduced), which a box at a large strain is not; open
    /// edges stand upright on the periodic ones. A rectangular box is its own reduced one.
    Cell reduced() const;

    /// Half the shortest lattice vector [m]: nearer pairs meet through one image only. Infinite in an open box.
    double half_period() const { return half_period_; }

private:
    Cell(const Eigen::Vector3d& origin, const Eigen::Matrix3d& edges, const std::array<bool, 3>& periodic);
    Eigen::Vector3d shortest_image(const Eigen::Vector3d& separation) const;

    Eigen::Matrix3d edges_ = Eigen::Matrix3d::Identity();
    Eigen::Vector3d inverse_periods_ = Eigen::Vector3d::Ones();  ///< of a rectangular box; 0 along open edges
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    Eigen::Vector3d widths_ = Eigen::Vector3d::Ones();
    Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d reduced_ = Eigen::Matrix3d::Identity();  ///< open edges stand upright on the periodic ones
    Eigen::Matrix3d inverse_reduced_ = Eigen::Matrix3d::Identity();
    double volume_ = 1;
    double half_period_ = 0.5;
    std::array<bool, 3> periodic_ = {true, true, true};
    bool rectangular_ = true;
};

}  // namespace coagula
