// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_springs.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace coagula::generators {

namespace {

using Eigen::Vector3d;

struct Deformation {
    Vector3d sliding;
    Vector3d rolling;
};

Vector3d vector_of(const double* values, std::size_t slot) {
    return Vector3d::Map(values + 4 * slot);
}

Vector3d change(const double* after, const double* before, std::size_t slot) {
    return vector_of(after, slot) - vector_of(before, slot);
}

/// The way from one slot to another through the nearest image.
struct Way {
    Vector3d vector;
    double layers;  ///< boxes along z that lie between
};

/// Rounding by a number whose last bit is the unit.
Way way_between(const SpringLoop& loop, const double* positions, double lean, std::size_t from, std::size_t to) {
    constexpr double round = 0x1.8p52;
    Way way{vector_of(positions, to) - vector_of(positions, from), 0};
    for (int axis = 2; axis >= 0; --axis) {
        const double turns = (way.vector[axis] / loop.period[axis] + round) - round;
        way.vector[axis] -= turns * loop.period[axis];
        if (axis == 2) {
            way.vector[0] -= turns * lean;
            way.layers = turns;
        }
    }
    return way;
}

/// Slip: no longer than the limit.
void limit(Vector3d& displacement, double longest) {
    const double squared = displacement.squaredNorm();
    if (squared > longest * longest) {
        displacement *= longest / std::sqrt(squared);
    }
}

Vector3d in_plane(const Vector3d& vector, const Vector3d& normal) {
    return vector - vector.dot(normal) * normal;
}

/// 2 R1 R2/(R1 + R2) over the mean radius.
double scale_of(double one, double other) {
    return 2 * one * other / (one + other);
}

/// Displacement of the surfaces at the contact point, which divides the line of centres in the ratio of the radii (as in
/// common/contact_memory.hpp, to first order in the motion).
Deformation deformed(const SpringLoop& loop, const LoadedSpring& spring) {
    const std::size_t low = spring.low();
    const std::size_t high = spring.high();
    const Vector3d low_turn = change(loop.turned, loop.rotation, low);
    const Vector3d high_turn = change(loop.turned, loop.rotation, high);
    const double low_lever = spring.distance * loop.radii[low] / (loop.radii[low] + loop.radii[high]);
    const double high_lever = spring.distance - low_lever;
    Vector3d slip = change(loop.moved, loop.position, high) - change(loop.moved, loop.position, low) -
                    (low_lever * low_turn + high_lever * high_turn).cross(spring.normal);
    slip[0] -= spring.layers * (loop.moved_lean - loop.lean);
    Deformation now{spring.sliding + in_plane(slip, spring.normal), spring.rolling + in_plane(high_turn - low_turn, spring.normal)};
    limit(now.sliding, spring.sliding_limit);
    limit(now.rolling, spring.rolling_limit);
    return now;
}

/// A contact as it is at the start of the step, without memory.
LoadedSpring load(const SpringLoop& loop, const SlotPair& pair, const Way& from_first, double distance) {
    const auto first = static_cast<std::size_t>(pair.first);
    const auto second = static_cast<std::size_t>(pair.second);
    const SpringRules& rules = *loop.rules;
    LoadedSpring spring;
    spring.ends = pair;
    spring.swapped = loop.particles[second] < loop.particles[first];
    spring.distance = distance;
    spring.normal = (spring.swapped ? -1 : 1) / distance * from_first.vector;
    spring.layers = (spring.swapped ? -1 : 1) * from_first.layers;
    const double low = loop.radii[spring.low()];
    const double high = loop.radii[spring.high()];
    spring.scale = scale_of(low, high);
    // Force limits over stiffnesses: the scale for unequal radii cancels. The rolling moment is limited to the friction times the
    // reduced radius times the normal force.
    const double normal_force = rules.normal_stiffness * (rules.reach - (distance - low - high));
    spring.sliding_limit = rules.friction * normal_force / rules.tangential_stiffness;
    spring.rolling_limit = rules.rolling_stiffness > 0
                               ? rules.rolling_friction * normal_force / (rules.rolling_stiffness * low * high / (low + high))
                               : 0;
    spring.sliding.setZero();
    spring.rolling.setZero();
    return spring;
}

}  // namespace

