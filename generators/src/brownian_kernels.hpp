// The loop over pairs of Brownian particles, four pairs at a time.
#pragma once

#include "force_table.hpp"

#include <cstddef>
#include <cstdint>

namespace coagula::generators {

struct SlotPair {
    std::int32_t first;
    std::int32_t second;
};

/// What the loop reads and writes. Positions and forces have four numbers per slot (x, y, z and one without meaning).
struct PairLoop {
    const double* positions = nullptr;
    double* forces = nullptr;
    const double* radii = nullptr;  ///< null: all are 1
    double period[3] = {};          ///< of the periodic box
};

/// Adds the forces of the pairs to both of their particles. Pairs meet through the nearest images. For unequal radii the table,
/// which is that of two spheres of radius 1, is scaled with 2 R1 R2/(R1 + R2) (Derjaguin's approximation). The results do not
/// depend on the instructions of the processor.
void add_forces_on_both(const PairLoop& loop, const ForceTable& table, const SlotPair* pairs, std::size_t count);

/// The same, for the first particles only.
void add_forces_on_first(const PairLoop& loop, const ForceTable& table, const SlotPair* pairs, std::size_t count);

/// Arrays of four numbers per slot, as above, of one stage of a step.
struct StageArrays {
    const double* before;  ///< K_(i-2); in the first stage X, the start of the step
    const double* latest;  ///< K_(i-1), where the forces were taken
    const double* noise;   ///< displacement by the noise of the step
    const double* force;
    const double* mobility;  ///< one number per slot
    double* target;          ///< K_i; may be `before`
};

/// Weights of one stage: target <- force dt mobility F + current K_(i-1) + previous K_(i-2); in the first stage
/// target <- X + force dt mobility F + noise Q.
struct StageWeights {
    double force = 0;
    double current = 0;
    double previous = 0;
    double noise = 0;
};

void first_stage(const StageArrays& slots, std::size_t begin, std::size_t end, const StageWeights& weights, double time_step);
void later_stage(const StageArrays& slots, std::size_t begin, std::size_t end, const StageWeights& weights, double time_step);

}  // namespace coagula::generators
