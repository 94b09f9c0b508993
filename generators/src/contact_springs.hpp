// SPDX-License-Identifier: GPL-3.0-or-later
// What contacts oppose to sliding and rolling: springs with a memory and a slip limit, in the slots of a Brownian system. Reduced
// units: mean radius, kB T and R^2/D of a particle of mean radius are 1.
#pragma once

#include "brownian_kernels.hpp"

#include <coagula/common/contact_memory.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace coagula::generators {

/// Contacts of two mean spheres; for others stiffnesses scale as the normal force does.
struct SpringRules {
    double reach = 0;                 ///< a contact is one as long as the gap is smaller
    double normal_stiffness = 0;      ///< the elastic normal force, against which slip limits count, is this times (reach - gap)
    double tangential_stiffness = 0;  ///< 0: nothing resists sliding
    double friction = std::numeric_limits<double>::infinity();
    double rolling_stiffness = 0;  ///< 0: nothing resists rolling
    double rolling_friction = std::numeric_limits<double>::infinity();

    bool active() const { return tangential_stiffness > 0; }
};

/// The memory of a contact by the numbers of its particles; vectors turn with the pair.
struct ContactSpring {
    std::int32_t first = 0;  ///< < second
    std::int32_t second = 0;
    Eigen::Vector3d sliding = Eigen::Vector3d::Zero();  ///< elastic displacement of the second surface against the first
    Eigen::Vector3d rolling = Eigen::Vector3d::Zero();  ///< elastic rotation of the second against the first, without twist
};

/// A contact during a step. Both chunks that share a contact have one, with the same bits: all is computed from the particle of
/// lower number to the other.
struct LoadedSpring {
    SlotPair ends{};       ///< as in the list of pairs; forces go to the first, or to both
    bool swapped = false;  ///< whether the second of the ends is the particle of lower number
    Eigen::Vector3d normal;
    double distance = 0;
    double scale = 0;          ///< of the stiffnesses, for unequal radii
    double sliding_limit = 0;  ///< longest elastic displacement
    double rolling_limit = 0;  ///< largest elastic rotation
    double layers = 0;         ///< boxes along z between the ends as they are stored, from low to high
    Eigen::Vector3d sliding;
    Eigen::Vector3d rolling;

    std::size_t low() const { return static_cast<std::size_t>(swapped ? ends.second : ends.first); }
    std::size_t high() const { return static_cast<std::size_t>(swapped ? ends.first : ends.second); }
};

/// What the loops over springs read and write; four numbers per slot, but one radius.
struct SpringLoop {
    const SpringRules* rules = nullptr;
    std::array<double, 3> period{};
    double lean = 0;                          ///< along x of the third edge of the box, at the start of the step
    double moved_lean = 0;                    ///< at the stage
    const std::int32_t* particles = nullptr;  ///< number of the particle in each slot
    const double* radii = nullptr;
    const double* position = nullptr;  ///< at the start of the step
    const double* moved = nullptr;     ///< at a stage
    const double* rotation = nullptr;  ///< the same of the rotations
    const double* turned = nullptr;
    double* force = nullptr;
    double* torque = nullptr;
};

/// A contact as it is at the start of the step. @param pair the slots of its particles, in either order.
LoadedSpring loaded(const SpringLoop& loop, const SlotPair& pair, const ContactSpring& memory);

/// The pairs that touch at the start of the step, with what those remember that touched before. `near` must be grouped by its
/// first slots in ascending order, as `springs` then is, too.
void refresh_springs(const SpringLoop& loop, const std::vector<SlotPair>& near, std::vector<LoadedSpring>& springs);

/// Forces and torques at a stage, on the first of the ends or on both. Displacements are taken as small against the radii.
void add_spring_forces(const SpringLoop& loop, const std::vector<LoadedSpring>& springs, bool on_both);

/// What the contacts remember after the step: `moved` and `turned` are its end.
void advance_springs(const SpringLoop& loop, std::vector<LoadedSpring>& springs);

struct SpringEnergy {
    double sliding = 0;
    double rolling = 0;
};

/// Of a contact with the displacements that `moved` and `turned` add to it.
SpringEnergy energy_of(const SpringLoop& loop, const LoadedSpring& spring);

/// The same displacements: branch from the lower to the higher particle times the tangential force on the lower.
Eigen::Matrix3d virial_of(const SpringLoop& loop, const LoadedSpring& spring);

}  // namespace coagula::generators