LoadedSpring loaded(const SpringLoop& loop, const SlotPair& pair, const ContactSpring& memory) {
    const Way way =
        way_between(loop, loop.position, loop.lean, static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
    LoadedSpring spring = load(loop, pair, way, way.vector.norm());
    spring.sliding = memory.sliding;
    spring.rolling = memory.rolling;
    return spring;
}

void refresh_springs(const SpringLoop& loop, const std::vector<SlotPair>& near, std::vector<LoadedSpring>& springs) {
    std::vector<LoadedSpring> before;
    before.swap(springs);
    springs.reserve(before.size() + 16);
    auto old = before.begin();
    for (const SlotPair& pair : near) {
        const auto first = static_cast<std::size_t>(pair.first);
        const auto second = static_cast<std::size_t>(pair.second);
        const Way way = way_between(loop, loop.position, loop.lean, first, second);
        const double reach = loop.rules->reach + loop.radii[first] + loop.radii[second];
        const double squared = way.vector.squaredNorm();
        if (squared >= reach * reach) {
            continue;
        }
        springs.push_back(load(loop, pair, way, std::sqrt(squared)));
        while (old != before.end() && old->ends.first < pair.first) {
            ++old;
        }
        for (auto same = old; same != before.end() && same->ends.first == pair.first; ++same) {
            if (same->ends.second == pair.second) {
                springs.back().sliding = same->sliding;
                springs.back().rolling = same->rolling;
            }
        }
    }
}

void add_spring_forces(const SpringLoop& loop, const std::vector<LoadedSpring>& springs, bool on_both) {
    const SpringRules& rules = *loop.rules;
    const auto add = [](double* values, std::size_t slot, const Vector3d& value) { Vector3d::Map(values + 4 * slot) += value; };
    for (const LoadedSpring& spring : springs) {
        const Deformation now = deformed(loop, spring);
        const std::size_t low = spring.low();
        const std::size_t high = spring.high();
        const double both_radii = loop.radii[low] + loop.radii[high];
        const Vector3d on_low = spring.scale * rules.tangential_stiffness * now.sliding;
        // Rolling displacement and force are those of Luding, Granular Matter 10 (2008) 235: at the reduced radius.
        const double reduced = loop.radii[low] * loop.radii[high] / both_radii;
        const Vector3d moment = spring.scale * rules.rolling_stiffness * reduced * reduced * now.rolling;
        const Vector3d twist = spring.distance / both_radii * spring.normal.cross(on_low);
        if (on_both || !spring.swapped) {
            add(loop.force, low, on_low);
            add(loop.torque, low, loop.radii[low] * twist + moment);
        }
        if (on_both || spring.swapped) {
            add(loop.force, high, -on_low);
            add(loop.torque, high, loop.radii[high] * twist - moment);
        }
    }
}

void advance_springs(const SpringLoop& loop, std::vector<LoadedSpring>& springs) {
    for (LoadedSpring& spring : springs) {
        const std::size_t low = spring.low();
        const std::size_t high = spring.high();
        ContactMemory memory;
        memory.branch = spring.distance * spring.normal;
        memory.shear = spring.sliding;
        memory.bend = spring.rolling;
        const ContactIncrement now = advance(memory, {.branch = way_between(loop, loop.moved, loop.moved_lean, low, high).vector,
                                                      .first_turn = change(loop.turned, loop.rotation, low),
                                                      .second_turn = change(loop.turned, loop.rotation, high),
                                                      .first_radius = loop.radii[low],
                                                      .second_radius = loop.radii[high]});
        spring.normal = now.normal;
        spring.distance = now.distance;
        spring.sliding = memory.shear;
        spring.rolling = in_plane(memory.bend, now.normal);
        limit(spring.sliding, spring.sliding_limit);
        limit(spring.rolling, spring.rolling_limit);
    }
}

SpringEnergy energy_of(const SpringLoop& loop, const LoadedSpring& spring) {
    const Deformation now = deformed(loop, spring);
    const double low = loop.radii[spring.low()];
    const double high = loop.radii[spring.high()];
    const double reduced = low * high / (low + high);
    return {0.5 * spring.scale * loop.rules->tangential_stiffness * now.sliding.squaredNorm(),
            0.5 * spring.scale * loop.rules->rolling_stiffness * reduced * reduced * now.rolling.squaredNorm()};
}

Eigen::Matrix3d virial_of(const SpringLoop& loop, const LoadedSpring& spring) {
    const Vector3d on_low = spring.scale * loop.rules->tangential_stiffness * deformed(loop, spring).sliding;
    return way_between(loop, loop.moved, loop.moved_lean, spring.low(), spring.high()).vector * on_low.transpose();
}

}  // namespace coagula::generators
