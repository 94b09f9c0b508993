// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidate_measurements.hpp"

#include "observables/structure_observations.hpp"

#include <coagula/common/logarithmic_steps.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr int rows = 20;
constexpr int gaps = 8;
constexpr double usual_cone = std::numbers::pi / 180;  ///< [rad]
constexpr double rest = 3;                             ///< between two sweeps, over what the runs so far have taken

/// The settings of an experiment.
struct Habits {
    double small_strain = 1e-4;
    double large_strain = 0.1;
    double angular_frequency = 2 * std::numbers::pi;
    double duration = 600;
    double modulus = 1;  ///< largest
};

Habits habits_of(const std::vector<Observation>& observations) {
    Habits habits;
    double smallest = 1e300;
    double largest = 0;
    double longest = 0;
    for (const Observation& one : observations) {
        if (std::isfinite(one.strain)) {
            smallest = std::min(smallest, one.strain);
            largest = std::max(largest, one.strain);
        }
        if (std::isfinite(one.angular_frequency)) {
            habits.angular_frequency = one.angular_frequency;
        }
        longest = std::max(longest, one.time);
        habits.modulus = std::max(habits.modulus, one.value);
    }
    habits.small_strain = smallest < 1e300 ? smallest : habits.small_strain;
    habits.large_strain = std::max(largest, 10 * habits.small_strain);
    habits.duration = std::max(longest, habits.duration);
    return habits;
}

/// Whether the gap becomes narrower in some table.
bool narrows(const Experiment& experiment) {
    return std::any_of(experiment.measurements.begin(), experiment.measurements.end(), [](const Measurement& table) {
        const Column* gap = find_column(table, "gap");
        return gap != nullptr && gap->values.back() < gap->values.front();
    });
}

/// A table whose columns are given or constant.
class Plan {
public:
    Plan(const Habits& habits, double gap, std::size_t count)
        : strain_(count, habits.small_strain), frequency_(count, habits.angular_frequency), gap_(count, gap), time_(count) {
        for (std::size_t k = 0; k < count; ++k) {
            time_[k] = habits.duration * static_cast<double>(k + 1) / static_cast<double>(count);
        }
    }
    Plan& strain(std::vector<double> values) { return strain_ = std::move(values), *this; }
    Plan& frequency(std::vector<double> values) { return frequency_ = std::move(values), *this; }
    Plan& time(std::vector<double> values) { return time_ = std::move(values), *this; }
    Plan& gap(std::vector<double> values) { return gap_ = std::move(values), *this; }

    /// An amplitude sweep with the third harmonics of its waveforms.
    Measurement with_waveforms() const {
        Measurement made = table(MeasurementKind::amplitude_sweep);
        const std::vector<double> zeros(strain_.size(), 0.0);
        made.columns.push_back({"third_harmonic_storage", "1", zeros});
        made.columns.push_back({"third_harmonic_loss", "1", zeros});
        return made;
    }

    Measurement table(MeasurementKind kind) const {
        Measurement made;
        made.kind = kind;
        made.label = "proposed";
        made.sample = "proposed";
        const std::vector<double> ones(strain_.size(), 1.0);
        made.columns = {{"strain", "1", strain_},
                        {"angular_frequency", "rad/s", frequency_},
                        {"time", "s", time_},
                        {"storage_modulus", "Pa", ones},
                        {"loss_modulus", "Pa", ones}};
        if (std::isfinite(gap_.front())) {
            made.columns.push_back({"gap", "m", gap_});
        }
        return made;
    }

private:
    std::vector<double> strain_;
    std::vector<double> frequency_;
    std::vector<double> gap_;
    std::vector<double> time_;
};

