// SPDX-License-Identifier: GPL-3.0-or-later
#include "proposal.hpp"

#include <coagula/common/log_probability.hpp>
#include <coagula/diagnose/waveform.hpp>

#include "candidate_measurements.hpp"
#include "data/median.hpp"
#include "data/normal_number.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr int draws_per_cause = 16;
constexpr int data_per_draw = 4;
constexpr double certain = 0.95;
constexpr double least_error = 1e-6;  ///< of torque and phase, also where nothing tells one

/// What is known beforehand of the errors of a measurement: those of the data so far.
StatedNoise noise_of(const DataSet& data) {
    const Eigen::ArrayXd share = data.noise.deviation.array() / complex_moduli(data.observations, data.values);
    std::vector<double> relative;
    std::vector<double> phase;
    for (Index k = 0; k < data.size(); ++k) {
        const Observation& one = data.observations[static_cast<std::size_t>(k)];
        if (is_modulus_or_viscosity(one)) {
            (has_error_of_phase(one) ? phase : relative).push_back(share[k]);
        }
    }
    return {.relative = std::max(median(relative), least_error),
            .sample = std::max(data.effect, 0.0),
            .phase = std::max(median(phase), least_error)};
}

/// A cause as the data so far leave it.
struct Belief {
    std::vector<Model> draws;    ///< from its posterior
    Eigen::MatrixXd errors;      ///< of the model over their standard errors: those that each draw makes most probable, in columns
    Eigen::MatrixXd covariance;  ///< of these
};

Belief belief_in(const Fit& fit, const Inference& inference) {
    Belief belief;
    const Prediction best = inference.prediction(fit.model);
    const Index errors = best.errors.changes.cols();
    belief.covariance = inference.errors().effect_covariance(best).bottomRightCorner(errors, errors);
    belief.errors.resize(errors, draws_per_cause);
    belief.draws = fit.drawn(draws_per_cause);
    for (std::size_t draw = 0; draw < belief.draws.size(); ++draw) {
        belief.errors.col(static_cast<Index>(draw)) =
            inference.errors().effects(inference.prediction(belief.draws[draw])).tail(errors);
    }
    return belief;
}

/// Returns the data that would be measured where this is expected. Every table is that of a fresh sample.
DataSet planned_data(const Candidate& candidate, const Eigen::VectorXd& expected, const StatedNoise& noise) {
    Experiment experiment = candidate.experiment;
    put_values(candidate.observations, expected, experiment);
    ErrorSpec errors{.sample = noise.sample};
    for (const Measurement& table : experiment.measurements) {
        errors.tables.push_back(planned_errors(table, noise));
    }
    DataSet data = data_set_of(experiment, errors);
    data.sample_names.clear();
    for (const Measurement& table : experiment.measurements) {
        data.sample_names.push_back(table.sample);
    }
    for (Index k = 0; k < data.size(); ++k) {
        Index& sample = data.sample[static_cast<std::size_t>(k)];
        sample = sample < 0 ? sample : static_cast<Index>(data.observations[static_cast<std::size_t>(k)].measurement);
    }
    return data;
}

/// Covariance of what would be measured, beside errors of the model.
Eigen::MatrixXd covariance_of(const Candidate& candidate, const Eigen::VectorXd& expected, const StatedNoise& noise) {
    if (!is<ImageDifference>(candidate.observations.front()) && expected.allFinite()) {
        return ErrorModel(planned_data(candidate, expected, noise)).covariance(expected);
    }
    Eigen::VectorXd deviation(expected.size());
    for (Index k = 0; k < expected.size(); ++k) {
        const auto* images = as<ImageDifference>(candidate.observations[static_cast<std::size_t>(k)]);
        deviation[k] = images == nullptr ? unset : error_of(images->quantity, expected[k], images->centres);
    }
    return deviation.cwiseAbs2().asDiagonal();
}

/// What a cause expects of a measurement: normal errors about one of some predictions.
struct Expectation {
    Eigen::MatrixXd predictions;         ///< rows x draws
    Eigen::LLT<Eigen::MatrixXd> factor;  ///< of the covariance of the errors
    Eigen::MatrixXd white;               ///< predictions over it
};

