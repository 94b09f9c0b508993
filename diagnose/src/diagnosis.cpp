#include <coagula/diagnose/diagnosis.hpp>

#include "detection.hpp"
#include "flexible.hpp"
#include "gain.hpp"
#include "hypothesis.hpp"
#include "localise.hpp"
#include "proposal.hpp"
#include "weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr std::size_t most_pairs = 4;
constexpr double with_ease = 0.2;  ///< p-value of the best cause from which on pairs are not tried
constexpr double certain = 0.95;
constexpr const char* none_name = "none of the catalogue";

/// Whether something measured depends on the stiffness of the particles.
bool shows_stiffness(const Inference& inference) {
    const auto& observations = inference.likelihood().data().observations;
    return std::any_of(observations.begin(), observations.end(),
                       [](const Observation& one) { return is_modulus(one) && !std::isfinite(one.fluid_viscosity); });
}

Cause cause_of(const Fit& fit, const Inference& inference) {
    Cause cause{.name = name_of(fit.hypothesis), .log_evidence = fit.log_evidence, .settings = fit.settings, .draws = fit.draws};
    const auto add = [&](const std::string& name, const std::string& unit, const Posterior& posterior) {
        cause.parameters.push_back({name, unit, posterior.value, posterior.low, posterior.high});
    };
    if (shows_stiffness(inference)) {
        add("normal_stiffness", "N/m", fit.stiffness);
    } else {
        cause.draws = fit.draws.bottomRows(std::max<Index>(0, fit.draws.rows() - 1)).eval();
    }
    std::size_t next = 0;
    for (const Mechanism* mechanism : fit.hypothesis) {
        cause.words += (cause.words.empty() ? "" : "; ") + mechanism->term;
        for (const MechanismParameter& parameter : mechanism->parameters) {
            add(parameter.name, parameter.unit, fit.parameters[next++]);
        }
    }
    return cause;
}

/// The causes that the experiment can show and that are asked for.
std::vector<const Mechanism*> possible_causes(const Experiment& experiment, const std::vector<std::string>& wanted) {
    require_causes(wanted);
    std::vector<const Mechanism*> possible;
    for (const Mechanism& mechanism : catalogue()) {
        if (is_asked_for(mechanism, wanted) && mechanism.applies(experiment)) {
            possible.push_back(&mechanism);
        }
    }
    if (possible.empty()) {
        throw InputError(wanted.empty() ? "no cause of the catalogue can show in this experiment"
                                        : "none of the causes asked for can show in this experiment");
    }
    return possible;
}

/// Logarithms of prior weights over that of a single mechanism.
struct Priors {
    double pair;  ///< of one pair
    double none;
};

Priors priors_of(const DiagnosisOptions& options, std::size_t mechanisms) {
    // n mechanisms make n (n - 1) / 2 pairs.
    const double pairs = std::max(1.0, (static_cast<double>(mechanisms) - 1) / 2);
    return {.pair = std::log(options.pair_prior / pairs), .none = std::log(options.none_prior)};
}

double log_prior_of(const Fit& fit, const Priors& priors) {
    return fit.hypothesis.size() > 1 ? priors.pair : 0.0;
}

/// What was compared.
struct Comparison {
    std::vector<Fit> fits;   ///< the base model first
    std::size_t winner = 0;  ///< the most probable of all but the base model
    double p_value = 1;      ///< of the test, applied to the winner
};

std::size_t most_probable_cause(const std::vector<Fit>& fits, const Priors& priors) {
    const auto best = std::max_element(fits.begin() + 1, fits.end(), [&](const Fit& a, const Fit& b) {
        return a.log_evidence + log_prior_of(a, priors) < b.log_evidence + log_prior_of(b, priors);
    });
    return static_cast<std::size_t>(best - fits.begin());
}

