// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of bonds with shear springs: the formulas, once, for one bond at a time or several in the lanes of vector registers.
//
// Everything is a template over `Lanes`, so that a translation unit compiled for special instructions shares no function with the
// others as long as its lanes have a name without linkage. For the same reason nothing here calls library templates, std::array
// among them.
#pragma once

#include <cstddef>
#include <cstdint>

// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see above
namespace coagula::dem::detail {

/// Four bonds, so that what a step reads and writes of them lies side by side.
struct alignas(64) BondBlock {
    static constexpr std::size_t width = 4;
    std::int32_t ends[2 * width];  ///< slots: first, second, first, second ...
    double rest_length[width];     ///< [m]
    double shear[3][width];        ///< components of the shear displacement [m]
    double branch[3][width];       ///< components of the branch to which it belongs [m]
};

/// Per-slot arrays, four numbers each: see Slots.
struct SlotArrays {
    const double* position;
    const double* turn;
    double* force;
    double* moment;
};

/// Over the bonds of a chunk.
struct BondExtremes {
    double stretch = 0;        ///< largest distance - rest length [m], 0 if none is stretched
    double shear_squared = 0;  ///< largest squared shear displacement [m^2]
};

/// One number at a time. @tparam Name tells translation units apart, see above.
template <class Name>
struct SingleLane {
    using Real = double;
    static constexpr std::size_t width = 1;
    static Real load(const double* values) { return *values; }
    static void store(double* values, Real value) { *values = value; }
    static Real square_root(Real value) { return __builtin_sqrt(value); }
    static Real larger(Real a, Real b) { return a > b ? a : b; }
    static double largest(Real value) { return value; }
    static Real magnitude(Real value) { return __builtin_fabs(value); }
    static Real where_positive(Real sign, Real value) { return sign > 0 ? value : 0.0; }
    static double sum_of_three(const Real* values) { return values[0] + values[1] + values[2]; }
    /// Four numbers each of consecutive slots, one slot per lane.
    static void take(const double* quads, Real (&values)[4]) {
        for (int component = 0; component < 4; ++component) {
            values[component] = quads[component];
        }
    }
    /// Four numbers of the slot named by every second entry of `slots`, one per lane.
    static void gather(const double* quads, const std::int32_t* slots, Real (&values)[4]) {
        for (int component = 0; component < 4; ++component) {
            values[component] = quads[4 * static_cast<std::size_t>(*slots) + static_cast<std::size_t>(component)];
        }
    }
    /// Adds `first` to the first ends and `second` to the second ends, lane after lane.
    static void scatter(double* quads, const std::int32_t* ends, const Real (&first)[4], const Real (&second)[4]) {
        for (std::size_t component = 0; component < 4; ++component) {
            quads[4 * static_cast<std::size_t>(ends[0]) + component] += first[component];
            quads[4 * static_cast<std::size_t>(ends[1]) + component] += second[component];
        }
    }
};

using OneLane = SingleLane<void>;

template <class Lanes>
struct BondFormulas {
    using Real = typename Lanes::Real;

    struct Vector {
        Real x, y, z;
        friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
        friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
        friend Vector operator*(const Real& a, const Vector& b) { return {a * b.x, a * b.y, a * b.z}; }
    };

    static Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    static Vector cross(const Vector& a, const Vector& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }

    /// Two bonded particles now.
    struct Pair {
        Vector branch;
        Real distance, inverse_distance;
        Vector normal;
        Real first_lever, second_lever;  // distances of the contact point from the two centres
        Vector first_turn, second_turn;
    };

    static Pair gather(const SlotArrays& slots, const std::int32_t* ends) {
        Real first[4], second[4], first_turn[4], second_turn[4];
        Lanes::gather(slots.position, ends, first);
        Lanes::gather(slots.position, ends + 1, second);
        Lanes::gather(slots.turn, ends, first_turn);
        Lanes::gather(slots.turn, ends + 1, second_turn);
        Pair pair;  // NOLINT(cppcoreguidelines-pro-type-member-init): set in what follows
        pair.branch = {second[0] - first[0], second[1] - first[1], second[2] - first[2]};
        pair.distance = Lanes::larger(Lanes::square_root(dot(pair.branch, pair.branch)), Real{} + 1e-300);
        pair.inverse_distance = 1.0 / pair.distance;
        pair.normal = pair.inverse_distance * pair.branch;
        // The contact point divides the line of centres in the ratio of the radii, d r_i / (r_i + r_j), as in the linear solver.
        pair.first_lever = pair.distance * first[3] / (first[3] + second[3]);
        pair.second_lever = pair.distance - pair.first_lever;
        pair.first_turn = {first_turn[0], first_turn[1], first_turn[2]};
        pair.second_turn = {second_turn[0], second_turn[1], second_turn[2]};
        return pair;
    }