/// Errors of the rows, of the level of each fresh sample, and of the model, which are the same as in the data so far.
Expectation expected_by(const Belief& belief, const Forward& forward, const Candidate& candidate, const StatedNoise& noise) {
    Expectation expectation;
    const auto rows = static_cast<Index>(candidate.observations.size());
    expectation.predictions.resize(rows, draws_per_cause);
    Eigen::MatrixXd changes =
        Eigen::MatrixXd::Zero(rows, belief.errors.rows());  // those of earlier images, which are last, change none
    for (int draw = 0; draw < draws_per_cause; ++draw) {
        const Model& model = belief.draws[static_cast<std::size_t>(draw)];
        const Index known = forward.errors_of(model);
        const Prediction drawn = forward.prediction(model, belief.errors.col(draw).head(known));
        expectation.predictions.col(draw) = drawn.values;
        changes.leftCols(known) += drawn.errors.changes / draws_per_cause;
    }
    const Eigen::VectorXd mean = expectation.predictions.rowwise().mean();
    Eigen::MatrixXd covariance = changes * belief.covariance * changes.transpose();
    covariance += covariance_of(candidate, mean, noise);
    expectation.factor.compute(covariance);
    expectation.white = expectation.factor.matrixL().solve(expectation.predictions);
    return expectation;
}

/// Probability of each cause given data, each cause being a mixture of its predictions.
std::vector<double> judge(const Eigen::VectorXd& data, const std::vector<Expectation>& causes, const std::vector<double>& weights) {
    std::vector<double> logarithms;
    for (std::size_t cause = 0; cause < causes.size(); ++cause) {
        const Expectation& expectation = causes[cause];
        const Eigen::VectorXd white = expectation.factor.matrixL().solve(data);
        std::vector<double> densities;
        for (const auto& prediction : expectation.white.colwise()) {
            densities.push_back(-0.5 * (white - prediction).squaredNorm());
        }
        const double log_determinant = expectation.factor.matrixLLT().diagonal().array().log().sum();
        logarithms.push_back(log_sum(densities) - log_determinant + std::log(weights[cause]));
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

Proposal evaluate(const Candidate& candidate, Simulator& simulator, const std::vector<Belief>& beliefs,
                  const std::vector<double>& weights, const StatedNoise& noise, std::uint64_t seed, std::uint64_t number) {
    const std::vector<Observation>& observations = candidate.observations;
    const Forward forward(candidate.experiment, observations, simulator);
    std::vector<Expectation> causes;
    for (const Belief& belief : beliefs) {
        causes.push_back(expected_by(belief, forward, candidate, noise));
    }
    Proposal proposal{candidate.measurement, candidate.lengths, candidate.rest};
    const double before = entropy(weights);
    std::uint64_t step = 2000000 + 1000 * number;
    for (std::size_t cause = 0; cause < causes.size(); ++cause) {
        for (int draw = 0; draw < draws_per_cause * data_per_draw; ++draw) {
            Eigen::VectorXd normal(static_cast<Index>(observations.size()));
            for (Index row = 0; row < normal.size(); ++row) {
                normal[row] = normal_number(seed, step, static_cast<std::uint64_t>(row));
            }
            ++step;
            const Expectation& truth = causes[cause];
            const Eigen::VectorXd data = truth.predictions.col(draw % draws_per_cause) + truth.factor.matrixL() * normal;
            const std::vector<double> after = judge(data, causes, weights);
            const double share = weights[cause] / (draws_per_cause * data_per_draw);
            proposal.information += share * (before - entropy(after));
            proposal.resolution += *std::max_element(after.begin(), after.end()) > certain ? share : 0.0;
        }
    }
    proposal.information = std::max(0.0, proposal.information);  // of few draws
    proposal.resolution = std::min(1.0, proposal.resolution);    // of rounding
    return proposal;
}

}  // namespace

std::vector<Proposal> propose(const Inference& inference, Simulator& simulator, const std::vector<Fit>& causes,
                              const std::vector<double>& weights, std::uint64_t seed) {
    std::vector<Proposal> proposals;
    if (causes.size() < 2 || inference.forward().is_smooth()) {  // of a smooth material nobody knows what else it would show
        return proposals;
    }
    std::vector<double> normalised = weights;
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : normalised) {
        weight /= sum;
    }
    std::vector<Belief> beliefs;
    for (const Fit& fit : causes) {
        beliefs.push_back(belief_in(fit, inference));
    }
    const DataSet& data = inference.errors().data();
    const StatedNoise noise = noise_of(data);
    std::uint64_t number = 0;
    for (const Candidate& candidate : candidates_for(inference.forward().experiment(), data.observations)) {
        proposals.push_back(evaluate(candidate, simulator, beliefs, normalised, noise, seed, number++));
    }
    std::stable_sort(proposals.begin(), proposals.end(),
                     [](const auto& a, const auto& b) { return a.information > b.information; });
    return proposals;
}

}  // namespace coagula::diagnose
