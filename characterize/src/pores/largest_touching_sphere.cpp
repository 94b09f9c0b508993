// SPDX-License-Identifier: GPL-3.0-or-later
// The largest sphere through a point.
#include <coagula/characterize/covering_spheres.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace coagula::characterize {

namespace {

/// What one particle says of the sphere whose centre lies in the direction w: 1 / R >= offset + slope w.
struct Bound {
    double offset;
    Eigen::Vector3d slope;
    double steepness;  ///< |slope|

    double at(const Eigen::Vector3d& direction) const { return offset + slope.dot(direction); }
};

/// Directions within an angle of one.
struct Cap {
    Eigen::Vector3d middle;
    double cosine;  ///< of the angle

    bool contains(const Eigen::Vector3d& direction) const { return direction.dot(middle) >= cosine - 1e-9; }
};

/// Directions within a spherical triangle.
struct Triangle {
    std::array<Eigen::Vector3d, 3> corner;

    Cap cap() const {
        const Eigen::Vector3d middle = (corner[0] + corner[1] + corner[2]).normalized();
        return {middle, std::min({middle.dot(corner[0]), middle.dot(corner[1]), middle.dot(corner[2])})};
    }

    std::array<Triangle, 4> quarters() const {
        const Eigen::Vector3d a = (corner[1] + corner[2]).normalized();
        const Eigen::Vector3d b = (corner[2] + corner[0]).normalized();
        const Eigen::Vector3d c = (corner[0] + corner[1]).normalized();
        return {Triangle{{a, b, c}}, Triangle{{corner[0], c, b}}, Triangle{{corner[1], a, c}}, Triangle{{corner[2], b, a}}};
    }
};

/// The faces of an octahedron.
std::array<Triangle, 8> all_directions() {
    std::array<Triangle, 8> faces;
    for (std::size_t k = 0; k < 8; ++k) {
        const auto axis = [k](int which) {
            return Eigen::Vector3d((((k >> which) & 1) != 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(which));
        };
        faces[k].corner = {axis(0), axis(1), axis(2)};
    }
    return faces;
}

/// Finds the least value over all directions of the largest of the bounds. Bounds that are nowhere the largest in a triangle of
/// directions, and triangles in which the value found before cannot be beaten, are left out; what remains is tried by pairs and
/// triples, of which two or three are equal at the minimum.
class Search {
public:
    explicit Search(double best) : best_(best) {}

    double best() const { return best_; }

    void visit(const Triangle& triangle, const std::vector<Bound>& bounds, int depth) {
        const Cap cap = triangle.cap();
        std::vector<double> high(bounds.size());
        const double least = bound_cap(bounds, cap, high);
        if (least >= best_) {
            return;
        }
        std::vector<Bound> relevant;
        for (std::size_t k = 0; k < bounds.size(); ++k) {
            if (high[k] >= least) {
                relevant.push_back(bounds[k]);
            }
        }
        constexpr std::size_t few = 7;
        constexpr int deepest = 6;
        if (relevant.size() <= few || depth == deepest) {
            try_all({cap, relevant});
            return;
        }
        for (const Triangle& quarter : triangle.quarters()) {
            visit(quarter, relevant, depth + 1);
        }
    }

private:
    /// The bounds that matter in a cap.
    struct Part {
        Cap cap;
        const std::vector<Bound>& bounds;
    };

    /// Least value of the largest bound over the directions of a cap, or less. @param high receives the largest
    /// value of each bound.
    static double bound_cap(const std::vector<Bound>& bounds, const Cap& cap, std::vector<double>& high) {
        const double cosine = cap.cosine;
        const double sine = std::sqrt(1 - cosine * cosine);
        double least = 0;
        for (std::size_t k = 0; k < bounds.size(); ++k) {
            const Bound& bound = bounds[k];
            const double steepness = bound.steepness;
            const double along = bound.slope.dot(cap.middle);
            const double across = std::sqrt(std::max(0.0, steepness * steepness - along * along));
            const double low = along <= -cosine * steepness ? -steepness : along * cosine - across * sine;
            high[k] = bound.offset + (along >= cosine * steepness ? steepness : along * cosine + across * sine);
            least = std::max(least, bound.offset + low);
        }
        return least;
    }

    void try_all(const Part& part) {
        const std::vector<Bound>& bounds = part.bounds;
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                try_pair(part, bounds[i], bounds[j]);
                for (std::size_t k = 0; k < j; ++k) {
                    try_triple(part, bounds[i], bounds[j], bounds[k]);
                }
            }
        }
    }

    /// The least value at which two bounds are equal.
    void try_pair(const Part& part, const Bound& first, const Bound& second) {
        const Eigen::Vector3d normal = first.slope - second.slope;
        const double squared = normal.squaredNorm();
        const double offset = second.offset - first.offset;
        const double rest = 1 - offset * offset / squared;
        const Eigen::Vector3d across = first.slope - normal * (first.slope.dot(normal) / squared);
        const double length = across.norm();
        if (rest > 0 && length > 0) {
            try_direction(part, first, offset / squared * normal - std::sqrt(rest) / length * across);
        }
    }

    /// The two directions in which three bounds are equal.
    void try_triple(const Part& part, const Bound& first, const Bound& second, const Bound& third) {
        const Eigen::Vector3d one = first.slope - second.slope;
        const Eigen::Vector3d other = first.slope - third.slope;
        const Eigen::Vector3d line = one.cross(other);
        const double squared = line.squaredNorm();
        const Eigen::Vector3d point =
            ((second.offset - first.offset) * other.cross(line) + (third.offset - first.offset) * line.cross(one)) / squared;
        const double rest = 1 - point.squaredNorm();
        if (rest > 0) {  // not if the slopes lie on a line: the point is NaN then
            const Eigen::Vector3d step = std::sqrt(rest / squared) * line;
            try_direction(part, first, point + step);
            try_direction(part, first, point - step);
        }
    }

    void try_direction(const Part& part, const Bound& touched, const Eigen::Vector3d& direction) {
        constexpr double rounding = 1 + 1e-10;
        const double value = touched.at(direction);
        const auto allowed = [&](const Bound& bound) { return bound.at(direction) <= value * rounding; };
        if (value > 0 && value < best_ && part.cap.contains(direction) && std::ranges::all_of(part.bounds, allowed)) {
            best_ = value;
        }
    }

    double best_;
};

}  // namespace

double largest_touching_sphere(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii, double largest, double least) {
    std::vector<Bound> bounds = {{1 / largest, Eigen::Vector3d::Zero(), 0}};
    for (Index i = 0; i < radii.size(); ++i) {
        const double distance = centres.col(i).norm();
        const double power = (distance - radii[i]) * (distance + radii[i]);
        bounds.push_back({2 * radii[i] / power, 2 / power * centres.col(i), 2 * distance / power});
    }
    Search search(1 / least);
    for (const Triangle& face : all_directions()) {
        search.visit(face, bounds, 0);
    }
    return 1 / search.best();
}

}  // namespace coagula::characterize
