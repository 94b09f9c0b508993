// SPDX-License-Identifier: GPL-3.0-or-later
// Eight lanes where the processor has AVX-512; else four, in a register with AVX2 and in two halves without. Compiled without fused
// multiply-add, so all give the same bits.
#include "brownian_kernels.hpp"

#include "pair_blocks.hpp"

#include <array>

#if defined(__x86_64__) && defined(__GNUC__)
#define COAGULA_VARIANTS __attribute__((target_clones("avx2", "default")))
#define COAGULA_WIDE __attribute__((target("avx512f,avx512vl,avx512dq")))
#else
#define COAGULA_VARIANTS
#endif

namespace coagula::generators {

namespace {

/// Displaces particles as a stage does.
struct Move {
    StageArrays slots{};
    StageWeights weights;
    double scale = 0;

    COAGULA_INLINE void operator()(std::size_t slot, const Four& force) const {
        Four latest;
        Four before;
        Four noise;
        Four second;
        load(slots.latest + 4 * slot, latest);
        load(slots.before + 4 * slot, before);
        load(slots.noise + 4 * slot, noise);
        load(slots.second_noise + 4 * slot, second);
        const Four kick = slots.noise_scale[slot] * (weights.noise * noise + weights.second_noise * second);
        store(slots.target + 4 * slot,
              weights.current * latest + weights.previous * before + scale * slots.mobility[slot] * force + kick);
    }
};

}  // namespace

void NeighbourRows::clear(std::size_t first_slot, std::size_t end_slot) {
    begin = first_slot;
    end = end_slot;
    slots.clear();
    owners.clear();
    ends.clear();
}

void NeighbourRows::close_row() {
    const auto owner = static_cast<std::int32_t>(begin + ends.size());
    while (slots.size() % width != 0) {
        slots.push_back(owner);
    }
    owners.resize(slots.size() / width, owner);
    ends.push_back(owners.size());
}

COAGULA_VARIANTS void choose_neighbours(const PairLoop& loop, double reach, const NeighbourRows& all, NeighbourRows& chosen) {
    const Places places(loop);
    chosen.clear(all.begin, all.end);
    std::size_t entry = 0;
    for (std::size_t slot = all.begin; slot < all.end; ++slot) {
        const std::size_t row_end = NeighbourRows::width * all.ends[slot - all.begin];
        std::size_t count = chosen.slots.size();
        chosen.slots.resize(count + row_end - entry + 1);
        for (; entry < row_end; entry += 4) {
            const std::int32_t* const neighbours = all.slots.data() + entry;
            Four limit = Four{} + (reach + 2);
            for (int lane = 0; loop.radii != nullptr && lane < 4; ++lane) {
                limit[lane] = reach + loop.radii[slot] + loop.radii[neighbours[lane]];
            }
            Ways<Four> way{};
            places.measure(places.positions + 4 * slot, neighbours, way);
            Four squared;
            way.squared(squared);
            const auto near = squared < limit * limit;
            // Without a branch: one that is not near is overwritten by the next.
            for (int lane = 0; lane < 4; ++lane) {
                chosen.slots[count] = neighbours[lane];
                count += near[lane] != 0 && neighbours[lane] != static_cast<std::int32_t>(slot) ? 1U : 0U;
            }
        }
        chosen.slots.resize(count);
        chosen.close_row();
    }
}

COAGULA_VARIANTS double longest_squared_way(const double* one, const double* other, double strain, std::size_t begin,
                                            std::size_t end) {
    Four longest = {};
    for (std::size_t slot = begin; slot < end; slot += 4) {
        // What is missing in the last four is the last slot again.
        const std::size_t last = end - 1;
        const std::array<std::size_t, 4> slots = {slot, std::min(slot + 1, last), std::min(slot + 2, last),
                                                  std::min(slot + 3, last)};
        Ways<Four> way{};
        Ways<Four> there{};
        Four rest;
        gather(one, slots.data(), way.x, way.y, way.z, rest);
        gather(other, slots.data(), there.x, there.y, there.z, rest);
        way.x -= there.x + strain * there.z;
        way.y -= there.y;
        way.z -= there.z;
        Four squared;
        way.squared(squared);
        longest = squared > longest ? squared : longest;
    }
    return std::max(std::max(longest[0], longest[1]), std::max(longest[2], longest[3]));
}

COAGULA_VARIANTS void displace(const double* before, const double* noise, const double* noise_scale, double evaluation,
                               std::size_t begin, std::size_t end, double* latest) {
    for (std::size_t slot = begin; slot < end; ++slot) {
        Four kick;
        Four position;
        load(noise + 4 * slot, kick);
        load(before + 4 * slot, position);
        store(latest + 4 * slot, position + evaluation * noise_scale[slot] * kick);
    }
}

namespace {

template <class Lanes>
COAGULA_INLINE void sum_all(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, double* forces) {
    sum_rows<Lanes>(loop, table, rows,
                    [forces](std::size_t slot, const Four& sum) COAGULA_INLINE_LAMBDA { store(forces + 4 * slot, sum); });
}

template <class Lanes>
COAGULA_INLINE void move_all(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const Move& move) {
    const double* const others = move.slots.force;
    sum_rows<Lanes>(loop, table, rows, [&move, others](std::size_t slot, const Four& sum) COAGULA_INLINE_LAMBDA {
        Four other;
        load(others + 4 * slot, other);
        move(slot, sum + other);
    });
}

COAGULA_VARIANTS void sum_in_halves(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, double* forces) {
    sum_all<Four>(loop, table, rows, forces);
}

COAGULA_VARIANTS void move_in_halves(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const Move& move) {
    move_all<Four>(loop, table, rows, move);
}

#ifdef COAGULA_WIDE
COAGULA_WIDE void sum_at_once(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, double* forces) {
    sum_all<Eight>(loop, table, rows, forces);
}

COAGULA_WIDE void move_at_once(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const Move& move) {
    move_all<Eight>(loop, table, rows, move);
}

const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq");
#endif

}  // namespace

void sum_pair_forces(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, double* forces) {
#ifdef COAGULA_WIDE
    if (wide) {
        return sum_at_once(loop, table, rows, forces);
    }
#endif
    sum_in_halves(loop, table, rows, forces);
}

void stage_with_pairs(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const StageArrays& slots,
                      const StageWeights& weights, double time_step) {
    const Move move{slots, weights, weights.force * time_step};
#ifdef COAGULA_WIDE
    if (wide) {
        return move_at_once(loop, table, rows, move);
    }
#endif
    move_in_halves(loop, table, rows, move);
}

COAGULA_VARIANTS void stage(const StageArrays& slots, std::size_t begin, std::size_t end, const StageWeights& weights,
                            double time_step) {
    const Move move{slots, weights, weights.force * time_step};
    for (std::size_t slot = begin; slot < end; ++slot) {
        Four force;
        load(slots.force + 4 * slot, force);
        move(slot, force);
    }
}

}  // namespace coagula::generators
