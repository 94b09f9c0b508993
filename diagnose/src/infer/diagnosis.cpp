// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/log_probability.hpp>
#include <coagula/diagnose/diagnosis.hpp>

#include "attribution.hpp"
#include "departures.hpp"
#include "detection.hpp"
#include "gain.hpp"
#include "hypothesis.hpp"
#include "localise.hpp"
#include "proposal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double certain = 0.95;
constexpr double decisive = 3;  ///< logarithm of a Bayes factor of 20
constexpr const char* none_name = "none of the catalogue";

Cause cause_of(const Fit& fit, const Inference& inference) {
    Cause cause{.name = name_of(fit.hypothesis), .log_evidence = fit.log_evidence, .model = fit.model, .draws = fit.draws};
    const auto add = [&](const std::string& name, const std::string& unit, const Posterior& posterior, bool at_end = false) {
        cause.parameters.push_back({name, unit, posterior.value, posterior.low, posterior.high, at_end});
    };
    const bool newtonian = inference.forward().experiment().material.kind == MaterialKind::newtonian;
    if (inference.shows_scale()) {
        add(newtonian ? "viscosity" : "normal_stiffness", newtonian ? "Pa.s" : "N/m", fit.stiffness);
    } else {
        cause.draws = fit.draws.bottomRows(std::max<Index>(0, fit.draws.rows() - 1)).eval();
    }
    std::size_t next = 0;
    for (const Mechanism* mechanism : fit.hypothesis) {
        cause.words += (cause.words.empty() ? "" : "; ") + mechanism->term;
        for (const MechanismParameter& parameter : mechanism->parameters) {
            add(parameter.name, parameter.unit, fit.parameters[next], fit.active_end[next]);
            ++next;
        }
    }
    return cause;
}

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
        const auto i = static_cast<Index>(k);
        diagnosis.rows.push_back({observation.measurement, observation.row, observable_of(observation), observation.value,
                                  deviation[i], by_base.values[i], by_extended.values[i], base_fitted[i], extended_fitted[i],
                                  in_any(folds, k), base_residual[i], extended_residual[i], observation.distance});
    }
}

/// Predictions of the causes after the best one, also improbable ones: one sees where they miss the data.
void predict_others(const Inference& inference, const std::string& best, Diagnosis& diagnosis) {
    constexpr std::size_t most = 4;
    for (const Cause& cause : diagnosis.causes) {
        const bool is_model = !cause.parameters.empty() && cause.name != diagnosis.base.name && cause.name != best;
        if (is_model && diagnosis.others.size() < most) {
            const Prediction prediction = inference.prediction(cause.model);
            const Eigen::VectorXd values = inference.fitted(prediction);
            const Eigen::VectorXd fitted = inference.as_fitted(prediction);
            diagnosis.others.push_back({cause.name, {values.begin(), values.end()}, {fitted.begin(), fitted.end()}});
        }
    }
}

void keep_statistics(const Detection& detection, Diagnosis& diagnosis) {
    for (const MisfitStatistic& one : detection.statistics) {
        const bool whole = one.coordinate == Coordinate::none;
        diagnosis.statistics.push_back({one.observable, name_of(one.coordinate),
                                        !one.cause.empty()    ? "towards " + one.cause
                                        : whole               ? "chi-square"
                                        : one.autocorrelation ? "neighbours"
                                                              : "smooth components",
                                        one.value, one.score});
    }
    diagnosis.bootstrap = detection.bootstrap;
}

/// Whether a pair "a + b" has this member.
bool contains(const std::string& pair, const std::string& member) {
    const std::string joint = " + ";
    return pair.starts_with(member + joint) || pair.ends_with(joint + member);
}

/// The fewest causes with 95 % of the posterior. A pair of which one member explains the data alone, and better, adds no cause, nor
/// does one that leaves as much over.
std::vector<std::string> credible_set(const std::vector<Cause>& causes) {
    std::vector<std::string> set;
    double sum = 0;
    for (auto cause = causes.begin(); cause != causes.end() && sum < certain; ++cause) {
        const bool adds = std::none_of(causes.begin(), cause, [&](const Cause& better) {
            return (!better.leaves_remainder || cause->leaves_remainder) && contains(cause->name, better.name);
        });
        if (adds) {
            set.push_back(cause->name);
        }
        sum += cause->posterior;
    }
    return set;
}

