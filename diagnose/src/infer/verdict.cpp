// SPDX-License-Identifier: GPL-3.0-or-later
#include "verdict.hpp"

#include "departures.hpp"
#include "free_forms.hpp"
#include "kinds.hpp"
#include "localise.hpp"

#include <coagula/common/log_probability.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double credible = 0.95;      ///< probability of the set of causes
constexpr double decisive = 3;         ///< logarithm of a Bayes factor of 20
constexpr double favoured = 2;         ///< logarithm of a Bayes factor of 7
constexpr double about_as_well = 0.9;  ///< of errors on held-out rows
constexpr double a_row_less = 6;       ///< logarithms of the likelihood that all rows but the strongest have to give
constexpr double small_share = 0.1;    ///< of the base model's misfit that a named cause may leave
constexpr double widest = 0.75;        ///< 90 % interval of a parameter over that of its prior
constexpr Kind softening_or_stiffening{Link::material, Axis::strain};

bool holds(const std::vector<Condition>& conditions, const char* name) {
    return std::any_of(conditions.begin(), conditions.end(), [&](const Condition& one) { return one.name == name && one.holds; });
}

bool all_hold(const std::vector<Condition>& conditions) {
    return std::all_of(conditions.begin(), conditions.end(), [](const Condition& one) { return one.holds; });
}

/// Whether the best cause explains the data, whatever else is missing to its name.
bool fits(const std::vector<Condition>& conditions) {
    return holds(conditions, "beats-free-forms") && holds(conditions, "inside-range") && holds(conditions, "little-left");
}

/// The fewest causes with 95 % of the posterior; the base model, which fails, is none. A pair of which one member explains the data
/// alone, and better, adds no cause, nor does one that leaves as much over.
std::vector<CauseSet> credible_set(const std::vector<Cause>& causes) {
    std::vector<CauseSet> set;
    double sum = 0;
    for (auto cause = causes.begin(); cause != causes.end() && sum < credible; ++cause) {
        const bool adds = !cause->set.is_base() && std::none_of(causes.begin(), cause, [&](const Cause& better) {
            return (!better.leaves_remainder || cause->leaves_remainder) && cause->set.has_more_than(better.set);
        });
        if (adds) {
            set.push_back(cause->set);
        }
        sum += cause->posterior;
    }
    return set;
}

/// Causes that every member of the set is or has.
CauseSet common_causes(const std::vector<CauseSet>& set, const Hypothesis& possible) {
    CauseSet common = set.empty() ? CauseSet() : CauseSet(possible);
    std::erase_if(common.members, [&](std::size_t member) {
        return std::any_of(set.begin(), set.end(), [&](const CauseSet& one) { return !one.contains(member); });
    });
    return common;
}

/// Chi-square beyond its expectation, of a fit with a departure on top.
double misfit(const Inference& inference, const Fit& fit, const Discrepancy* on_top) {
    Prediction prediction = inference.prediction(fit.model);
    if (on_top != nullptr) {
        prediction.values += on_top->departure;
    }
    const Eigen::VectorXd left = inference.errors().residual(prediction);
    return left.squaredNorm() - static_cast<double>(left.size());
}

/// Whether the best cause with a smooth departure on top leaves more than half of what the base model leaves.
bool leaves_most(const Comparison& comparison, const Inference& inference) {
    const Compared& winner = comparison.all[comparison.winner];
    const double left = winner.discrepancy ? misfit(inference, winner.discrepancy->fit, &*winner.discrepancy)
                                           : misfit(inference, winner.fit, nullptr);
    const double chance = 3 * std::sqrt(2 * static_cast<double>(inference.errors().size()));
    return left > 0.5 * misfit(inference, comparison.all.front().fit, nullptr) + chance;
}

