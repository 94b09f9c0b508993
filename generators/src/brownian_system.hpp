// SPDX-License-Identifier: GPL-3.0-or-later
// Many Brownian particles with their neighbour lists: the state behind a run. Reduced units: mean radius, kB T and the diffusion
// coefficient of a particle of mean radius are 1.
#pragma once

#include "brownian_kernels.hpp"
#include "contact_springs.hpp"
#include "force_table.hpp"
#include "step_scheme.hpp"

#include <coagula/common/packing.hpp>
#include <coagula/common/random.hpp>
#include <coagula/generators/shear_flow.hpp>

#include <Eigen/Core>

#include <array>
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
    double weight = 0;   ///< of a sphere of mean radius, along -z
    double ceiling = 0;  ///< height of an elastic wall above another one at z = 0; no walls if 0
    double wall_stiffness = 0;
    SpringRules springs = {};  ///< what contacts oppose to sliding and rolling; particles turn only where something does
    double lean = 0;           ///< along x of the third edge of the box at the start
    ShearFlow flow = {};       ///< a time step is a time
};

/// All that a run needs to go on to the same bits; vectors are 3 x N in the caller's order.
struct BrownianState {
    std::int64_t step = 0;
    Eigen::Matrix3Xd positions;       ///< not wrapped into the box
    Eigen::Matrix3Xd list_reference;  ///< positions when the list of all pairs was made
    Eigen::Matrix3Xd near_reference;  ///< the same of the list of near pairs
    double list_strain = 0;           ///< of the flow then
    double near_strain = 0;
    Eigen::Matrix3Xd far_forces;
    Eigen::Matrix3Xd rotations;          ///< sum of the rotation vectors of all steps; empty where particles do not turn
    std::vector<ContactSpring> springs;  ///< sorted by their particles
};

/// Sums over pairs of branch times the force on its first particle, with the part that opposes sliding.
struct Virial {
    Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d sliding = Eigen::Matrix3d::Zero();
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
    Eigen::Matrix3Xd positions() const { return in_order(translation_.start); }
    /// Sums of rotation vectors; empty where particles do not turn.
    Eigen::Matrix3Xd rotations() const { return setup_.springs.active() ? in_order(rotation_.start) : Eigen::Matrix3Xd(); }
    /// To be measured: after the postprocessor of the scheme. Does not change the run.
    Eigen::Matrix3Xd observed_positions() const;
    /// The energy of the springs in contacts, measured likewise.
    SpringEnergy observed_energy() const;
    /// What the contacts remember, as the scheme has it, sorted by their particles.
    std::vector<ContactSpring> springs() const;
    /// Measured likewise, with the forces that move the particles.
    Virial observed_virial() const;
    /// Strain of the flow since the start.
    double strain() const { return strain_; }
    /// Along x of the third edge of the box, at most half a period.
    double lean() const { return lean_at(strain_); }
    BrownianState state() const;

private:
    /// Pairs of the particles of a chunk: with each other, and (forces on the first only) with those of other chunks.
    struct Pairs {
        std::vector<SlotPair> inside;
        std::vector<SlotPair> across;
    };
    /// Springs of the pairs that touch, in the same two lists.
    struct Springs {
        std::vector<LoadedSpring> inside;
        std::vector<LoadedSpring> across;
    };
    /// Consecutive slots. The number of chunks depends on the number of particles only.
    struct Chunk {
        std::size_t begin = 0;
        std::size_t end = 0;
        NeighbourRows all;
        NeighbourRows near;
        Pairs near_pairs;  ///< the same as `near`, only where contacts resist
        Springs springs;
        double list_path_squared = 0;  ///< largest squared distance from the references
        double near_path_squared = 0;
    };

    /// Arrays of the stages of one step. Four numbers per slot, but one per slot of mobility and noise_scale.
    struct Motion {
        std::vector<double> start, noise, second_noise, force, mobility, noise_scale;
        /// Forces of stage i are taken at [i % 2], which the stage before it left there; the first at the start with some noise.
        std::array<std::vector<double>, 2> stages;

        void resize(std::size_t slots);
        StageArrays arrays(std::size_t stage);
        /// The start with the noise of the postprocessor.
        std::vector<double> observed(const BrownianSetup& setup, std::int64_t step, RandomPurpose purpose,
                                     const std::vector<std::int32_t>& particles) const;
    };

    void make_list();
    void list_pairs(Chunk& chunk, const class PairFinder& finder) const;
    void choose_near();
    /// @param strain at which the positions are.
    void measure_paths(Chunk& chunk, const std::vector<double>& positions, double strain) const;
    double lean_at(double strain) const;
    /// The same at a stage of the step, without whole periods less.
    double lean_of_stage(std::size_t stage) const;
    void set_stage_times();
    bool has_other_forces() const { return setup_.ceiling > 0 || setup_.springs.active() || setup_.flow.given(); }
    void add_flow(const Chunk& chunk);
    Eigen::Matrix3d observed_sliding_virial(const std::vector<double>& moved) const;
    Eigen::Matrix3d pair_virial(const Chunk& chunk, const std::vector<double>& positions) const;
    void begin_step(Chunk& chunk, bool refresh_far);
    void draw_noise(Motion& motion, const Chunk& chunk, RandomPurpose purpose) const;
    void pass_stage(Chunk& chunk, std::size_t stage);
    void add_other_forces(const Chunk& chunk, std::size_t stage);
    void add_walls(const Chunk& chunk, std::size_t stage);
    void pair_up(Chunk& chunk) const;
    void advance_contacts(Chunk& chunk) const;
    template <class Call>
    void for_each_contact(Call&& call) const;
    void place_springs(const std::vector<ContactSpring>& springs);
    /// @param stage where the particles have moved to.
    SpringLoop spring_loop(std::size_t stage) const;
    PairLoop pair_loop(const std::vector<double>& positions, double lean) const;
    std::vector<double> in_slots(const Eigen::Matrix3Xd& values) const;
    Eigen::Matrix3Xd in_order(const std::vector<double>& slots) const;

    BrownianSetup setup_;
    bool equal_radii_;
    double list_skin_;
    double reserve_;  ///< farther than this a particle hardly goes within a step
    double near_skin_;
    std::int64_t step_ = 0;
    double strain_ = 0;  ///< of the flow
    double next_strain_ = 0;
    double list_strain_ = 0;  ///< when the lists were made
    double near_strain_ = 0;
    std::vector<double> stage_times_;  ///< where a constant velocity has taken the particles at each stage, in time steps
    std::vector<Chunk> chunks_;
    std::vector<std::int32_t> particle_;  ///< of each slot
    Motion translation_;
    Motion rotation_;  ///< empty where particles do not turn
    // Four numbers per slot:
    std::vector<double> list_reference_, near_reference_, far_;
    std::vector<double> radius_;  ///< of each slot
};

}  // namespace coagula::generators
