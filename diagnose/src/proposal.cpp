#include "proposal.hpp"

#include "candidate_measurements.hpp"
#include "weights.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr int draws_per_cause = 16;
constexpr int data_per_draw = 4;
constexpr double certain = 0.95;

Settings settings_of(const Fit& fit, Index draw) {
    Settings settings = fit.settings;
    settings.normal_stiffness = fit.draws(0, draw);
    Index next = 1;
    for (const MechanismParameter& parameter : parameters_of(fit.hypothesis)) {
        settings.*parameter.value = fit.draws(next++, draw);
    }
    return settings;
}

/// What is known beforehand of the errors of a measurement: those of the data so far.
struct ExpectedErrors {
    double relative = 0;  ///< of a modulus
    double phase = 0;     ///< of G'' over |G*| [rad]
    double sample = 0;    ///< of the level of a fresh sample
};

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

ExpectedErrors errors_of(const DataSet& data) {
    const Eigen::ArrayXd share = data.noise.deviation.array() / complex_moduli(data.observations, data.values);
    std::vector<double> relative;
    std::vector<double> phase;
    for (Index k = 0; k < data.size(); ++k) {
        const Observation& one = data.observations[static_cast<std::size_t>(k)];
        if (!one.third_harmonic) {
            (one.loss ? phase : relative).push_back(share[k]);
        }
    }
    return {median(relative), median(phase), data.effect};
}

/// Standard deviations of the rows of a measurement of these moduli.
Eigen::ArrayXd deviations(const std::vector<Observation>& observations, const Eigen::VectorXd& moduli,
                          const ExpectedErrors& errors) {
    const Eigen::ArrayXd sizes = complex_moduli(observations, moduli);
    Eigen::ArrayXd deviation(moduli.size());
    for (Index k = 0; k < moduli.size(); ++k) {
        const Observation& one = observations[static_cast<std::size_t>(k)];
        if (one.third_harmonic) {
            deviation[k] = one.standard_error;
            continue;
        }
        const double turned = one.loss ? errors.phase * sizes[k] : 0.0;
        deviation[k] = std::max(std::hypot(errors.relative * moduli[k], turned), 1e-6 * sizes[k]);
    }
    return deviation;
}

/// A measurement that is judged beforehand.
struct Planned {
    std::vector<std::size_t> table;  ///< of each row; each table has a sample of its own
    Eigen::ArrayXd deviation;        ///< of each row
    double effect;                   ///< standard deviation of that of a sample
    Eigen::ArrayXd level;            ///< 1 where it changes the row, 0 for third harmonics
};

/// Logarithm of the density of data, the effects of the samples integrated out (Woodbury's identity).
double log_density(const Eigen::VectorXd& data, const Eigen::VectorXd& prediction, const Planned& planned) {
    const Eigen::ArrayXd plain = (data - prediction).array() / planned.deviation;
    const Eigen::ArrayXd direction = planned.level * prediction.array() / planned.deviation;
    const double variance = planned.effect * planned.effect;
    std::vector<double> squares(planned.table.back() + 1, 0);
    std::vector<double> products(squares.size(), 0);
    for (Index row = 0; row < data.size(); ++row) {
        const std::size_t table = planned.table[static_cast<std::size_t>(row)];
        squares[table] += direction[row] * direction[row];
        products[table] += direction[row] * plain[row];
    }
    double sum = plain.square().sum();
    for (std::size_t table = 0; table < squares.size(); ++table) {
        const double normal = 1 + variance * squares[table];
        sum += std::log(normal) - variance * products[table] * products[table] / normal;
    }
    return -0.5 * sum;
}

