// Written with the vector types of GCC and clang: four pairs in the lanes of a register where the processor has AVX2, in two halves
// elsewhere. Compiled without fused multiply-add, so both give the same bits.
#include "brownian_kernels.hpp"

#include <cmath>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#define COAGULA_VARIANTS __attribute__((target_clones("avx2", "default")))
#else
#define COAGULA_VARIANTS
#endif
#define COAGULA_INLINE inline __attribute__((always_inline))

namespace coagula::generators {

namespace {

constexpr int width = 4;
using Four = double __attribute__((vector_size(32)));
using Whole = std::int32_t __attribute__((vector_size(16)));

COAGULA_INLINE void load(const double* source, Four& value) {
    std::memcpy(&value, source, sizeof(Four));
}

COAGULA_INLINE void store(double* target, const Four& value) {
    std::memcpy(target, &value, sizeof(Four));
}

/// Rows become columns.
COAGULA_INLINE void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Four ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Four cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// To the nearest image: rounding by a number whose last bit is the unit.
COAGULA_INLINE void wrap(Four& distance, double period) {
    constexpr double round = 0x1.8p52;
    const Four turns = (distance * (1 / period) + round) - round;
    distance -= turns * period;
}

COAGULA_INLINE void square_root(Four& value) {
    for (int lane = 0; lane < width; ++lane) {
        value[lane] = std::sqrt(value[lane]);
    }
}

/// Four pairs; the shares scale their forces.
template <bool both>
COAGULA_INLINE void add_forces_of_four(const PairLoop& loop, const ForceTable& table, const SlotPair* ends, Four share) {
    const double first_knot = table.first();
    const double inverse_spacing = table.inverse_spacing();
    const auto beyond = static_cast<double>(table.intervals());
    const double* const coefficients = table.coefficients();
    Four separation[width];
    for (int lane = 0; lane < width; ++lane) {
        Four from;
        Four to;
        load(loop.positions + 4 * static_cast<std::size_t>(ends[lane].first), from);
        load(loop.positions + 4 * static_cast<std::size_t>(ends[lane].second), to);
        separation[lane] = to - from;
    }
    auto& [x, y, z, rest] = separation;
    transpose(x, y, z, rest);
    wrap(x, loop.period[0]);
    wrap(y, loop.period[1]);
    wrap(z, loop.period[2]);
    Four distance = x * x + y * y + z * z;
    square_root(distance);
    Four reach = {2, 2, 2, 2};
    if (loop.radii != nullptr) {
        for (int lane = 0; lane < width; ++lane) {
            const double one = loop.radii[ends[lane].first];
            const double other = loop.radii[ends[lane].second];
            reach[lane] = one + other;
            share[lane] *= 2 * one * other / (one + other);
        }
    }
    const Four place = (distance - reach - first_knot) * inverse_spacing;
    const Four nothing = {0, 0, 0, 0};
    const Four end = nothing + beyond;
    Four inside = place > nothing ? place : nothing;
    inside = inside < end ? inside : end;
    Four cubic[width];
    const Whole interval = __builtin_convertvector(inside, Whole);
    const Four knot = __builtin_convertvector(interval, Four);
    for (int lane = 0; lane < width; ++lane) {
        load(coefficients + 4 * static_cast<std::size_t>(interval[lane]), cubic[lane]);
    }
    transpose(cubic[0], cubic[1], cubic[2], cubic[3]);
    const Four t = place - knot;
    const Four force = cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
    const Four over_distance = share * force / distance;
    x *= over_distance;
    y *= over_distance;
    z *= over_distance;
    rest = nothing;
    transpose(x, y, z, rest);
    for (int lane = 0; lane < width; ++lane) {
        double* const on_first = loop.forces + 4 * static_cast<std::size_t>(ends[lane].first);
        Four sum;
        load(on_first, sum);
        store(on_first, sum - separation[lane]);
        if constexpr (both) {
            double* const on_second = loop.forces + 4 * static_cast<std::size_t>(ends[lane].second);
            load(on_second, sum);
            store(on_second, sum + separation[lane]);
        }
    }
}

template <bool both>
COAGULA_INLINE void add_forces(const PairLoop& loop, const ForceTable& table, const SlotPair* pairs, std::size_t count) {
    const Four whole = {1, 1, 1, 1};
    std::size_t begin = 0;
    for (; begin + width <= count; begin += width) {
        add_forces_of_four<both>(loop, table, pairs + begin, whole);
    }
    if (begin < count) {
        // Filled up with the first of the rest, which counts once only.
        SlotPair ends[width];
        Four share = {0, 0, 0, 0};
        for (int lane = 0; lane < width; ++lane) {
            const std::size_t entry = begin + static_cast<std::size_t>(lane);
            ends[lane] = pairs[entry < count ? entry : begin];
            share[lane] = entry < count ? 1 : 0;
        }
        add_forces_of_four<both>(loop, table, ends, share);
    }
}

}  // namespace

COAGULA_VARIANTS void add_forces_on_both(const PairLoop& loop, const ForceTable& table, const SlotPair* pairs, std::size_t count) {
    add_forces<true>(loop, table, pairs, count);
}

COAGULA_VARIANTS void add_forces_on_first(const PairLoop& loop, const ForceTable& table, const SlotPair* pairs, std::size_t count) {
    add_forces<false>(loop, table, pairs, count);
}

COAGULA_VARIANTS void first_stage(const StageArrays& slots, std::size_t begin, std::size_t end, const StageWeights& weights,
                                  double time_step) {
    const double scale = weights.force * time_step;
    for (std::size_t slot = begin; slot < end; ++slot) {
        Four position;
        Four noise;
        Four force;
        load(slots.before + 4 * slot, position);
        load(slots.noise + 4 * slot, noise);
        load(slots.force + 4 * slot, force);
        store(slots.target + 4 * slot, position + scale * slots.mobility[slot] * force + weights.noise * noise);
    }
}

COAGULA_VARIANTS void later_stage(const StageArrays& slots, std::size_t begin, std::size_t end, const StageWeights& weights,
                                  double time_step) {
    const double scale = weights.force * time_step;
    for (std::size_t slot = begin; slot < end; ++slot) {
        Four latest;
        Four before;
        Four force;
        load(slots.latest + 4 * slot, latest);
        load(slots.before + 4 * slot, before);
        load(slots.force + 4 * slot, force);
        store(slots.target + 4 * slot, weights.current * latest + weights.previous * before + scale * slots.mobility[slot] * force);
    }
}

}  // namespace coagula::generators
