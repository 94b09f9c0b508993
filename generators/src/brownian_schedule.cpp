// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_schedule.hpp"

#include <coagula/common/failures.hpp>

#include "plateau.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::generators {

namespace {

constexpr double longest_run = 1e15;              // steps
constexpr double default_sample_interval = 5e-4;  // in units of R^2/D, when no stop time is given
constexpr double default_plateau_time = 0.1;      // in units of R^2/D
constexpr int plateau_samples = 16;               // at least, over the time of the plateau

/// Whether all edges but the third stand upright, and that one leans along x if at all.
bool leans_along_x(const Cell& cell) {
    Eigen::Matrix3d rest = cell.edges();
    rest(0, 2) = 0;
    return rest.isDiagonal(0) && rest.diagonal().minCoeff() > 0;
}

}  // namespace

void check(const Packing& start, const BrownianOptions& options) {
    coagula::check(start);
    require(start.cell.is_periodic(), "Brownian dynamics needs a periodic box, but that of the start is open");
    const bool plateau = options.stop_plateau != PlateauOf::nothing;
    require(!std::isnan(options.stop_time) || !std::isnan(options.stop_coordination) || plateau,
            "Brownian dynamics needs a stop time, a stop coordination or a plateau to stop at");
    if (plateau) {
        require_positive(options.plateau_change, "the change that counts as a plateau");
        if (!std::isnan(options.plateau_time)) {
            require_positive(options.plateau_time, "the time of the plateau", "s");
        }
    }
    if (!std::isnan(options.stop_time)) {
        require_non_negative(options.stop_time, "the stop time", "s");
    }
    if (!std::isnan(options.stop_coordination)) {
        require_between(options.stop_coordination, 0, 12, "the stop coordination");
    }
    if (!std::isnan(options.sample_interval)) {
        require_positive(options.sample_interval, "the sample interval", "s");
    }
    require_between(options.contact_tolerance, 0, 0.5, "the contact tolerance");
    const Sedimentation& weight = options.sedimentation;
    require(std::isnan(weight.gravity) == std::isnan(weight.density_difference),
            "gravity and a density difference need each other");
    if (!std::isnan(weight.gravity)) {
        require_positive(weight.gravity, "gravity", "m/s^2");
        require(std::isfinite(weight.density_difference), "the density difference must be a finite number");
    }
    for (const double time : options.snapshot_times) {
        require_non_negative(time, "the time of a snapshot", "s");
    }
    check(options.flow);
    const bool flows = options.flow.given();
    require(!flows || std::isnan(weight.gravity),
            "particles settle towards a floor, which a shear flow does not have: take one of them");
    require(!flows || options.snapshot_times.empty(), "a shear flow changes the box, so that snapshots cannot be kept");
    require(leans_along_x(start.cell), "the box is tilted otherwise than a shear flow along x with its gradient along z tilts it");
}

double closest_gap(const Packing& packing) {
    const double reach = 2.2 * packing.radii.maxCoeff();
    const ContactNetwork pairs = find_pairs(packing, reach);
    double closest = packing.cell.edge_lengths().norm();
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const auto ends = pairs.ends.col(pair);
        const double contact = packing.radii[ends[0]] + packing.radii[ends[1]];
        const double gap = pairs.branch.col(pair).norm() - contact;
        if (gap < -largest_start_overlap * contact) {
            throw InputError("particles " + std::to_string(ends[0]) + " and " + std::to_string(ends[1]) + " overlap by " +
                             to_text(-gap) + " m at the start, which is more than " + to_text(100 * largest_start_overlap) +
                             " % of the sum of their radii");
        }
        closest = std::min(closest, gap);
    }
    return closest;
}

void check_start_coordination(double coordination, const BrownianOptions& options) {
    if (coordination >= options.stop_coordination) {
        throw OutOfReach("the start has " + to_text(coordination) + " contacts per particle, but the stop coordination is " +
                         to_text(options.stop_coordination) + ": it must be higher than that of the start");
    }
}

BrownianSchedule::BrownianSchedule(const BrownianOptions& options, const TimeStep& time_step, Index particles)
    : options_(options),
      time_step_(time_step.time_step),
      particles_(particles),
      plateau_time_(std::isnan(options.plateau_time) ? default_plateau_time * time_step.diffusion_time : options.plateau_time),
      last_step_(steps_until(std::isnan(options.stop_time) ? longest_run * time_step_ : options.stop_time)),
      sample_steps_(std::max<std::int64_t>(1, steps_until(sample_interval(time_step.diffusion_time)))) {
    for (const double time : options.snapshot_times) {
        snapshot_steps_.push_back(steps_until(time));
    }
    std::sort(snapshot_steps_.begin(), snapshot_steps_.end());
}

std::int64_t BrownianSchedule::steps_until(double time) const {
    return static_cast<std::int64_t>(std::ceil(std::min(time / time_step_, longest_run) - 1e-9));
}

double BrownianSchedule::sample_interval(double diffusion_time) const {
    const bool plateau = options_.stop_plateau != PlateauOf::nothing;
    if (!std::isnan(options_.sample_interval)) {
        require(!plateau || plateau_samples * options_.sample_interval <= plateau_time_,
                "the sample interval is " + to_text(options_.sample_interval) + " s, but a plateau of " + to_text(plateau_time_) +
                    " s needs at least " + std::to_string(plateau_samples) + " samples");
        return options_.sample_interval;
    }
    const bool timed = options_.stop_time > 0;
    const double interval = timed ? options_.stop_time / 200 : default_sample_interval * diffusion_time;
    return plateau ? std::min(interval, plateau_time_ / plateau_samples) : interval;
}

bool BrownianSchedule::keeps_at(std::int64_t step) const {
    return step < last_step_ && std::binary_search(snapshot_steps_.begin(), snapshot_steps_.end(), step);
}

std::int64_t BrownianSchedule::next_due(std::int64_t step) const {
    const std::int64_t sample = std::min(last_step_, (step / sample_steps_ + 1) * sample_steps_);
    const auto kept = std::upper_bound(snapshot_steps_.begin(), snapshot_steps_.end(), step);
    return kept == snapshot_steps_.end() ? sample : std::min(sample, *kept);
}

std::string BrownianSchedule::ended_by(std::int64_t step, const BrownianSeries& series) const {
    if (step >= last_step_) {
        return "time";
    }
    if (!std::isnan(options_.stop_coordination) && series.coordination.back() >= options_.stop_coordination) {
        return "coordination";
    }
    const bool sampled = series.time.back() == time(step);
    const bool together = 2 * series.largest.back() >= particles_;
    if (options_.stop_plateau != PlateauOf::nothing && sampled && together) {
        const auto& values = options_.stop_plateau == PlateauOf::coordination ? series.coordination : series.mean_gap;
        return is_plateau(series.time, values, plateau_time_, options_.plateau_change) ? "plateau" : "";
    }
    return "";
}

double BrownianSchedule::share_done(std::int64_t step, const BrownianSeries& series) const {
    const double by_time = static_cast<double>(step) / static_cast<double>(last_step_);
    const double by_contacts =
        std::isnan(options_.stop_coordination) ? 0.0 : series.coordination.back() / options_.stop_coordination;
    return std::max(by_time, by_contacts);
}

}  // namespace coagula::generators