std::vector<Candidate> shear_candidates(const Experiment& experiment, const std::vector<Observation>& observations) {
    const Habits habits = habits_of(observations);
    const double gap = experiment.instrument.gap;
    const Plan plan(habits, gap, rows);
    const auto frequencies = [&](double around) {
        return logarithmic_steps(habits.angular_frequency / around, habits.angular_frequency * around, rows);
    };
    std::vector<double> up_and_down = logarithmic_steps(habits.small_strain, habits.large_strain, rows / 2);
    up_and_down.insert(up_and_down.end(), up_and_down.rbegin(), up_and_down.rend());

    std::vector<Candidate> candidates;
    const auto add = [&](const std::string& key, std::vector<double> lengths, const auto&... measurement) -> Candidate& {
        candidates.push_back({key, std::move(lengths), unset, experiment, {}});
        candidates.back().experiment.measurements = {measurement...};
        return candidates.back();
    };
    add("time-sweep", {}, plan.table(MeasurementKind::time_sweep));
    const Measurement longer =
        Plan(plan).time(logarithmic_steps(0.01 * habits.duration, 10 * habits.duration, rows)).table(MeasurementKind::time_sweep);
    Measurement trapped = longer;
    trapped.solvent_trap = true;
    add("long-time-sweep", {}, longer);
    add("long-time-sweep-under-trap", {}, trapped);
    add("frequency-sweep", {}, Plan(plan).frequency(frequencies(100)).table(MeasurementKind::frequency_sweep));
    const Plan sweep = Plan(plan).strain(logarithmic_steps(habits.small_strain, habits.large_strain, rows));
    const Measurement amplitudes = sweep.table(MeasurementKind::amplitude_sweep);
    add("amplitude-sweep", {}, amplitudes);
    add("amplitude-sweep-with-waveforms", {}, sweep.with_waveforms());
    const double faster = 10 * habits.angular_frequency;
    add("amplitude-sweep-at-high-frequency", {},
        Plan(sweep).frequency(std::vector<double>(rows, faster)).table(MeasurementKind::amplitude_sweep));
    Measurement again = amplitudes;
    again.run_order = 1;
    again.pause = rest * habits.duration;
    add("amplitude-sweep-and-again", {}, amplitudes, again).rest = again.pause;
    add("amplitude-sweep-up-and-down", {}, Plan(plan).strain(up_and_down).table(MeasurementKind::amplitude_sweep));
    if (std::isfinite(gap)) {
        add("time-sweep-at-small-gap", {gap / 3},
            Plan(plan)
                .gap(std::vector<double>(rows, gap / 3))
                .time(logarithmic_steps(1e-3 * habits.duration, habits.duration, rows))
                .table(MeasurementKind::time_sweep));
        add("amplitude-sweep-at-small-gap", {0.25 * gap},
            Plan(sweep).gap(std::vector<double>(rows, 0.25 * gap)).table(MeasurementKind::amplitude_sweep));
    }
    if (experiment.instrument.geometry == Geometry::plate_plate) {
        Measurement cone = Plan(habits, unset, rows)
                               .strain(logarithmic_steps(habits.small_strain, habits.large_strain, rows))
                               .table(MeasurementKind::amplitude_sweep);
        cone.cone_angle = usual_cone;
        add("amplitude-sweep-under-cone", {}, cone);
    }
    const double half = 0.5 * experiment.instrument.plate_radius;
    if (experiment.instrument.geometry == Geometry::cone_plate) {
        Measurement rough = plan.table(MeasurementKind::frequency_sweep);
        rough.rough_plates = true;
        add("sweep-under-rough-cone", {}, rough);
        add("sweep-under-small-cone", {half}, plan.table(MeasurementKind::frequency_sweep)).experiment.instrument.plate_radius =
            half;
    }
    if (std::isfinite(gap)) {
        // A drift in time goes with the gap in one direction and against it in the other.
        const std::vector<double> ends = narrows(experiment) ? std::vector{gap / 3, 3 * gap} : std::vector{3 * gap, gap / 3};
        const Measurement plain =
            Plan(habits, gap, gaps).gap(logarithmic_steps(ends.front(), ends.back(), gaps)).table(MeasurementKind::gap_series);
        Measurement rough = plain;
        rough.rough_plates = true;
        Measurement oil = plain;
        oil.sample = "oil";
        oil.fluid_viscosity = 0.1 * habits.modulus / habits.angular_frequency;  // too soft to turn the tool
        add("gap-series", ends, plain);
        add("gap-series-with-rough-plates", ends, rough);
        add("gap-series-with-oil", ends, oil);
        add("gap-series-with-rough-plates-and-with-oil", ends, rough, oil);
        add("frequency-sweep-under-small-plate", {half},
            Plan(plan).frequency(frequencies(10)).table(MeasurementKind::frequency_sweep))
            .experiment.instrument.plate_radius = half;
    }
    for (Candidate& candidate : candidates) {
        candidate.observations = observations_of(candidate.experiment);
    }
    return candidates;
}

