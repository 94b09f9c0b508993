// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/cell.hpp>
#include <coagula/common/checks.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <limits>

namespace coagula {

namespace {

constexpr std::array<bool, 3> everywhere = {true, true, true};
constexpr std::array<bool, 3> nowhere = {false, false, false};

/// Calls visit(x, y, z) for all shifts by -1, 0 or 1 along the periodic edges.
template <class Visitor>
void for_each_next(const std::array<bool, 3>& periodic, const Visitor& visit) {
    const auto reach = [&](std::size_t axis) { return periodic[axis] ? 1 : 0; };
    for (int x = -reach(0); x <= reach(0); ++x) {
        for (int y = -reach(1); y <= reach(1); ++y) {
            for (int z = -reach(2); z <= reach(2); ++z) {
                visit(Eigen::Vector3d(x, y, z));
            }
        }
    }
}

/// Shortens the periodic edges by sums and differences of the others until none becomes shorter: they are Minkowski-reduced
/// (Nguyen and Stehle, ACM Trans. Algorithms 5 (2009) 46), as only the nearest combinations count in three dimensions.
Eigen::Matrix3d reduce(Eigen::Matrix3d edges, const std::array<bool, 3>& periodic) {
    constexpr double shorter = 1 - 1e-12;
    bool changed = true;
    while (changed) {
        changed = false;
        for (int axis = 0; axis < 3; ++axis) {
            std::array<bool, 3> others = periodic;
            others[static_cast<std::size_t>(axis)] = false;
            if (!periodic[static_cast<std::size_t>(axis)]) {
                continue;
            }
            for (int other = 0; other < 3; ++other) {  // whole multiples first: a box at a large strain is far from reduced
                if (others[static_cast<std::size_t>(other)]) {
                    const double multiple = std::nearbyint(edges.col(axis).dot(edges.col(other)) / edges.col(other).squaredNorm());
                    const Eigen::Vector3d less = edges.col(axis) - multiple * edges.col(other);
                    if (less.squaredNorm() < shorter * edges.col(axis).squaredNorm()) {
                        edges.col(axis) = less;
                        changed = true;
                    }
                }
            }
            Eigen::Vector3d best = edges.col(axis);
            for_each_next(others, [&](const Eigen::Vector3d& shift) {
                const Eigen::Vector3d sum = edges.col(axis) + edges * shift;
                best = sum.squaredNorm() < shorter * best.squaredNorm() ? sum : best;
            });
            changed = changed || best != edges.col(axis);
            edges.col(axis) = best;
        }
    }
    return edges;
}

/// Stands the open edges upright on the periodic ones: their lean has no meaning.
Eigen::Matrix3d straighten(Eigen::Matrix3d edges, const std::array<bool, 3>& periodic) {
    Eigen::Matrix3d along = Eigen::Matrix3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        if (periodic[static_cast<std::size_t>(axis)]) {
            along.col(axis) = edges.col(axis);
        }
    }
    const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> plane(along);
    for (int axis = 0; axis < 3; ++axis) {
        if (!periodic[static_cast<std::size_t>(axis)]) {
            edges.col(axis) -= along * plane.solve(Eigen::Vector3d(edges.col(axis)));
        }
    }
    return edges;
}

double shortest_vector(const Eigen::Matrix3d& reduced, const std::array<bool, 3>& periodic) {
    double shortest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        shortest = periodic[static_cast<std::size_t>(axis)] ? std::min(shortest, reduced.col(axis).norm()) : shortest;
    }
    return shortest;
}

}  // namespace

Cell::Cell(const Eigen::Vector3d& origin, const Eigen::Matrix3d& edges, const std::array<bool, 3>& periodic)
    : edges_(edges), origin_(origin), periodic_(periodic), rectangular_(edges.isDiagonal(0) && edges.diagonal().minCoeff() > 0) {
    if (rectangular_) {
        widths_ = edges.diagonal();
        volume_ = widths_.prod();
        reduced_ = edges;
    } else {
        volume_ = std::abs(edges.determinant());
        for (int axis = 0; axis < 3; ++axis) {
            widths_[axis] = volume_ / edges.col((axis + 1) % 3).cross(edges.col((axis + 2) % 3)).norm();
        }
        inverse_ = edges.inverse();
        reduced_ = straighten(reduce(edges, periodic), periodic);
        inverse_reduced_ = reduced_.inverse();
    }
    for (int axis = 0; axis < 3; ++axis) {
        inverse_periods_[axis] = is_periodic(axis) ? 1 / widths_[axis] : 0.0;
    }
    half_period_ = shortest_vector(reduced_, periodic) / 2;
}