/// Share of the base model's misfit that a cause alone leaves over.
double share_left(const Comparison& comparison, const Inference& inference) {
    const double base = misfit(inference, comparison.all.front().fit, nullptr);
    const double left = misfit(inference, comparison.all[comparison.winner].fit, nullptr);
    return base > 0 ? std::clamp(left / base, 0.0, 1.0) : 1.0;
}

/// Whether a cause adds to a discrepancy that explains the data without it.
bool adds_to_discrepancy(const Compared& one, const Comparison& comparison, const Priors& priors) {
    constexpr double noticeable = 1;  // logarithms
    const double none = comparison.all.front().log_weight_with_discrepancy(priors) - priors.none;
    return one.log_weight_with_discrepancy(priors) - priors.beside > none + noticeable;
}

/// Weight of a cause, alone and with a discrepancy to which it adds.
double log_weight_of(const Compared& one, const Comparison& comparison, const Priors& priors) {
    return adds_to_discrepancy(one, comparison, priors) ? one.log_total(priors) : one.log_weight();
}

/// Weight of "none of the catalogue": a smooth departure from the base model, or the free form of a link. Where the best cause
/// does not fit, or where the level of the moduli alone departs, which many causes in the structure and in what is taken for known
/// change, it counts as much as that cause; where something else is missing to a name, a quarter.
double log_weight_of_none(const Comparison& comparison, const Priors& priors, const Diagnosis& diagnosis) {
    const double best = log_weight_of(comparison.all[comparison.winner], comparison, priors);
    const double smooth = comparison.log_weight_of_none(priors);
    if (diagnosis.level_alone || !fits(diagnosis.conditions)) {
        return std::max(smooth, best);
    }
    return all_hold(diagnosis.conditions) ? smooth : std::max(smooth, best - std::log(4.0));
}

void rank_causes(const Comparison& comparison, const Inference& inference, const Priors& priors, Diagnosis& diagnosis) {
    const Compared& base = comparison.all.front();
    std::vector<double> logarithms;
    for (const Compared& one : comparison.all) {
        logarithms.push_back(&one == &base ? one.log_weight() : log_weight_of(one, comparison, priors));
    }
    logarithms.push_back(log_weight_of_none(comparison, priors, diagnosis));
    const std::vector<double> posterior = probabilities_of(std::move(logarithms));
    for (std::size_t k = 0; k < comparison.all.size(); ++k) {
        const Compared& one = comparison.all[k];
        const bool leaves_remainder =
            adds_to_discrepancy(one, comparison, priors) && one.log_weight_with_discrepancy(priors) > one.log_weight();
        diagnosis.causes.push_back(cause_of(leaves_remainder ? one.discrepancy->fit : one.fit, inference));
        diagnosis.causes.back().posterior = posterior[k];
        diagnosis.causes.back().leaves_remainder = leaves_remainder;
    }
    diagnosis.causes.push_back({.set = CauseSet::none_of_catalogue(),
                                .words = "a smooth deviation that no cause of the catalogue produces",
                                .posterior = posterior.back(),
                                .log_evidence = comparison.log_weight_of_none(priors) - priors.none});
    std::stable_sort(diagnosis.causes.begin(), diagnosis.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.posterior > b.posterior; });
    diagnosis.credible_set = credible_set(diagnosis.causes);
}

/// Evidence of a pair over that of its better member alone; over nothing, without limit, of a single cause.
double over_one_member(const Compared& pair, const std::vector<Compared>& all) {
    double best = -std::numeric_limits<double>::infinity();
    for (const Mechanism* one : pair.fit.hypothesis) {
        best = pair.fit.hypothesis.size() > 1 ? std::max(best, weight_alone(one, all)) : best;
    }
    return pair.log_weight() - best;
}

/// 90 % interval over that of the prior, of the parameter that is known best; of the cause of a pair where that is widest.
double widest_interval(const Fit& fit) {
    double widest_cause = 0;
    std::size_t next = 0;
    for (const Mechanism* mechanism : fit.hypothesis) {
        double narrowest = std::numeric_limits<double>::infinity();
        for (const MechanismParameter& parameter : mechanism->parameters) {
            const Estimate& found = fit.parameters[next++];
            narrowest = std::min(narrowest, (parameter.place_of(found.high) - parameter.place_of(found.low)) / 0.9);
        }
        widest_cause = std::max(widest_cause, narrowest);
    }
    return widest_cause;
}