/// Flow curves over the shear rates so far.
std::vector<Candidate> flow_candidates(const Experiment& experiment, const std::vector<Observation>& observations) {
    double slowest = std::numeric_limits<double>::infinity();
    double fastest = 0;
    for (const Observation& one : observations) {
        if (const auto* viscosity = as<Viscosity>(one)) {
            slowest = std::min(slowest, viscosity->shear_rate);
            fastest = std::max(fastest, viscosity->shear_rate);
        }
    }
    const double duration = habits_of(observations).duration;
    Measurement upwards;
    upwards.kind = MeasurementKind::flow_curve;
    upwards.label = upwards.sample = "proposed";
    upwards.columns = {{"shear_rate", "1/s", logarithmic_steps(slowest, fastest, rows)},
                       {"viscosity", "Pa.s", std::vector<double>(rows, 1.0)},
                       {"time", "s", logarithmic_steps(duration / rows, duration, rows)}};
    Measurement downwards = upwards;
    std::reverse(downwards.columns.front().values.begin(), downwards.columns.front().values.end());

    std::vector<Candidate> candidates;
    const auto add = [&](const std::string& key, std::vector<double> lengths, const Measurement& measurement) -> Instrument& {
        candidates.push_back({key, std::move(lengths), unset, experiment, {}});
        candidates.back().experiment.measurements = {measurement};
        return candidates.back().experiment.instrument;
    };
    add("flow-curve-up", {}, upwards);
    add("flow-curve-down", {}, downwards);
    if (const double half = 0.5 * experiment.instrument.plate_radius; std::isfinite(half)) {
        add("flow-curve-with-small-tool", {half}, upwards).plate_radius = half;
    }
    if (const double third = experiment.instrument.gap / 3; std::isfinite(third)) {
        add("flow-curve-at-small-gap", {third}, upwards).gap = third;
    }
    for (Candidate& candidate : candidates) {
        candidate.observations = observations_of(candidate.experiment);
    }
    return candidates;
}

/// Two images of as many particles as were seen so far.
Candidate images_again(const Experiment& experiment, const Measurement& table) {
    Candidate candidate{"images-again", {}, unset, experiment, {}};
    Measurement images;
    images.kind = MeasurementKind::coordinates;
    images.label = images.sample = "proposed";
    candidate.experiment.measurements = {images};
    candidate.observations = planned_images(0, static_cast<double>(table.rows()));
    return candidate;
}

}  // namespace

std::vector<Candidate> candidates_for(const Experiment& experiment, const std::vector<Observation>& observations) {
    std::vector<Candidate> candidates;
    if (std::any_of(observations.begin(), observations.end(), is<Modulus>)) {
        candidates = shear_candidates(experiment, observations);
    }
    if (std::any_of(observations.begin(), observations.end(), is<Viscosity>)) {
        const std::vector<Candidate> flows = flow_candidates(experiment, observations);
        candidates.insert(candidates.end(), flows.begin(), flows.end());
    }
    const auto& tables = experiment.measurements;
    const auto image = std::find_if(tables.begin(), tables.end(),
                                    [](const Measurement& table) { return table.kind == MeasurementKind::coordinates; });
    if (image != tables.end() && std::none_of(observations.begin(), observations.end(), is<ImageDifference>)) {
        candidates.push_back(images_again(experiment, *image));
    }
    return candidates;
}

}  // namespace coagula::diagnose
