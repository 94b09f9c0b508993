// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/diagnosis.hpp>

#include "attribution.hpp"
#include "departures.hpp"
#include "detection.hpp"
#include "gain.hpp"
#include "hypothesis.hpp"
#include "localise.hpp"
#include "proposal.hpp"
#include "verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

/// The causes that the experiment can show and that are asked for.
std::vector<const Mechanism*> possible_causes(const Experiment& experiment, const std::vector<std::string>& wanted) {
    require_causes(wanted);
    std::vector<const Mechanism*> possible;
    for (const Mechanism& mechanism : catalogue()) {
        if (is_asked_for(mechanism, wanted) && can_act(mechanism, experiment)) {
            possible.push_back(&mechanism);
        }
    }
    if (possible.empty()) {
        throw InputError(wanted.empty() ? "no cause of the catalogue can show in this experiment"
                                        : "none of the causes asked for can show in this experiment");
    }
    return possible;
}

std::vector<SampleEffect> effects_of(const ErrorModel& errors, const Prediction& prediction) {
    const Eigen::VectorXd values = errors.effects(prediction);
    std::vector<SampleEffect> effects;
    for (std::size_t k = 0; k < errors.data().sample_names.size(); ++k) {
        effects.push_back({errors.data().sample_names[k], values[static_cast<Index>(k)]});
    }
    return effects;
}

bool in_any(const std::vector<std::vector<bool>>& folds, std::size_t row) {
    return std::any_of(folds.begin(), folds.end(), [&](const std::vector<bool>& held) { return held[row]; });
}

/// Every row beside both models, and the effects of the samples.
void predict_rows(const DataSet& data, const Inference& inference, const Model& base, const Model& extended,
                  const std::vector<std::vector<bool>>& folds, Diagnosis& diagnosis) {
    const ErrorModel& errors = inference.errors();
    const Forward& forward = inference.forward();
    Prediction by_base = inference.prediction(base);
    Prediction by_extended = inference.prediction(extended);
    if (!forward.is_smooth()) {
        by_extended.values += forward.predict(extended, true) - forward.predict(extended);
    }
    const Eigen::VectorXd base_residual = errors.residual(by_base);
    const Eigen::VectorXd extended_residual = errors.residual(by_extended);
    const Eigen::VectorXd deviation = data.noise.marginal_deviation();
    diagnosis.base_effects = effects_of(errors, by_base);
    diagnosis.extended_effects = effects_of(errors, by_extended);
    const Eigen::VectorXd base_fitted = inference.as_fitted(by_base);
    const Eigen::VectorXd extended_fitted = inference.as_fitted(by_extended);
    by_base.values = inference.fitted(by_base);
    by_extended.values = inference.fitted(by_extended);
    for (std::size_t k = 0; k < data.observations.size(); ++k) {
        const Observation& observation = data.observations[k];
        const auto* neighbours = as<Neighbours>(observation);
        const auto i = static_cast<Index>(k);
        diagnosis.rows.push_back({observation.measurement, observation.row, std::string(observable_of(observation).key),
                                  observation.value, deviation[i], by_base.values[i], by_extended.values[i], base_fitted[i],
                                  extended_fitted[i], in_any(folds, k), base_residual[i], extended_residual[i],
                                  neighbours != nullptr ? neighbours->distance : unset});
    }
}

/// Predictions of the causes after the best one, also improbable ones: one sees where they miss the data.
void predict_others(const Inference& inference, Diagnosis& diagnosis) {
    constexpr std::size_t most = 4;
    for (const Cause& cause : diagnosis.causes) {
        const bool is_model = !cause.parameters.empty() && !cause.set.is_base() && cause.set != diagnosis.best;
        if (is_model && diagnosis.others.size() < most) {
            const Prediction prediction = inference.prediction(cause.model);
            const Eigen::VectorXd values = inference.fitted(prediction);
            const Eigen::VectorXd fitted = inference.as_fitted(prediction);
            diagnosis.others.push_back({cause.set, {values.begin(), values.end()}, {fitted.begin(), fitted.end()}});
        }
    }
}