/// Half of what the winner takes off chi-square, that of the samples' effects and of the errors of the prediction included, without
/// the row that speaks most for it.
double gained_without_a_row(const Comparison& comparison, const Inference& inference) {
    const auto squares = [&](const Compared& one) -> Eigen::ArrayXd {
        return departures_of(inference, one.fit).residual.array().square();
    };
    const Eigen::ArrayXd base = squares(comparison.all.front());
    const Eigen::ArrayXd winner = squares(comparison.all[comparison.winner]);
    const std::vector<Observation>& observations = inference.errors().data().observations;
    std::map<std::pair<std::size_t, std::size_t>, double> rows;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        rows[{observations[k].measurement, observations[k].row}] += base[static_cast<Index>(k)] - winner[static_cast<Index>(k)];
    }
    const auto most = std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return 0.5 * (base.sum() - winner.sum() - most->second);
}

/// Largest factor on the evidence of the base model by the free form of a kind along another axis, as a logarithm.
double best_along_other_axes(const std::vector<FreeForm>& forms, Axis own) {
    double best = 0;
    for (const FreeForm& form : forms) {
        best = form.kind.axis == own ? best : std::max(best, form.log_factor);
    }
    return best;
}

/// The free form of a softer or stiffer material explains so many logarithms more than an instrument that reads torque or angle not
/// in proportion; NaN where no cause is such a material.
double over_readings(const Comparison& comparison, const Inference& inference) {
    const Hypothesis& causes = comparison.all[comparison.winner].fit.hypothesis;
    const auto form = std::find_if(comparison.forms.begin(), comparison.forms.end(),
                                   [&](const FreeForm& one) { return one.kind == softening_or_stiffening; });
    const bool concerns =
        std::any_of(causes.begin(), causes.end(), [&](const Mechanism* one) { return one->kind == softening_or_stiffening; });
    return concerns && form != comparison.forms.end()
               ? form->log_factor - log_factor_of_readings(inference, comparison.all.front().fit)
               : unset;
}

/// What a name needs beside a probability of 95 %.
std::vector<Condition> conditions_of(const Comparison& comparison, const Inference& inference, const Priors& priors,
                                     const DiagnosisOptions& options, const Gain& gain) {
    const Compared& base = comparison.all.front();
    const Compared& winner = comparison.all[comparison.winner];
    const Kind kind = leading_member(winner.fit.hypothesis, comparison.all)->kind;
    const auto& ends = winner.fit.active_end;
    const auto at_end = static_cast<double>(std::count(ends.begin(), ends.end(), true));
    const double over_other_axes = winner.log_weight() - base.fit.log_evidence - best_along_other_axes(comparison.forms, kind.axis);
    const double beyond_readings = over_readings(comparison, inference);
    const double over_forms = winner.log_weight() - comparison.log_weight_of_none(priors);
    const double left = share_left(comparison, inference);
    const double width = widest_interval(winner.fit);
    const double gained = gained_without_a_row(comparison, inference);
    const Hypothesis& causes = winner.fit.hypothesis;
    const bool separated = std::all_of(causes.begin(), causes.end(),
                                       [&](const Mechanism* one) { return is_separated(*one, inference.forward().experiment()); });
    const double over_members = over_one_member(winner, comparison.all);
    // What was counted of structures differs from one to the next by more than a smooth curve that was seen in the other.
    const auto& observations = inference.errors().data().observations;
    const bool of_moduli = std::all_of(observations.begin(), observations.end(), is_modulus_or_viscosity);
    const double over_smooth = of_moduli ? gain.rmse_flexible / gain.rmse_extended : unset;
    return {{"beats-free-forms", over_forms, decisive, over_forms > decisive},
            {"beats-other-axes", over_other_axes, favoured, over_other_axes > favoured},
            {"beats-readings", beyond_readings, favoured, !(beyond_readings <= favoured)},
            {"every-cause-counts", over_members, decisive, over_members > decisive},
            {"inside-range", at_end, 0, at_end <= 0},
            {"narrower-than-prior", width, widest, width < widest},
            {"little-left", left, small_share, comparison.p_value > options.level || left < small_share},
            {"predicts-held-out", gain.elpd_low, 0, std::isnan(gain.elpd_low) || gain.elpd_low > 0},
            {"predicts-like-smooth", over_smooth, about_as_well, !(over_smooth < about_as_well)},
            {"without-any-row", gained, a_row_less, gained > a_row_less},
            {"separated", separated ? 1.0 : 0.0, 1, separated}};
}

