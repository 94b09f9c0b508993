// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/packing.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace coagula {

namespace {

std::string particle_name(const std::string& name, Index particle) {
    return name + ": particle " + std::to_string(particle);
}

/// "its x is 3e-06 m, the box goes from 0 to 2e-06 m", or the same in fractions of the edge of a tilted box.
std::string place_along(const Cell& cell, int axis, const Eigen::Vector3d& position) {
    if (cell.is_rectangular()) {
        const double low = cell.origin()[axis];
        return std::string("its ") + "xyz"[axis] + " is " + to_text(position[axis]) + " m, the box goes from " + to_text(low) +
               " to " + to_text(low + cell.edges()(axis, axis)) + " m";
    }
    return "the centre lies at " + to_text(cell.fraction(position)[axis]) + " of edge " + "abc"[axis] +
           ", the box goes from 0 to 1";
}

void check_one(const Packing& packing, Index particle, const std::string& name) {
    const Eigen::Vector3d position = packing.positions.col(particle);
    const double radius = packing.radii[particle];
    require(position.allFinite(), particle_name(name, particle) + " has a coordinate that is not a finite number");
    require(std::isfinite(radius) && radius > 0,
            particle_name(name, particle) + " has radius " + to_text(radius) + " m, but a radius must be finite and positive");
    constexpr double slack = 1e-9;
    const Eigen::Vector3d fraction = packing.cell.fraction(position);
    for (int axis = 0; axis < 3; ++axis) {
        require(!packing.cell.is_periodic(axis) || (fraction[axis] >= -slack && fraction[axis] <= 1 + slack),
                particle_name(name, particle) + " lies outside the box: " + place_along(packing.cell, axis, position));
    }
}

/// A particle and a box of a fine grid that the cube around its centre touches.
struct Touched {
    std::array<double, 3> box;
    Index particle;
};

/// The box of a fine grid at a fraction of each edge; through the periodic boundary.
Eigen::Array3d box_within(const Cell& cell, const Eigen::Array3d& boxes, const Eigen::Array3d& fraction) {
    Eigen::Array3d box = (fraction * boxes).floor();
    for (int axis = 0; axis < 3; ++axis) {
        box[axis] -= cell.is_periodic(axis) ? boxes[axis] * std::floor(box[axis] / boxes[axis]) : 0.0;
    }
    return box;
}

/// The boxes that a small cell of width `reach` around each centre touches, at most two along each axis; sorted. Those of centres
/// that are nearer to each other than `reach` have a box in common.
std::vector<Touched> touched_boxes(const Packing& packing, double reach) {
    constexpr double reaches_per_box = 16;
    const Cell& cell = packing.cell;
    const Eigen::Array3d boxes = (cell.widths().array() / (reaches_per_box * reach)).floor().max(1.0).min(1e15);
    const Eigen::Array3d half = 0.5 * reach / cell.widths().array();
    std::vector<Touched> all;
    all.reserve(static_cast<std::size_t>(packing.size()));
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Array3d centre = cell.fraction(packing.positions.col(particle));
        const Eigen::Array3d low = box_within(cell, boxes, centre - half);
        const Eigen::Array3d high = box_within(cell, boxes, centre + half);
        for (int corner = 0; corner < 8; ++corner) {
            const auto is_upper = [&](int axis) { return (corner >> axis & 1) != 0; };
            const auto is_again = [&](int axis) { return is_upper(axis) && low[axis] == high[axis]; };
            const auto side = [&](int axis) { return is_upper(axis) ? high[axis] : low[axis]; };
            if (!is_again(0) && !is_again(1) && !is_again(2)) {
                all.push_back({{side(0), side(1), side(2)}, particle});
            }
        }
    }
    std::sort(all.begin(), all.end(),
              [](const Touched& a, const Touched& b) { return std::tie(a.box, a.particle) < std::tie(b.box, b.particle); });
    return all;
}

/// Sorts the centres into boxes so small that few distinct ones fit into one, wherever the particles lie: a cell list takes the
/// square of their number where one of them is far away from all others.
void check_distinct_centres(const Packing& packing, const std::string& name) {
    const double reach = 1e-6 * packing.radii.minCoeff();
    const std::vector<Touched> touched = touched_boxes(packing, reach);
    for (auto one = touched.begin(); one != touched.end(); ++one) {
        for (auto other = one + 1; other != touched.end() && other->box == one->box; ++other) {
            const Eigen::Vector3d separation = packing.positions.col(other->particle) - packing.positions.col(one->particle);
            if (packing.cell.minimum_image(separation).norm() < reach) {
                throw std::invalid_argument(name + ": particles " + std::to_string(one->particle) + " and " +
                                            std::to_string(other->particle) + " have the same centre");
            }
        }
    }
}

}  // namespace

void check(const Packing& packing, const std::string& name) {
    require(packing.size() > 0, name + " has no particles");
    require(packing.radii.size() == packing.size(),
            name + " has " + std::to_string(packing.size()) + " positions but " + std::to_string(packing.radii.size()) + " radii");
    for (Index particle = 0; particle < packing.size(); ++particle) {
        check_one(packing, particle, name);
    }
    require_positive(solid_volume(packing), name + ": the volume of the spheres", "m^3");
    require_positive(volume_fraction(packing), name + ": the volume fraction");
    check_distinct_centres(packing, name);
}

double solid_volume(const Packing& packing) {
    return 4 * std::numbers::pi / 3 * packing.radii.array().cube().sum();
}

double volume_fraction(const Packing& packing) {
    return solid_volume(packing) / packing.cell.volume();
}

bool is_monodisperse(const Packing& packing) {
    return packing.radii.maxCoeff() - packing.radii.minCoeff() <= 1e-12 * packing.radii.maxCoeff();
}

double mean_radius(const Packing& packing) {
    return packing.radii.mean();
}

}  // namespace coagula