/// Probability of each cause given data, each cause being a mixture of its predictions.
std::vector<double> judge(const Eigen::VectorXd& data, const std::vector<Eigen::MatrixXd>& predictions,
                          const std::vector<double>& weights, const Planned& planned) {
    std::vector<double> logarithms;
    for (std::size_t cause = 0; cause < predictions.size(); ++cause) {
        std::vector<double> densities;
        for (const auto& prediction : predictions[cause].colwise()) {
            densities.push_back(log_density(data, prediction, planned));
        }
        logarithms.push_back(log_sum(densities) + std::log(weights[cause]));
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

/// What each cause predicts for a measurement: rows x draws from its posterior.
std::vector<Eigen::MatrixXd> predictions_by(const std::vector<Fit>& causes, const Forward& forward, std::size_t rows) {
    std::vector<Eigen::MatrixXd> predictions;
    for (const Fit& fit : causes) {
        Eigen::MatrixXd all(static_cast<Index>(rows), draws_per_cause);
        for (int draw = 0; draw < draws_per_cause; ++draw) {
            all.col(draw) = forward.predict(settings_of(fit, draw * fit.draws.cols() / draws_per_cause));
        }
        predictions.push_back(std::move(all));
    }
    return predictions;
}

Proposal evaluate(const Candidate& candidate, Simulator& simulator, const std::vector<Fit>& causes,
                  const std::vector<double>& weights, const ExpectedErrors& errors, std::uint64_t seed, std::uint64_t number) {
    const std::vector<Observation> observations = observations_of(candidate.experiment);
    const Forward forward(candidate.experiment, observations, simulator);
    const std::vector<Eigen::MatrixXd> predictions = predictions_by(causes, forward, observations.size());
    Planned planned{{}, deviations(observations, predictions.front().rowwise().mean(), errors), errors.sample, {}};
    planned.level.setOnes(planned.deviation.size());
    for (const Observation& one : observations) {
        planned.level[static_cast<Index>(planned.table.size())] = one.third_harmonic ? 0.0 : 1.0;
        planned.table.push_back(one.measurement);
    }
    Proposal proposal{.what = candidate.what};
    const double before = entropy(weights);
    std::uint64_t step = 2000000 + 1000 * number;
    for (std::size_t cause = 0; cause < causes.size(); ++cause) {
        for (int draw = 0; draw < draws_per_cause * data_per_draw; ++draw) {
            std::uint64_t place = 0;
            const auto normal = [&] { return normal_number(seed, step, place++); };
            std::vector<double> level(planned.table.back() + 1);
            std::generate(level.begin(), level.end(), [&] { return planned.effect * normal(); });
            Eigen::VectorXd data = predictions[cause].col(draw % draws_per_cause);
            for (Index k = 0; k < data.size(); ++k) {
                const double effect = planned.level[k] * level[planned.table[static_cast<std::size_t>(k)]];
                data[k] = (1 + effect) * data[k] + planned.deviation[k] * normal();
            }
            ++step;
            const std::vector<double> after = judge(data, predictions, weights, planned);
            const double share = weights[cause] / (draws_per_cause * data_per_draw);
            proposal.information += share * (before - entropy(after));
            proposal.resolution += *std::max_element(after.begin(), after.end()) > certain ? share : 0.0;
        }
    }
    return proposal;
}

}  // namespace

std::vector<Proposal> propose(const Experiment& experiment, const DataSet& data, Simulator& simulator,
                              const std::vector<Fit>& causes, const std::vector<double>& weights, std::uint64_t seed) {
    std::vector<Proposal> proposals;
    if (causes.size() < 2) {
        return proposals;
    }
    std::vector<double> normalised = weights;
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : normalised) {
        weight /= sum;
    }
    const ExpectedErrors errors = errors_of(data);
    std::uint64_t number = 0;
    for (const Candidate& candidate : candidates_for(experiment, data.observations)) {
        proposals.push_back(evaluate(candidate, simulator, causes, normalised, errors, seed, number++));
    }
    std::stable_sort(proposals.begin(), proposals.end(),
                     [](const auto& a, const auto& b) { return a.information > b.information; });
    return proposals;
}

}  // namespace coagula::diagnose
