// The largest sphere through a point: branch and bound over directions.
#include <coagula/characterize/covering_spheres.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace coagula::characterize {

namespace {

/// 1 / R >= offset + slope w, from one particle.
struct Bound {
    double offset;
    double steepness;            ///< |slope|
    Eigen::Vector3d direction;  ///< of the slope
};

/// Directions within a spherical triangle.
struct Triangle {
    std::array<Eigen::Vector3d, 3> corner;

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

class Search {
public:
    Search(double best, double tolerance) : best_(best), margin_(1 - tolerance) {}

    /// Least 1 / R over the directions.
    double best() const { return best_; }

    void visit(const Triangle& triangle, const std::vector<Bound>& bounds, int depth) {
        constexpr int deepest = 24;
        const Eigen::Vector3d middle = (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]).normalized();
        double cosine = 1;
        for (const Eigen::Vector3d& corner : triangle.corner) {
            cosine = std::min(cosine, middle.dot(corner));
        }
        // 1 - cos^2 of a small angle loses digits, the chord does not.
        double chord = 0;
        for (const Eigen::Vector3d& corner : triangle.corner) {
            chord = std::max(chord, (corner - middle).norm());
        }
        const double sine = chord * std::sqrt(std::max(0.0, 1 - 0.25 * chord * chord));
        std::vector<std::pair<double, const Bound*>> upper;
        double here = 0;
        double least = 0;
        for (const Bound& bound : bounds) {
            const double along = std::clamp(middle.dot(bound.direction), -1.0, 1.0);
            const double across = std::sqrt(1 - along * along);
            here = std::max(here, bound.offset + bound.steepness * along);
            const double low = along < -cosine ? -1.0 : along * cosine - across * sine;
            const double high = along > cosine ? 1.0 : along * cosine + across * sine;
            least = std::max(least, bound.offset + bound.steepness * low);
            upper.emplace_back(bound.offset + bound.steepness * high, &bound);
        }
        best_ = std::min(best_, here);
        if (least >= best_ * margin_ || depth == deepest) {
            return;
        }
        std::vector<Bound> relevant;
        for (const auto& [high, bound] : upper) {
            if (high >= least) {
                relevant.push_back(*bound);
            }
        }
        for (const Triangle& quarter : triangle.quarters()) {
            visit(quarter, relevant, depth + 1);
        }
    }

private:
    double best_;
    double margin_;
};

}  // namespace

double largest_touching_sphere(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii, double largest, double least,
                               double tolerance) {
    std::vector<Bound> bounds = {{1 / largest, 0.0, Eigen::Vector3d::UnitX()}};
    for (Index i = 0; i < radii.size(); ++i) {
        const double distance = centres.col(i).norm();
        const double power = (distance - radii[i]) * (distance + radii[i]);
        bounds.push_back({2 * radii[i] / power, 2 * distance / power, centres.col(i) / distance});
    }
    Search search(1 / least, tolerance);
    for (const Triangle& face : all_directions()) {
        search.visit(face, bounds, 0);
    }
    return 1 / search.best();
}

}  // namespace coagula::characterize
