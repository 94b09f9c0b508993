// The simulation cell: an orthorhombic box, periodic along each axis or open.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace coagula {

/// A box with edges along x, y, z. Lengths in metres.
///
/// `edges` is kept as a full matrix (columns are the edge vectors), so that a sheared cell can be added without
/// changing the callers; until then only diagonal matrices occur.
class Cell {
public:
    Cell() = default;

    /// A periodic box with one corner at the origin. Throws std::invalid_argument unless all lengths are finite and positive.
    static Cell periodic(const Eigen::Vector3d& lengths);

    /// A box without periodicity (a sample with a free surface) from `lower` to `lower + lengths`.
    static Cell open(const Eigen::Vector3d& lower, const Eigen::Vector3d& lengths);

    const Eigen::Matrix3d& edges() const { return edges_; }
    Eigen::Vector3d lengths() const { return edges_.diagonal(); }
    const Eigen::Vector3d& origin() const { return origin_; }
    bool is_periodic() const { return periodic_; }
    double volume() const { return edges_.diagonal().prod(); }

    /// The shortest of the periodic images of a separation (3-vector, m); unchanged in an open cell.
    Eigen::Vector3d minimum_image(Eigen::Vector3d separation) const {
        if (periodic_) {
            for (int axis = 0; axis < 3; ++axis) {
                separation[axis] -= edges_(axis, axis) * std::nearbyint(separation[axis] * inverse_lengths_[axis]);
            }
        }
        return separation;
    }

    /// The image of a position inside [origin, origin + length) along each axis; unchanged in an open cell.
    Eigen::Vector3d wrap(const Eigen::Vector3d& position) const;

private:
    Cell(const Eigen::Vector3d& origin, const Eigen::Vector3d& lengths, bool periodic);

    Eigen::Matrix3d edges_ = Eigen::Matrix3d::Identity();
    Eigen::Vector3d inverse_lengths_ = Eigen::Vector3d::Ones();
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    bool periodic_ = true;
};

}  // namespace coagula
