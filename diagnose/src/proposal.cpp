#include "proposal.hpp"

#include "weights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;

constexpr int draws_per_cause = 16;
constexpr int data_per_draw = 4;
constexpr double certain = 0.95;

/// A measurement that could be made.
struct Candidate {
    std::string what;
    Experiment experiment;
};

std::vector<double> logarithmic(double from, double to, int count) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) {
        values.push_back(from * std::pow(to / from, static_cast<double>(k) / (count - 1)));
    }
    return values;
}

/// A table of moduli with these axes; the moduli are filled in later.
Measurement table(MeasurementKind kind, const std::vector<double>& strain, const std::vector<double>& frequency,
                  const std::vector<double>& time, double gap, int run_order) {
    Measurement made;
    made.kind = kind;
    made.label = "proposed";
    made.sample = "proposed";
    made.run_order = run_order;
    const std::vector<double> ones(strain.size(), 1.0);
    made.columns = {{"strain", "1", strain},
                    {"angular_frequency", "rad/s", frequency},
                    {"time", "s", time},
                    {"storage_modulus", "Pa", ones},
                    {"loss_modulus", "Pa", ones}};
    if (std::isfinite(gap)) {
        made.columns.push_back({"gap", "m", std::vector<double>(strain.size(), gap)});
    }
    return made;
}

/// The same settings as in the experiment: its smallest strain, its typical frequency, its longest time.
struct Habits {
    double small_strain = 1e-4;
    double large_strain = 0.1;
    double angular_frequency = 2 * pi;
    double duration = 600;
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
    }
    habits.small_strain = smallest < 1e300 ? smallest : habits.small_strain;
    habits.large_strain = std::max(largest, 10 * habits.small_strain);
    habits.duration = std::max(longest, habits.duration);
    return habits;
}

std::vector<Candidate> candidates_for(const Experiment& experiment, const std::vector<Observation>& observations) {
    const Habits habits = habits_of(observations);
    const std::vector<double> same(20, habits.small_strain);
    const std::vector<double> frequency(20, habits.angular_frequency);
    std::vector<double> time(20);
    for (std::size_t k = 0; k < time.size(); ++k) {
        time[k] = habits.duration * static_cast<double>(k + 1) / 20;
    }
    const std::vector<double> up = logarithmic(habits.small_strain, habits.large_strain, 20);
    std::vector<double> up_and_down = logarithmic(habits.small_strain, habits.large_strain, 10);
    up_and_down.insert(up_and_down.end(), up_and_down.rbegin(), up_and_down.rend());
    const double gap = experiment.instrument.gap;

    std::vector<Candidate> candidates;
    const auto add = [&](const std::string& what, const Measurement& measurement, const auto& change) {
        Candidate candidate{what, experiment};
        candidate.experiment.measurements = {measurement};
        change(candidate.experiment.instrument);
        candidates.push_back(std::move(candidate));
    };
    const auto as_it_is = [](Instrument&) {};
    add("a run at constant small strain and frequency over the same time",
        table(MeasurementKind::time_sweep, same, frequency, time, gap, 0), as_it_is);
    add("a frequency sweep over four decades at the smallest strain",
        table(MeasurementKind::frequency_sweep, same,
              logarithmic(0.01 * habits.angular_frequency, 100 * habits.angular_frequency, 20), time, gap, 0),
        as_it_is);
    add("an amplitude sweep on a fresh sample", table(MeasurementKind::amplitude_sweep, up, frequency, time, gap, 0), as_it_is);
    add("an amplitude sweep up and down again", table(MeasurementKind::amplitude_sweep, up_and_down, frequency, time, gap, 0),
        as_it_is);
    if (std::isfinite(gap)) {
        for (const double factor : {0.5, 2.0}) {
            add(factor < 1 ? "the same at half the gap" : "the same at twice the gap",
                table(MeasurementKind::frequency_sweep, same,
                      logarithmic(0.1 * habits.angular_frequency, 10 * habits.angular_frequency, 20), time, factor * gap, 0),
                as_it_is);
        }
        add("the same with a plate of half the radius",
            table(MeasurementKind::frequency_sweep, same,
                  logarithmic(0.1 * habits.angular_frequency, 10 * habits.angular_frequency, 20), time, gap, 0),
            [](Instrument& instrument) { instrument.plate_radius *= 0.5; });
    }
    return candidates;
}