/// Fits single causes; where the best does not pass the test with ease, it is paired with those causes towards which the data still
/// depart from it.
Comparison compare(const Fit& base, const std::vector<const Mechanism*>& possible, const Inference& inference,
                   const DiagnosisOptions& options, const Progress& progress) {
    const Priors priors = priors_of(options, possible.size());
    Comparison comparison{.fits = {base}};
    std::vector<Fit>& fits = comparison.fits;
    for (const Mechanism* mechanism : possible) {
        progress.update("attributing", 0.5, mechanism->name);
        fits.push_back(inference.fit({mechanism}));
    }
    const std::size_t best = most_probable_cause(fits, priors);
    const Detection rest = detect(inference, fits[best], possible, options.seed, options.bootstrap);
    std::size_t pairs = 0;
    for (const MisfitStatistic& statistic : rest.statistics) {
        const auto partner =
            std::find_if(possible.begin(), possible.end(), [&](const Mechanism* one) { return one->name == statistic.cause; });
        if (rest.p_value < with_ease && partner != possible.end() && pairs < most_pairs) {
            progress.update("attributing", 0.8, "pairs");
            fits.push_back(inference.fit({fits[best].hypothesis[0], *partner}));
            ++pairs;
        }
    }
    comparison.winner = most_probable_cause(fits, priors);
    comparison.p_value = comparison.winner == best
                             ? rest.p_value
                             : detect(inference, fits[comparison.winner], possible, options.seed, options.bootstrap).p_value;
    return comparison;
}

/// By how much a p-value can speak against a hypothesis at most: the bound -e p ln p of the Bayes factor (Sellke, Bayarri and
/// Berger 2001), as the logarithm of its inverse.
double most_evidence_against(double p_value) {
    return p_value < 1 / std::numbers::e ? -std::log(-std::numbers::e * p_value * std::log(p_value)) : 0.0;
}

/// Posterior of each fit and, last, of "none of the catalogue".
std::vector<double> posteriors(const std::vector<Fit>& fits, double none_evidence, const Priors& priors) {
    std::vector<double> logarithms;
    for (const Fit& fit : fits) {
        logarithms.push_back(fit.log_evidence + log_prior_of(fit, priors));
    }
    logarithms.push_back(none_evidence + priors.none);
    return probabilities_of(std::move(logarithms));
}

std::vector<SampleEffect> effects_of(const Likelihood& likelihood, const Eigen::VectorXd& prediction, const ModelErrors& errors) {
    const Eigen::VectorXd values = likelihood.effects(prediction, errors);
    std::vector<SampleEffect> effects;
    for (std::size_t k = 0; k < likelihood.data().sample_names.size(); ++k) {
        effects.push_back({likelihood.data().sample_names[k], values[static_cast<Index>(k)]});
    }
    return effects;
}

/// Every row beside both models, and the effects of the samples.
void predict_rows(const DataSet& data, const Inference& inference, const Settings& base, const Settings& extended,
                  const std::vector<bool>& held_out, Diagnosis& diagnosis) {
    const Likelihood& likelihood = inference.likelihood();
    const Eigen::VectorXd by_base = inference.forward().predict(base);
    const Eigen::VectorXd by_extended = inference.forward().predict(extended, true);
    const ModelErrors errors = inference.forward().yield_errors(extended);
    const Eigen::VectorXd base_residual = likelihood.residual(by_base);
    const Eigen::VectorXd extended_residual = likelihood.residual(by_extended, errors);
    diagnosis.base_effects = effects_of(likelihood, by_base, {});
    diagnosis.extended_effects = effects_of(likelihood, by_extended, errors);
    for (std::size_t k = 0; k < data.observations.size(); ++k) {
        const Observation& observation = data.observations[k];
        const auto i = static_cast<Index>(k);
        diagnosis.rows.push_back({observation.measurement, observation.row, observable_of(observation), observation.value,
                                  data.noise.deviation[i], by_base[i], by_extended[i], held_out[k], base_residual[i],
                                  extended_residual[i]});
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

void rank_causes(const std::vector<Fit>& fits, const Inference& inference, double none_evidence, const Priors& priors,
                 Diagnosis& diagnosis) {
    const std::vector<double> posterior = posteriors(fits, none_evidence, priors);
    for (std::size_t k = 0; k < fits.size(); ++k) {
        diagnosis.causes.push_back(cause_of(fits[k], inference));
        diagnosis.causes.back().posterior = posterior[k];
    }
    diagnosis.causes.push_back({.name = none_name,
                                .words = "a smooth departure that no mechanism of the catalogue makes",
                                .posterior = posterior.back(),
                                .log_evidence = none_evidence});
    std::stable_sort(diagnosis.causes.begin(), diagnosis.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.posterior > b.posterior; });
    double sum = 0;
    for (const Cause& cause : diagnosis.causes) {
        if (sum < certain) {
            const auto& set = diagnosis.credible_set;
            // A pair whose one member explains the data alone, and better, adds no cause.
            const bool adds =
                std::none_of(set.begin(), set.end(), [&](const std::string& name) { return contains(cause.name, name); });
            if (adds) {
                diagnosis.credible_set.push_back(cause.name);
            }
            sum += cause.posterior;
        }
    }
}

const Fit& fit_named(const std::vector<Fit>& fits, const std::string& name) {
    return *std::find_if(fits.begin(), fits.end(), [&](const Fit& fit) { return name_of(fit.hypothesis) == name; });
}

/// What to measure next, to tell the causes of the credible set apart.
std::vector<Proposal> proposals_for(const Diagnosis& diagnosis, const std::vector<Fit>& fits, const Inference& inference,
                                    Simulator& simulator, std::uint64_t seed) {
    std::vector<Fit> candidates;
    std::vector<double> weights;
    for (const Cause& cause : diagnosis.causes) {
        const bool in_set =
            std::find(diagnosis.credible_set.begin(), diagnosis.credible_set.end(), cause.name) != diagnosis.credible_set.end();
        if (in_set && cause.name != none_name && cause.name != "base") {
            candidates.push_back(fit_named(fits, cause.name));
            weights.push_back(cause.posterior);
        }
    }
    return propose(inference, simulator, candidates, weights, seed);
}

Verdict verdict_of(const Diagnosis& diagnosis, double level) {
    if (!diagnosis.detected) {
        return Verdict::no_discrepancy;
    }
    if (diagnosis.causes.front().name == none_name || diagnosis.extended_p_value <= level) {
        return Verdict::none_of_catalogue;
    }
    return diagnosis.credible_set.size() == 1 ? Verdict::named : Verdict::tied;
}

}  // namespace

