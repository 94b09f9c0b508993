// SPDX-License-Identifier: GPL-3.0-or-later
// Which pairs of a list overlap, and which spheres are near a point: one at a time or several in the lanes of vector registers.
//
// A template over `Lanes` for the reasons given in bond_loop.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see bond_loop.hpp
namespace coagula::dem::detail {

/// Appends to `touching` those of Lanes::width pairs from `pair` on whose surfaces are nearer than `gap`; returns how many it then
/// holds. Without branches, since hardly any can be predicted.
template <class Lanes>
[[gnu::always_inline]] inline std::size_t note_touching(const double* position, const std::int32_t* ends, std::size_t pair,
                                                        double gap, std::int32_t* touching, std::size_t found) {
    using Real = typename Lanes::Real;
    Real first[4], second[4];
    Lanes::gather(position, ends + 2 * pair, first);
    Lanes::gather(position, ends + 2 * pair + 1, second);
    const Real x = second[0] - first[0];
    const Real y = second[1] - first[1];
    const Real z = second[2] - first[2];
    const Real reach = first[3] + second[3] + gap;
    double overlap[Lanes::width];
    Lanes::store(overlap, reach * reach - (x * x + y * y + z * z));
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
        touching[found] = static_cast<std::int32_t>(pair + lane);
        found += overlap[lane] > 0 ? 1 : 0;
    }
    return found;
}

/// Numbers of the pairs whose surfaces are nearer than `gap` (0: that overlap); returns how many they are.
/// @param position four numbers each slot, the fourth is the radius. @param ends two slots each pair.
/// @param touching room for `count` numbers.
template <class Wide, class One>
std::size_t find_touching(const double* position, const std::int32_t* ends, std::size_t count, double gap, std::int32_t* touching) {
    std::size_t found = 0;
    std::size_t pair = 0;
    for (; pair + Wide::width <= count; pair += Wide::width) {
        found = note_touching<Wide>(position, ends, pair, gap, touching, found);
    }
    for (; pair < count; ++pair) {
        found = note_touching<One>(position, ends, pair, gap, touching, found);
    }
    return found;
}

/// Appends to `near` those of Lanes::width spheres from `sphere` on that are near; returns how many it then holds.
template <class Lanes>
[[gnu::always_inline]] inline std::size_t note_near(const double* spheres, std::size_t sphere, const double* centre,
                                                    std::int32_t* near, std::size_t found) {
    using Real = typename Lanes::Real;
    Real other[4];
    Lanes::take(spheres + 4 * sphere, other);
    const Real x = other[0] - centre[0];
    const Real y = other[1] - centre[1];
    const Real z = other[2] - centre[2];
    const Real reach = other[3] + centre[3];
    double inside[Lanes::width];
    Lanes::store(inside, reach * reach - (x * x + y * y + z * z));
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
        near[found] = static_cast<std::int32_t>(sphere + lane);
        found += inside[lane] > 0 ? 1 : 0;
    }
    return found;
}

/// Numbers of the spheres [begin, end) whose centres are nearer to `centre` than the sum of both fourth numbers; returns how many
/// they are.
/// @param spheres four numbers each, the fourth is the radius. @param near room for end - begin numbers.
template <class Wide, class One>
std::size_t find_near(const double* spheres, std::size_t begin, std::size_t end, const double* centre, std::int32_t* near) {
    std::size_t found = 0;
    std::size_t sphere = begin;
    for (; sphere + Wide::width <= end; sphere += Wide::width) {
        found = note_near<Wide>(spheres, sphere, centre, near, found);
    }
    for (; sphere < end; ++sphere) {
        found = note_near<One>(spheres, sphere, centre, near, found);
    }
    return found;
}

}  // namespace coagula::dem::detail
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