/// Causes that every member of the set is or has.
std::vector<std::string> common_causes(const std::vector<std::string>& set, const std::vector<const Mechanism*>& possible) {
    std::vector<std::string> common;
    for (const Mechanism* one : possible) {
        const bool in_all = !set.empty() && std::all_of(set.begin(), set.end(), [&](const std::string& name) {
            return name == one->name || contains(name, one->name);
        });
        if (in_all) {
            common.push_back(one->name);
        }
    }
    return common;
}

/// Whether the best cause with a smooth departure on top leaves more than half of what the base model leaves.
bool leaves_most(const Comparison& comparison, const Inference& inference) {
    const ErrorModel& errors = inference.errors();
    const auto misfit = [&](const Fit& fit, const SmoothRemainder* on_top) {
        Prediction prediction = inference.prediction(fit.model);
        if (on_top != nullptr) {
            prediction.values += on_top->departure;
        }
        const Eigen::VectorXd left = errors.residual(prediction);
        return left.squaredNorm() - static_cast<double>(left.size());
    };
    const Compared& winner = comparison.all[comparison.winner];
    const double left = winner.remainder ? misfit(winner.remainder->fit, &*winner.remainder) : misfit(winner.fit, nullptr);
    const double chance = 3 * std::sqrt(2 * static_cast<double>(errors.data().values.size()));
    return left > 0.5 * misfit(comparison.all.front().fit, nullptr) + chance;
}

/// Weight of "none of the catalogue": a smooth departure from the base model. A departure of the level alone has many causes, in
/// the structure and in what is taken for known, and a value at the end of its range belongs to a cause that the catalogue does not
/// have, as does most of the misfit where it is left: there it counts as much as the best cause.
double log_weight_of_none(const Comparison& comparison, const Priors& priors, bool level_alone, bool most_is_left) {
    const Compared& winner = comparison.all[comparison.winner];
    const auto& ends = winner.fit.active_end;
    const bool at_end = std::find(ends.begin(), ends.end(), true) != ends.end();
    const double smooth = comparison.all.front().log_weight_with_remainder(priors);
    return level_alone || at_end || most_is_left ? std::max(smooth, winner.log_total(priors)) : smooth;
}

/// Whether the base model with a stiffness that nobody knows explains as much as the best cause with the known one.
bool is_level_alone(const Inference& inference, const Fit& winner) {
    return std::isfinite(inference.stiffness_error()) &&
           inference.density_of_free_level() > inference.errors().log_density(inference.prediction(winner.model)) - decisive;
}

void rank_causes(const Comparison& comparison, const Inference& inference, const Priors& priors, Diagnosis& diagnosis) {
    const Compared& base = comparison.all.front();
    std::vector<double> logarithms;
    for (const Compared& one : comparison.all) {
        logarithms.push_back(&one == &base ? one.log_weight() : one.log_total(priors));
    }
    logarithms.push_back(log_weight_of_none(comparison, priors, diagnosis.level_alone, diagnosis.remainder.most));
    const std::vector<double> posterior = probabilities_of(std::move(logarithms));
    for (std::size_t k = 0; k < comparison.all.size(); ++k) {
        const Compared& one = comparison.all[k];
        const bool leaves_remainder = one.log_weight_with_remainder(priors) > one.log_weight();
        diagnosis.causes.push_back(cause_of(leaves_remainder ? one.remainder->fit : one.fit, inference));
        diagnosis.causes.back().posterior = posterior[k];
        diagnosis.causes.back().leaves_remainder = leaves_remainder;
    }
    diagnosis.causes.push_back({.name = none_name,
                                .words = "a smooth deviation that no cause of the catalogue produces",
                                .posterior = posterior.back(),
                                .log_evidence = base.fit.log_evidence + base.remainder->log_factor});
    std::stable_sort(diagnosis.causes.begin(), diagnosis.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.posterior > b.posterior; });
    diagnosis.credible_set = credible_set(diagnosis.causes);
}