const char* name_of(Verdict verdict) {
    constexpr std::array<const char*, 4> names{"no-discrepancy", "named", "tied", "none-of-catalogue"};
    return names.at(static_cast<std::size_t>(verdict));
}

Diagnosis diagnose(const Experiment& experiment, Simulator& simulator, const DiagnosisOptions& options, const Progress& progress) {
    const std::vector<const Mechanism*> possible = possible_causes(experiment, options.causes);
    DataSet data = data_set_of(experiment, options.noise);
    const Forward forward(experiment, data.observations, simulator);
    data.noise.deviation =
        (data.noise.deviation.array().square() + forward.structure_deviation(data.values).array().square()).sqrt();
    const Likelihood likelihood(data);
    const Inference inference(forward, likelihood);
    const std::vector<bool> held_out = choose_held_out(experiment, data.observations, options.held_out_part);

    Diagnosis diagnosis;
    diagnosis.noise = options.noise;
    diagnosis.observations = data.observations.size();
    progress.update("fitting the base model", 0.1);
    const Fit base = inference.fit({});
    diagnosis.base = cause_of(base, inference);
    const Detection detection = detect(inference, base, possible, options.seed, options.bootstrap);
    diagnosis.p_value = detection.p_value;
    diagnosis.detected = diagnosis.p_value <= options.level;
    keep_statistics(detection, diagnosis);
    if (!diagnosis.detected) {
        predict_rows(data, inference, base.settings, base.settings, held_out, diagnosis);
        return diagnosis;
    }
    const Eigen::VectorXd base_prediction = forward.predict(base.settings);
    diagnosis.failures = localise(inference, base, detection);

    const Comparison comparison = compare(base, possible, inference, options, progress);
    const Fit& winner = comparison.fits[comparison.winner];
    diagnosis.extended_p_value = comparison.p_value;
    // A smooth correction also takes up noise that is larger than stated; the test knows how uncertain the noise is.
    const double none = std::min(flexible_evidence(data, forward, base_prediction),
                                 winner.log_evidence + most_evidence_against(diagnosis.extended_p_value));
    rank_causes(comparison.fits, inference, none, priors_of(options, possible.size()), diagnosis);
    diagnosis.verdict = verdict_of(diagnosis, options.level);
    progress.update("measuring the gain", 0.9);
    diagnosis.gain = measure_gain(data, held_out, experiment, simulator, winner.hypothesis, options.seed);
    predict_rows(data, inference, base.settings, winner.settings, held_out, diagnosis);
    if (diagnosis.verdict == Verdict::tied) {
        diagnosis.proposals = proposals_for(diagnosis, comparison.fits, inference, simulator, options.seed);
    }
    return diagnosis;
}

}  // namespace coagula::diagnose
