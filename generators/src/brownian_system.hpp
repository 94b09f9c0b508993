// Many Brownian particles with their neighbour lists: the state behind a run. Reduced units: mean radius, kB T and the diffusion
// coefficient of a particle of mean radius are 1.
#pragma once

#include "brownian_kernels.hpp"
#include "force_table.hpp"
#include "step_scheme.hpp"

#include <coagula/common/packing.hpp>
#include <coagula/common/random.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace coagula::generators {

struct BrownianSetup {
    Eigen::Vector3d period;  ///< of the periodic box
    Eigen::VectorXd radii;   ///< N, with mean 1
    ForceTable near;         ///< force by the gap evaluated in each stage of each step
    ForceTable far;          ///< the rest, evaluated once in `far_interval` steps and held
    StepScheme scheme;
    double time_step = 0;
    std::int64_t far_interval = 1;
    std::uint64_t seed = 1;
    RandomPurpose noise = RandomPurpose::brownian_force;
    double mobility = 1;  ///< of a particle of mean radius
};

/// All that a run needs to go on to the same bits; vectors are 3 x N in the caller's order.
struct BrownianState {
    std::int64_t step = 0;
    Eigen::Matrix3Xd positions;       ///< not wrapped into the box
    Eigen::Matrix3Xd list_reference;  ///< positions when the list of all pairs was made
    Eigen::Matrix3Xd near_reference;  ///< the same of the list of near pairs
    Eigen::Matrix3Xd far_forces;
};

/// A state to start from.
BrownianState initial_state(const Eigen::Matrix3Xd& positions);

class BrownianSystem {
public:
    /// Throws std::invalid_argument when the box is so small that a pair meets through more than one image.
    BrownianSystem(BrownianSetup setup, const BrownianState& state);

    /// One time step. The results do not depend on the number of threads.
    void step();

    std::int64_t steps() const { return step_; }
    double time() const { return static_cast<double>(step_) * setup_.time_step; }
    /// As the scheme has them, not wrapped.
    Eigen::Matrix3Xd positions() const { return in_order(position_); }
    /// To be measured: after the postprocessor of the scheme. Does not change the run.
    Eigen::Matrix3Xd observed_positions() const;
    BrownianState state() const;
    std::int64_t lists_made() const { return lists_made_; }
    std::size_t near_pairs() const;

private:
    /// Pairs of the particles of a chunk: with each other, and (forces on the first only) with those of other chunks.
    struct Pairs {
        std::vector<SlotPair> inside;
        std::vector<SlotPair> across;
    };
    /// Consecutive slots. The number of chunks depends on the number of particles only.
    struct Chunk {
        std::size_t begin = 0;
        std::size_t end = 0;
        Pairs all;
        Pairs near;
        double list_path_squared = 0;  ///< largest squared distance from the references
        double near_path_squared = 0;
    };

    void sort_slots();
    void make_list();
    void list_pairs(Chunk& chunk, const class PairFinder& finder) const;
    void choose_near();
    void choose_near(const std::vector<SlotPair>& from, std::vector<SlotPair>& to) const;
    void measure_paths(Chunk& chunk) const;
    void begin_step(Chunk& chunk, bool refresh_far);
    void sum_forces(const Chunk& chunk);
    void move(Chunk& chunk, std::size_t stage);
    void add_forces(const Pairs& pairs, const ForceTable& table, const std::vector<double>& positions,
                    std::vector<double>& forces) const;
    StageArrays arrays();
    std::vector<double> in_slots(const Eigen::Matrix3Xd& values) const;
    Eigen::Matrix3Xd in_order(const std::vector<double>& slots) const;

    BrownianSetup setup_;
    bool equal_radii_;
    double list_skin_;
    double near_skin_;
    double reserve_;  ///< farther than this a particle hardly goes within a step
    std::int64_t step_ = 0;
    std::int64_t lists_made_ = 0;
    std::vector<Chunk> chunks_;
    std::vector<std::int32_t> particle_;  ///< of each slot
    // Four numbers per slot:
    std::vector<double> position_, list_reference_, near_reference_, current_, previous_, noise_, force_, far_;
    // One number per slot:
    std::vector<double> radius_, mobility_, noise_scale_;
};

}  // namespace coagula::generators