const Fit& fit_named(const std::vector<Compared>& all, const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const Compared& one) { return name_of(one.fit.hypothesis) == name; })->fit;
}

/// What to measure next, to tell the causes of the credible set apart.
std::vector<Proposal> proposals_for(const Diagnosis& diagnosis, const std::vector<Compared>& all, const Inference& inference,
                                    Simulator& simulator, std::uint64_t seed) {
    std::vector<Fit> candidates;
    std::vector<double> weights;
    for (const Cause& cause : diagnosis.causes) {
        const bool in_set =
            std::find(diagnosis.credible_set.begin(), diagnosis.credible_set.end(), cause.name) != diagnosis.credible_set.end();
        if (in_set && cause.name != none_name && cause.name != "base") {
            candidates.push_back(fit_named(all, cause.name));
            weights.push_back(cause.posterior);
        }
    }
    return propose(inference, simulator, candidates, weights, seed);
}

/// A cause that leaves something over is one if the remainder alone, without it, explains the data far worse.
Verdict verdict_of(const Comparison& comparison, const Priors& priors, double level, const Diagnosis& diagnosis) {
    const Compared& base = comparison.all.front();
    const Compared& winner = comparison.all[comparison.winner];
    const bool helps = winner.log_weight_with_remainder(priors) - base.log_weight_with_remainder(priors) > decisive;
    if (diagnosis.causes.front().name == none_name || (comparison.p_value <= level && !helps)) {
        return Verdict::none_of_catalogue;
    }
    return diagnosis.credible_set.size() == 1 ? Verdict::named : Verdict::tied;
}

}  // namespace

const char* name_of(Verdict verdict) {
    constexpr std::array<const char*, 4> names{"no-discrepancy", "named", "tied", "none-of-catalogue"};
    return names.at(static_cast<std::size_t>(verdict));
}

void check(const Experiment& experiment, const DiagnosisOptions& options) {
    possible_causes(experiment, options.causes);
    check_structure_series(experiment, data_set_of(experiment, options.noise).observations);
}

Diagnosis diagnose(const Experiment& experiment, Simulator& simulator, const DiagnosisOptions& options, const Progress& progress) {
    const std::vector<const Mechanism*> possible = possible_causes(experiment, options.causes);
    DataSet data = data_set_of(experiment, options.noise);
    const Forward forward(experiment, data.observations, simulator);
    data.noise.widen(forward.structure_deviation(data.values));
    set_correlations(correlations_by_base(forward, data), data);
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const std::vector<std::vector<bool>> folds = choose_folds(experiment, data.observations, options.held_out_part);

    Diagnosis diagnosis;
    diagnosis.noise = options.noise;
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
    diagnosis.failures = localise(inference, base, detection);

    const Priors priors = priors_of(options, possible.size());
    const Comparison comparison = compare(base, possible, inference, options, Effort::whole, progress);
    const Compared& winner = comparison.all[comparison.winner];
    diagnosis.extended_p_value = comparison.p_value;
    diagnosis.level_alone = is_level_alone(inference, winner.fit);
    diagnosis.remainder.p_value = comparison.p_value;
    diagnosis.remainder.detected = comparison.p_value <= options.level;
    diagnosis.remainder.most = diagnosis.remainder.detected && leaves_most(comparison, inference);
    rank_causes(comparison, inference, priors, diagnosis);
    diagnosis.certain = common_causes(diagnosis.credible_set, possible);
    diagnosis.verdict = verdict_of(comparison, priors, options.level, diagnosis);
    if (diagnosis.remainder.detected) {
        diagnosis.remainder.where =
            place_of(*winner.remainder, data, inference.fitted(inference.prediction(winner.remainder->fit.model)));
    }
    progress.update("measuring the gain", 0.9);
    diagnosis.gain = measure_gain(data, folds, experiment, simulator, possible, options);
    predict_rows(data, inference, base.model, winner.fit.model, folds, diagnosis);
    predict_others(inference, name_of(winner.fit.hypothesis), diagnosis);
    if (diagnosis.verdict == Verdict::tied) {
        diagnosis.proposals = proposals_for(diagnosis, comparison.all, inference, simulator, options.seed);
    }
    return diagnosis;
}

}  // namespace coagula::diagnose
