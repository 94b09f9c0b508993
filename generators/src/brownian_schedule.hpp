// SPDX-License-Identifier: GPL-3.0-or-later
// The schedule says from what a Brownian run may start, when it is sampled and when it ends, whatever moves its particles.
#pragma once

#include <coagula/generators/brownian_dynamics.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace coagula::generators {

inline constexpr double largest_start_overlap = 0.05;  // of the sum of the radii

/// Throws std::invalid_argument for options that are impossible with every integrator.
void check(const Packing& start, const BrownianOptions& options);

/// Smallest gap between particles [m]; a box diagonal when all are far apart. Throws InputError for particles that overlap by more
/// than `largest_start_overlap`.
double closest_gap(const Packing& packing);

/// Throws OutOfReach unless the contacts of the start are fewer than those at which the run is to stop.
void check_start_coordination(double coordination, const BrownianOptions& options);

/// Counted in time steps.
class BrownianSchedule {
public:
    /// Throws std::invalid_argument for too few samples over the time of a plateau.
    BrownianSchedule(const BrownianOptions& options, const TimeStep& time_step, Index particles);

    std::int64_t last_step() const { return last_step_; }
    std::int64_t sample_steps() const { return sample_steps_; }
    double time(std::int64_t step) const { return static_cast<double>(step) * time_step_; }
    bool samples_at(std::int64_t step) const { return step % sample_steps_ == 0 || step == last_step_; }
    /// Whether the positions of this step are kept.
    bool keeps_at(std::int64_t step) const;
    /// The first step after this one at which a sample or a snapshot is due.
    std::int64_t next_due(std::int64_t step) const;

    /// Names what ends the run at this step; the name is empty as long as the run goes on.
    std::string ended_by(std::int64_t step, const BrownianSeries& series) const;
    /// The share of the run that is done, by its time or by its contacts.
    double share_done(std::int64_t step, const BrownianSeries& series) const;

private:
    std::int64_t steps_until(double time) const;
    double sample_interval(double diffusion_time) const;

    const BrownianOptions& options_;
    double time_step_;
    Index particles_;
    double plateau_time_;
    std::int64_t last_step_;
    std::int64_t sample_steps_;
    std::vector<std::int64_t> snapshot_steps_;
};

}  // namespace coagula::generators