Cell Cell::periodic(const Eigen::Vector3d& lengths) {
    return of_edges(Eigen::Vector3d::Zero(), lengths.asDiagonal(), everywhere);
}

Cell Cell::open(const Eigen::Vector3d& lower, const Eigen::Vector3d& lengths) {
    return of_edges(lower, lengths.asDiagonal(), nowhere);
}

Cell Cell::of_edges(const Eigen::Vector3d& origin, const Eigen::Matrix3d& edges, const std::array<bool, 3>& periodic) {
    if (edges.isDiagonal(0)) {
        for (const double length : edges.diagonal()) {
            require_positive(length, "the edge length of the box", "m");
        }
        require_positive(edges.diagonal().prod(), "the volume of the box", "m^3");
        return {origin, edges, periodic};
    }
    require(edges.allFinite() && origin.allFinite(), "an edge of the box is not a finite number");
    constexpr double flat = 1e-9;
    const double volume = std::abs(edges.determinant());
    require(volume > flat * edges.colwise().norm().prod() && std::isfinite(volume),
            "the edges of the box lie in one plane: it has no volume");
    return {origin, edges, periodic};
}

Eigen::Vector3d Cell::lengths() const {
    require(rectangular_, "the box is tilted, but a box with right angles is needed here");
    return edges_.diagonal();
}

Cell Cell::bounds() const {
    if (rectangular_) {
        return open(origin_, edges_.diagonal());
    }
    const Eigen::Vector3d below = edges_.cwiseMin(0.0).rowwise().sum();
    const Eigen::Vector3d above = edges_.cwiseMax(0.0).rowwise().sum();
    return open(origin_ + below, above - below);
}

Eigen::Vector3d Cell::wrap(const Eigen::Vector3d& position) const {
    Eigen::Vector3d wrapped = position;
    if (rectangular_) {
        for (int axis = 0; axis < 3; ++axis) {
            if (is_periodic(axis)) {
                const double length = edges_(axis, axis);
                double offset = wrapped[axis] - origin_[axis];
                offset -= length * std::floor(offset * inverse_periods_[axis]);
                wrapped[axis] = origin_[axis] + (offset >= length || offset < 0 ? 0.0 : offset);
            }
        }
        return wrapped;
    }
    Eigen::Vector3d inside = fraction(position);
    for (int axis = 0; axis < 3; ++axis) {
        wrapped -= is_periodic(axis) ? (std::floor(inside[axis]) * edges_.col(axis)).eval() : Eigen::Vector3d::Zero();
    }
    inside = fraction(wrapped);
    for (int axis = 0; axis < 3; ++axis) {  // a rounding may leave it on the upper face, or just below the lower one
        if (is_periodic(axis) && !(inside[axis] >= 0 && inside[axis] < 1)) {
            inside[axis] = 0;
            wrapped = place(inside);
        }
    }
    return wrapped;
}

Eigen::Vector3d Cell::shortest_image(const Eigen::Vector3d& separation) const {
    const Eigen::Vector3d turns = inverse_reduced_ * separation;
    Eigen::Vector3d nearest = separation;
    for (int axis = 0; axis < 3; ++axis) {
        nearest -= is_periodic(axis) ? (std::nearbyint(turns[axis]) * reduced_.col(axis)).eval() : Eigen::Vector3d::Zero();
    }
    if (nearest.squaredNorm() <= half_period_ * half_period_) {
        return nearest;  // no other image can be shorter
    }
    Eigen::Vector3d shortest = nearest;
    for_each_next(periodic_, [&](const Eigen::Vector3d& shift) {
        const Eigen::Vector3d image = nearest + reduced_ * shift;
        shortest = image.squaredNorm() < shortest.squaredNorm() ? image : shortest;
    });
    return shortest;
}

Cell Cell::reduced() const {
    return rectangular_ ? *this : Cell(origin_, reduced_, periodic_);
}

}  // namespace coagula