Settings settings_of(const Fit& fit, Index draw) {
    Settings settings = fit.settings;
    settings.normal_stiffness = fit.draws(0, draw);
    Index next = 1;
    for (const MechanismParameter& parameter : parameters_of(fit.hypothesis)) {
        settings.*parameter.value = fit.draws(next++, draw);
    }
    return settings;
}

/// Probability of each cause given data, each cause being a mixture of its predictions.
std::vector<double> judge(const Eigen::VectorXd& data, const std::vector<Eigen::MatrixXd>& predictions,
                          const std::vector<double>& weights, const Eigen::ArrayXd& deviation) {
    std::vector<double> logarithms;
    for (std::size_t cause = 0; cause < predictions.size(); ++cause) {
        Eigen::ArrayXd densities(predictions[cause].cols());
        for (Index draw = 0; draw < densities.size(); ++draw) {
            densities[draw] = -0.5 * ((data - predictions[cause].col(draw)).array() / deviation).square().sum();
        }
        const double largest = densities.maxCoeff();
        logarithms.push_back(largest + std::log((densities - largest).exp().mean()) + std::log(weights[cause]));
    }
    return probabilities_of(std::move(logarithms));
}

double entropy(const std::vector<double>& probabilities) {
    double sum = 0;
    for (const double p : probabilities) {
        sum -= p > 0 ? p * std::log2(p) : 0.0;
    }
    return sum;
}

Proposal evaluate(const Candidate& candidate, Simulator& simulator, const std::vector<Fit>& causes,
                  const std::vector<double>& weights, const DiagnosisOptions& options, std::uint64_t number) {
    const std::vector<Observation> observations = observations_of(candidate.experiment);
    const Forward forward(candidate.experiment, observations, simulator);
    std::vector<Eigen::MatrixXd> predictions;
    double level = 0;
    for (const Fit& fit : causes) {
        Eigen::MatrixXd all(static_cast<Index>(observations.size()), draws_per_cause);
        for (int draw = 0; draw < draws_per_cause; ++draw) {
            all.col(draw) = forward.predict(settings_of(fit, draw * fit.draws.cols() / draws_per_cause));
        }
        level = std::max(level, all.cwiseAbs().maxCoeff());
        predictions.push_back(std::move(all));
    }
    Eigen::ArrayXd deviation(static_cast<Index>(observations.size()));
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const bool loss = observations[k].loss;
        deviation[static_cast<Index>(k)] = std::max(
            (loss ? options.noise.loss_relative : options.noise.storage_relative) * level * (loss ? 0.1 : 1.0), 1e-12 * level);
    }
    Proposal proposal{.what = candidate.what};
    const double before = entropy(weights);
    int sample = 0;
    for (std::size_t cause = 0; cause < causes.size(); ++cause) {
        for (int draw = 0; draw < draws_per_cause * data_per_draw; ++draw) {
            Eigen::VectorXd data = predictions[cause].col(draw % draws_per_cause);
            for (Index k = 0; k < data.size(); ++k) {
                data[k] += deviation[k] * normal_number(options.seed, 2000000 + 1000 * number + static_cast<std::uint64_t>(sample),
                                                        static_cast<std::uint64_t>(k));
            }
            ++sample;
            const std::vector<double> after = judge(data, predictions, weights, deviation);
            const double share = weights[cause] / (draws_per_cause * data_per_draw);
            proposal.information += share * (before - entropy(after));
            proposal.resolution += *std::max_element(after.begin(), after.end()) > certain ? share : 0.0;
        }
    }
    return proposal;
}

}  // namespace

std::vector<Proposal> propose(const Experiment& experiment, Simulator& simulator, const std::vector<Fit>& causes,
                              const std::vector<double>& weights, const DiagnosisOptions& options) {
    std::vector<Proposal> proposals;
    if (causes.size() < 2) {
        return proposals;
    }
    std::vector<double> normalised = weights;
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : normalised) {
        weight /= sum;
    }
    std::uint64_t number = 0;
    for (const Candidate& candidate : candidates_for(experiment, observations_of(experiment))) {
        proposals.push_back(evaluate(candidate, simulator, causes, normalised, options, number++));
    }
    std::stable_sort(proposals.begin(), proposals.end(),
                     [](const auto& a, const auto& b) { return a.information > b.information; });
    return proposals;
}

}  // namespace coagula::diagnose