    /// The shear displacement now (Cundall and Strack 1979, eq. 2 of Schenker et al. 2012): it turns with the contact plane and
    /// with the spin of the pair about its axis, and grows by the tangential motion at the contact point. Everything is taken at
    /// the middle of the step, so a rigid rotation by an angle t adds an error of order t^3 only.
    /// @param branch that to which `shear` belongs.
    static Vector updated_shear(const Pair& pair, const Vector& shear, const Vector& branch) {
        const Vector moved = pair.branch - branch;
        const Vector axis = (0.5 * pair.inverse_distance) * (pair.branch + branch);
        const Vector rolled = moved - cross(pair.first_lever * pair.first_turn + pair.second_lever * pair.second_turn, axis);
        // Turn of the contact plane, and of the pair about its axis.
        const Vector turn =
            pair.inverse_distance * cross(axis, moved) + (0.5 * dot(pair.first_turn + pair.second_turn, axis)) * axis;
        const Real half = Real{} + 0.5;
        const Vector now = shear + rolled + cross(turn, shear + half * (rolled + cross(turn, shear)));
        return now - dot(now, pair.normal) * pair.normal;
    }

    static Vector load(const double (&components)[3][BondBlock::width], std::size_t lane) {
        return {Lanes::load(components[0] + lane), Lanes::load(components[1] + lane), Lanes::load(components[2] + lane)};
    }
    static void store(double (&components)[3][BondBlock::width], std::size_t lane, const Vector& value) {
        Lanes::store(components[0] + lane, value.x);
        Lanes::store(components[1] + lane, value.y);
        Lanes::store(components[2] + lane, value.z);
    }
};

/// What add_bond_forces() has met so far, lane by lane.
template <class Lanes>
struct LaneExtremes {
    typename Lanes::Real stretch{};
    typename Lanes::Real shear_squared{};
};

/// Brings the shear displacements of Lanes::width bonds up to date and adds their forces and moments, in the order of the bonds.
/// @param lane of the block where they begin. @param force of (stretch, shear displacement, normal) on the first particle.
template <class Lanes, class Force>
[[gnu::always_inline]] inline void add_bond_forces(const SlotArrays& slots, BondBlock& block, std::size_t lane, const Force& force,
                                                   LaneExtremes<Lanes>& extremes) {
    using Formulas = BondFormulas<Lanes>;
    using Vector = typename Formulas::Vector;
    const std::int32_t* ends = block.ends + 2 * lane;
    const typename Formulas::Pair pair = Formulas::gather(slots, ends);
    const Vector shear = Formulas::updated_shear(pair, Formulas::load(block.shear, lane), Formulas::load(block.branch, lane));
    Formulas::store(block.shear, lane, shear);
    Formulas::store(block.branch, lane, pair.branch);
    const typename Lanes::Real stretch = pair.distance - Lanes::load(block.rest_length + lane);
    extremes.stretch = Lanes::larger(stretch, extremes.stretch);
    extremes.shear_squared = Lanes::larger(Formulas::dot(shear, shear), extremes.shear_squared);
    const Vector pull = force(stretch, shear, pair.normal);
    const Vector moment = Formulas::cross(pair.normal, pull);
    const typename Lanes::Real nothing{};
    Lanes::scatter(slots.force, ends, {pull.x, pull.y, pull.z, nothing}, {-pull.x, -pull.y, -pull.z, nothing});
    const Vector first = pair.first_lever * moment;
    const Vector second = pair.second_lever * moment;
    Lanes::scatter(slots.moment, ends, {first.x, first.y, first.z, nothing}, {second.x, second.y, second.z, nothing});
}

/// The same for `count` bonds: as many at a time as `Wide` has lanes, and the last ones one by one, with lanes `One`. The results
/// do not depend on the width.
/// @param force as above, for either kind of lanes.
template <class Wide, class One, class Force>
BondExtremes add_bond_forces(const SlotArrays& slots, BondBlock* blocks, std::size_t count, const Force& force) {
    LaneExtremes<Wide> wide;
    const std::size_t filled = count / BondBlock::width;
    for (std::size_t block = 0; block < filled; ++block) {
        for (std::size_t lane = 0; lane < BondBlock::width; lane += Wide::width) {
            add_bond_forces(slots, blocks[block], lane, force, wide);
        }
    }
    LaneExtremes<One> one{Wide::largest(wide.stretch), Wide::largest(wide.shear_squared)};
    for (std::size_t lane = 0; lane < count % BondBlock::width; ++lane) {
        add_bond_forces(slots, blocks[filled], lane, force, one);
    }
    return {one.stretch, one.shear_squared};
}

/// Linear springs (BondedContact); the shear displacement has no component along the normal.
struct SpringForce {
    double normal_stiffness;
    double shear_stiffness;

    template <class Real, class Vector>
    Vector operator()(const Real& stretch, const Vector& shear, const Vector& normal) const {
        return (normal_stiffness * stretch) * normal + (Real{} + shear_stiffness) * shear;
    }
};

}  // namespace coagula::dem::detail
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
