// SPDX-License-Identifier: GPL-3.0-or-later
// The sum of pair forces over rows of neighbours, for four or eight lanes: both give the same bits as long as products and sums are
// not fused. Whoever calls these loops inlines all of them, for its own instructions, which what std::array calls does not ask for.
#pragma once

#include "brownian_kernels.hpp"
#include "lanes.hpp"

#include <algorithm>
#include <cmath>

// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see above
namespace coagula::generators {

template <class Lanes>
struct ForceSum {
    Lanes x = {};
    Lanes y = {};
    Lanes z = {};
};

/// Brings distances to the nearest image: rounding by a number whose last bit is the unit.
struct Wrap {
    double period;
    double turns_per_length;

    explicit Wrap(double length) : period(length), turns_per_length(1 / length) {}

    template <class Lanes>
    COAGULA_INLINE void operator()(Lanes& distance, Lanes& turns) const {
        constexpr double round = 0x1.8p52;
        turns = (distance * turns_per_length + round) - round;
        distance -= turns * period;
    }
};

/// From a particle to some of its neighbours through the nearest images.
template <class Lanes>
struct Ways {
    Lanes x;
    Lanes y;
    Lanes z;

    COAGULA_INLINE void squared(Lanes& value) const { value = x * x + y * y + z * z; }
};

/// A copy of what the loop reads, so that the compiler knows that no store changes it.
struct Places {
    const double* positions;
    Wrap wrap_x;
    Wrap wrap_y;
    Wrap wrap_z;
    double lean;

    explicit Places(const PairLoop& loop)
        : positions(loop.positions), wrap_x(loop.period[0]), wrap_y(loop.period[1]), wrap_z(loop.period[2]), lean(loop.lean) {}

    template <class Lanes>
    COAGULA_INLINE void measure(const double* from, const std::int32_t* to, Ways<Lanes>& way) const {
        Lanes rest;
        gather(positions, to, way.x, way.y, way.z, rest);
        way.x -= from[0];
        way.y -= from[1];
        way.z -= from[2];
        // This leads to the nearest images of all pairs nearer than half of each period, however far the third edge leans.
        Lanes turns;
        wrap_z(way.z, turns);
        way.x -= turns * lean;
        wrap_y(way.y, turns);
        wrap_x(way.x, turns);
    }
};

/// Force over distance by the squared distance.
struct Table {
    double first;
    double inverse_spacing;
    std::int32_t intervals;
    const double* coefficients;

    explicit Table(const ForceTable& table)
        : first(table.first_squared()),
          inverse_spacing(table.inverse_spacing()),
          intervals(static_cast<std::int32_t>(table.intervals())),
          coefficients(table.coefficients()) {}
};

/// Eight neighbours at a time, or four: groups of rows on their way through two loops, which are short enough for a processor to
/// work on many groups at once. The first finds distances and places in the table, the second looks the forces up.
template <class Lanes, bool equal_radii>
class Block {
public:
    static constexpr std::size_t halves = NeighbourRows::width / lanes<Lanes>;
    static constexpr std::size_t most_groups = 32;

    Block(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows)
        : places_(loop), table_(table), radii_(loop.radii), slots_(rows.slots.data()), owners_(rows.owners.data()) {}

    COAGULA_INLINE void fill(std::size_t first_group, std::size_t end_group) {
        for (std::size_t group = first_group; group < end_group; ++group) {
            for (std::size_t half = 0; half < halves; ++half) {
                const std::int32_t* const neighbours = slots_ + NeighbourRows::width * group + half * lanes<Lanes>;
                measure(static_cast<std::size_t>(owners_[group]), neighbours, entries_[halves * (group - first_group) + half]);
            }
        }
    }

    /// @param group counted from the first in the block.
    COAGULA_INLINE void add(std::size_t group, ForceSum<Lanes> (&sum)[halves]) const {
        for (std::size_t half = 0; half < halves; ++half) {
            const Entry& entry = entries_[halves * group + half];
            Lanes a;
            Lanes b;
            Lanes c;
            Lanes d;
            gather(table_.coefficients, entry.interval, a, b, c, d);
            const Lanes t = entry.part;
            Lanes force = (a + t * b) + (t * t) * (c + t * d);
            if constexpr (!equal_radii) {
                force *= entry.scale;
            }
            sum[half].x -= force * entry.way.x;
            sum[half].y -= force * entry.way.y;
            sum[half].z -= force * entry.way.z;
        }
    }

private:
    struct Entry {
        Ways<Lanes> way;
        Lanes part;   ///< of the interval of the table
        Lanes scale;  ///< for unequal radii
        alignas(32) std::int32_t interval[lanes<Lanes>];
    };