void keep_statistics(const Detection& detection, Diagnosis& diagnosis) {
    for (const MisfitStatistic& one : detection.statistics) {
        const bool whole = one.coordinate == Coordinate::none;
        const std::string observable = one.tables.empty() ? one.observable : one.observable + " of " + one.tables;
        diagnosis.statistics.push_back({observable, name_of(one.coordinate),
                                        !one.cause.empty()    ? "towards " + one.cause
                                        : whole               ? "chi-square"
                                        : one.autocorrelation ? "neighbours"
                                                              : "smooth components",
                                        one.value, one.score});
    }
    diagnosis.bootstrap = detection.bootstrap;
}

const Fit& fit_of(const std::vector<Compared>& all, const CauseSet& set) {
    return std::find_if(all.begin(), all.end(), [&](const Compared& one) { return CauseSet(one.fit.hypothesis) == set; })->fit;
}

/// Proposes measurements that tell the causes of the credible set apart; no measurement is known that tells a single one from what
/// nobody knows.
std::vector<Proposal> proposals_for(const Diagnosis& diagnosis, const std::vector<Compared>& all, const Inference& inference,
                                    Simulator& simulator, std::uint64_t seed) {
    std::vector<Fit> candidates;
    std::vector<double> weights;
    for (const Cause& cause : diagnosis.causes) {
        const bool in_set =
            std::find(diagnosis.credible_set.begin(), diagnosis.credible_set.end(), cause.set) != diagnosis.credible_set.end();
        if (in_set && !cause.set.unknown) {
            candidates.push_back(fit_of(all, cause.set));
            weights.push_back(cause.posterior);
        }
    }
    return candidates.size() < 2 ? std::vector<Proposal>{} : propose(inference, simulator, candidates, weights, seed);
}

}  // namespace

const char* name_of(Verdict verdict) {
    constexpr std::array<const char*, 5> names{"no-discrepancy", "named", "tied", "kind-only", "none-of-catalogue"};
    return names.at(static_cast<std::size_t>(verdict));
}

const Cause* best_cause(const Diagnosis& diagnosis) {
    const auto best = std::find_if(diagnosis.causes.begin(), diagnosis.causes.end(),
                                   [&](const Cause& cause) { return cause.set == diagnosis.best && !cause.set.is_base(); });
    return best == diagnosis.causes.end() ? nullptr : &*best;
}

void check(const Experiment& experiment, const DiagnosisOptions& options) {
    possible_causes(experiment, options.causes);
    check_structure_series(experiment, data_set_of(experiment, options.errors).observations);
}

Diagnosis diagnose(const Experiment& experiment, Simulator& simulator, const DiagnosisOptions& options, const Progress& progress) {
    const std::vector<const Mechanism*> possible = possible_causes(experiment, options.causes);
    DataSet data = data_set_of(experiment, options.errors);
    const Forward forward(experiment, data.observations, simulator);
    data.noise.widen(forward.structure_deviation(data.values));
    set_correlations(correlations_by_base(forward, data), data);
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const std::vector<std::vector<bool>> folds = choose_folds(experiment, data.observations, options.held_out_part);

    Diagnosis diagnosis;
    diagnosis.sample_deviation = options.errors.sample;
    diagnosis.observations = data.observations.size();
    progress.update("fitting the base model", 0.1);
    const Fit base = inference.fit({});
    diagnosis.base = cause_of(base, inference);
    const Detection detection = detect(inference, base, possible, options.seed, options.bootstrap, progress);
    diagnosis.p_value = detection.p_value;
    diagnosis.detected = diagnosis.p_value <= options.level;
    keep_statistics(detection, diagnosis);
    if (!diagnosis.detected) {
        predict_rows(data, inference, base.model, base.model, folds, diagnosis);
        return diagnosis;
    }
    diagnosis.misfits = localise(inference, base, detection);

    const Comparison comparison = compare(base, possible, inference, options, Effort::whole, progress);
    progress.update("measuring the gain", 0.9);
    diagnosis.gain = measure_gain(data, folds, experiment, simulator, possible, options);
    judge(comparison, inference, possible, options, diagnosis);
    predict_rows(data, inference, base.model, best_cause(diagnosis)->model, folds, diagnosis);
    predict_others(inference, diagnosis);
    if (diagnosis.verdict == Verdict::tied || diagnosis.verdict == Verdict::kind_only) {
        diagnosis.proposals = proposals_for(diagnosis, comparison.all, inference, simulator, options.seed);
    }
    return diagnosis;
}

}  // namespace coagula::diagnose