/// One cause alone in the set is named, several are tied. A best cause that does not fit leaves the kind of departure, if that is
/// certain and the cause has as much evidence as none.
Verdict verdict_of(const Diagnosis& diagnosis) {
    constexpr double sure = 0.9;
    const bool none_leads = diagnosis.causes.front().set.unknown;
    if (!fits(diagnosis.conditions)) {
        return none_leads || diagnosis.follows.posterior < sure ? Verdict::none_of_catalogue : Verdict::kind_only;
    }
    return none_leads ? Verdict::none_of_catalogue : diagnosis.credible_set.size() == 1 ? Verdict::named : Verdict::tied;
}

/// Whether the base model with a stiffness that nobody knows explains as much as the best cause with the known one.
bool is_level_alone(const Inference& inference, const Fit& winner) {
    return std::isfinite(inference.stiffness_error()) &&
           inference.density_of_free_level() > inference.errors().log_density(inference.prediction(winner.model)) - decisive;
}

}  // namespace

Cause cause_of(const Fit& fit, const Inference& inference) {
    Cause cause{.set = fit.hypothesis, .log_evidence = fit.log_evidence, .model = fit.model, .draws = fit.draws};
    const auto add = [&](const std::string& name, const std::string& unit, const Estimate& posterior, bool at_end = false) {
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

void judge(const Comparison& comparison, const Inference& inference, const Hypothesis& possible, const DiagnosisOptions& options,
           Diagnosis& diagnosis) {
    const Priors priors = priors_of(options, possible.size());
    const Compared& winner = comparison.all[comparison.winner];
    diagnosis.best = winner.fit.hypothesis;
    diagnosis.extended_p_value = comparison.p_value;
    diagnosis.level_alone = is_level_alone(inference, winner.fit);
    diagnosis.remainder.p_value = comparison.p_value;
    diagnosis.remainder.detected = comparison.p_value <= options.level;
    diagnosis.remainder.most = diagnosis.remainder.detected && leaves_most(comparison, inference);
    if (diagnosis.remainder.detected) {
        place(*winner.discrepancy, inference.errors().data(), inference.fitted(inference.prediction(winner.discrepancy->fit.model)),
              diagnosis.remainder);
    }
    diagnosis.conditions = conditions_of(comparison, inference, priors, options, diagnosis.gain);
    diagnosis.kinds = kinds_of(comparison, inference, fits(diagnosis.conditions));
    diagnosis.follows = follows_of(diagnosis.kinds, comparison, inference);
    const Kind followed = diagnosis.follows.kind;
    diagnosis.follows.link_is_told = is_separated(followed, inference.forward().experiment()) &&
                                     (followed != softening_or_stiffening || holds(diagnosis.conditions, "beats-readings"));
    rank_causes(comparison, inference, priors, diagnosis);
    diagnosis.certain = common_causes(diagnosis.credible_set, possible);
    diagnosis.verdict = verdict_of(diagnosis);
}

}  // namespace coagula::diagnose