    COAGULA_INLINE void measure(std::size_t slot, const std::int32_t* neighbours, Entry& entry) const {
        Ways<Lanes> way{};
        places_.measure(places_.positions + 4 * slot, neighbours, way);
        Lanes squared;
        way.squared(squared);
        if constexpr (!equal_radii) {
            scale(slot, neighbours, squared, entry.scale);
        }
        const Lanes place = (squared - table_.first) * table_.inverse_spacing;
        locate(place, entry);
        entry.way = way;
    }

    COAGULA_INLINE void locate(const Lanes& place, Entry& entry) const {
        using Whole = typename WholeOf<Lanes>::type;
        const Whole first = {};
        const Whole last = first + table_.intervals;
        Whole interval = __builtin_convertvector(place, Whole);
        interval = interval > first ? interval : first;
        interval = interval < last ? interval : last;
        entry.part = place - __builtin_convertvector(interval, Lanes);
        std::memcpy(entry.interval, &interval, sizeof(Whole));
    }

    /// From spheres of radius 1 to others at the same gap: `squared` becomes that of those.
    COAGULA_INLINE void scale(std::size_t slot, const std::int32_t* neighbours, Lanes& squared, Lanes& scale) const {
        const double own = radii_[slot];
        Lanes other;
        Lanes distance;
        for (std::size_t lane = 0; lane < lanes<Lanes>; ++lane) {
            other[lane] = radii_[neighbours[lane]];
            distance[lane] = std::sqrt(squared[lane]);
        }
        const Lanes contact = own + other;
        const Lanes equal_distance = distance - contact + 2;
        squared = equal_distance * equal_distance;
        // The particle itself, which fills up the row, must get no force.
        const Lanes nothing = {};
        distance = distance > nothing ? distance : nothing + 1;
        scale = 2 * own * other / contact * equal_distance / distance;
    }

    Places places_;
    Table table_;
    const double* radii_;
    const std::int32_t* slots_;
    const std::int32_t* owners_;
    Entry entries_[halves * most_groups];
};

/// The sum over the lanes as x, y, z.
COAGULA_INLINE void total(ForceSum<Four>& sum, Four& force) {
    Four rest = {};
    transpose(sum.x, sum.y, sum.z, rest);
    force = (sum.x + sum.y) + (sum.z + rest);
}

COAGULA_INLINE void total(ForceSum<Four> (&sum)[2], Four& force) {
    ForceSum<Four> both{sum[0].x + sum[1].x, sum[0].y + sum[1].y, sum[0].z + sum[1].z};
    total(both, force);
}

COAGULA_INLINE void add_halves(const Eight& both, Four& sum) {
    sum = __builtin_shufflevector(both, both, 0, 1, 2, 3) + __builtin_shufflevector(both, both, 4, 5, 6, 7);
}

COAGULA_INLINE void total(ForceSum<Eight> (&sum)[1], Four& force) {
    ForceSum<Four> both;
    add_halves(sum[0].x, both.x);
    add_halves(sum[0].y, both.y);
    add_halves(sum[0].z, both.z);
    total(both, force);
}

/// Calls finish(slot, force) for each slot.
template <class Lanes, bool equal_radii, class Finish>
COAGULA_INLINE void sum_rows(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const Finish& finish) {
    using Groups = Block<Lanes, equal_radii>;
    Groups block(loop, table, rows);
    std::size_t group = 0;
    std::size_t block_begin = 0;
    std::size_t block_end = 0;
    const std::size_t* row_end = rows.ends.data();
    for (std::size_t slot = rows.begin; slot < rows.end; ++slot, ++row_end) {
        ForceSum<Lanes> sum[Groups::halves];
        for (; group < *row_end; ++group) {
            if (group == block_end) {
                block_begin = block_end;
                block_end = std::min(block_end + Groups::most_groups, rows.owners.size());
                block.fill(block_begin, block_end);
            }
            block.add(group - block_begin, sum);
        }
        Four force;
        total(sum, force);
        finish(slot, force);
    }
}

template <class Lanes, class Finish>
COAGULA_INLINE void sum_rows(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const Finish& finish) {
    if (loop.radii == nullptr) {
        sum_rows<Lanes, true>(loop, table, rows, finish);
    } else {
        sum_rows<Lanes, false>(loop, table, rows, finish);
    }
}

}  // namespace coagula::generators
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
