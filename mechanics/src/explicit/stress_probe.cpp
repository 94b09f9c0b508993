// SPDX-License-Identifier: GPL-3.0-or-later
#include "stress_probe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::mechanics {

namespace {

using std::numbers::pi;

/// Volume that two balls a distance apart share (Weisstein, Sphere-Sphere Intersection, eq. 16).
double shared_volume(double first, double second, double distance) {
    if (distance >= first + second) {
        return 0;
    }
    if (distance <= std::abs(first - second)) {
        const double smaller = std::min(first, second);
        return 4 * pi / 3 * smaller * smaller * smaller;
    }
    const double depth = first + second - distance;
    const double difference = first - second;
    return pi * depth * depth * (distance * distance + 2 * distance * (first + second) - 3 * difference * difference) /
           (12 * distance);
}

}  // namespace

StressProbe::StressProbe(const MountedSample& mounted, const RheometerOptions& options, const ShearOrientation& orientation)
    : orientation_(orientation),
      bottom_(mounted.bottom),
      height_(mounted.height),
      area_(mounted.area),
      has_plates_(mounted.has_plates()),
      upper_(mounted.upper),
      in_sphere_(static_cast<std::size_t>(mounted.packing.size())) {
    if (has_plates_) {
        place_spheres(mounted, options);
    }
}

void StressProbe::place_spheres(const MountedSample& mounted, const RheometerOptions& options) {
    const int count = options.measurement_spheres;
    const double radius = options.measurement_radius * height_;
    centres_.resize(3, count);
    per_volume_.resize(count);
    for (int sphere = 0; sphere < count; ++sphere) {
        Eigen::Vector3d centre = 0.5 * mounted.packing.cell.lengths();
        const double part = count > 1 ? 0.2 + 0.6 * sphere / (count - 1) : 0.5;
        centre[orientation_.normal] = bottom_ + part * height_;
        centres_.col(sphere) = centre;
        double solid = 0;
        double inside = 0;
        for (Index particle = 0; particle < mounted.packing.size(); ++particle) {
            const double distance = mounted.packing.cell.minimum_image(mounted.packing.positions.col(particle) - centre).norm();
            const double r = mounted.packing.radii[particle];
            solid += shared_volume(radius, r, distance);
            if (distance < radius) {
                inside += 4 * pi / 3 * r * r * r;
                in_sphere_[static_cast<std::size_t>(particle)].push_back(sphere);
            }
        }
        per_volume_[sphere] = inside > 0 ? solid / (4 * pi / 3 * radius * radius * radius) / inside : 0.0;
    }
}

/// The part of the way between two heights that lies between the plates.
double StressProbe::part_inside(double from, double to) const {
    const auto [low, high] = std::minmax(from, to);
    if (low >= bottom_ && high <= bottom_ + height_) {
        return 1;
    }
    return std::max(0.0, std::min(high, bottom_ + height_) - std::max(low, bottom_)) / std::max(high - low, 1e-300);
}

void StressProbe::add(const dem::Slots& slots, const dem::SlotPair& ends, const Eigen::Vector3d& branch,
                      const Eigen::Vector3d& force, Sums& sums) const {
    const std::size_t first = dem::detail::at(ends.first);
    const std::size_t second = dem::detail::at(ends.second);
    // Symmetric part: inertia apart, moments balance and both halves are equal.
    const double product = 0.5 * (force[orientation_.direction] * branch[orientation_.normal] +
                                  force[orientation_.normal] * branch[orientation_.direction]);
    sums.force += force.norm();
    ++sums.contacts;
    if (!has_plates_) {
        sums.whole += product;
        return;
    }
    const double from = slots.position[first][orientation_.normal];
    sums.whole += product * part_inside(from, from + branch[orientation_.normal]);
    const double share = slots.position[first][3] / (slots.position[first][3] + slots.position[second][3]);
    for (const int sphere : in_sphere_[dem::detail::at(slots.particle[first])]) {
        sums.spheres[sphere] += share * product;
    }
    for (const int sphere : in_sphere_[dem::detail::at(slots.particle[second])]) {
        sums.spheres[sphere] += (1 - share) * product;
    }
}

StressSample StressProbe::finish(const dem::ParticleSystem& system, const Sums& sums) const {
    StressSample sample;
    sample.whole = sums.whole / (area_ * height_);
    sample.spheres = sums.spheres.cwiseProduct(per_volume_);
    sample.mean_contact_force = sums.contacts > 0 ? sums.force / static_cast<double>(sums.contacts) : 0.0;
    if (has_plates_) {
        sample.plate = -system.total_force(upper_)[orientation_.direction] / area_;
    }
    return sample;
}

}  // namespace coagula::mechanics
