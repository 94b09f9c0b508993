// SPDX-License-Identifier: GPL-3.0-or-later
// From measured data and structures to a named cause and a better model: fit, detect, localise, attribute, extend, gain, propose.
#pragma once

#include <coagula/common/progress.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/mechanism.hpp>
#include <coagula/diagnose/model.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace coagula::diagnose {

struct DiagnosisOptions {
    ErrorSpec errors;            ///< beside those that tables state
    StatedNoise stated_noise;    ///< assumed where errors are estimated anew without what is held out
    double level = 0.05;         ///< of the test whether anything is wrong
    int bootstrap = 999;         ///< data sets behind a p-value
    double held_out_part = 0.3;  ///< of the rows of a table, those at the end of its axis, if no whole table can be held out
    double pair_prior = 0.1;     ///< prior weight of all pairs of mechanisms over that of all single ones
    double none_prior = 0.05;    ///< of "none of the catalogue" over that of a single mechanism
    std::uint64_t seed = 1;
    std::vector<std::string> causes = {};  ///< of the catalogue; empty: all
};

enum class Verdict {
    no_discrepancy,     ///< the base model explains the data
    named,              ///< one cause (or pair) stands out
    tied,               ///< several causes explain the data about equally
    kind_only,          ///< what the data follow is known, but of no cause all holds that a name needs
    none_of_catalogue,  ///< something is wrong that no cause explains
};
/// "no-discrepancy", "named", "tied", "kind-only", "none-of-catalogue".
const char* name_of(Verdict verdict);

/// A value with its 90 % interval.
struct EstimatedParameter {
    std::string name;
    std::string unit;
    double value = 0;
    double low = 0;
    double high = 0;
    bool at_end = false;  ///< of its physical range, beyond which the data would have it
};

/// The comparison found this of the base model, of a cause, of several at once, or of none of the catalogue.
struct Cause {
    CauseSet set = {};
    std::string words = {};  ///< what it changes
    double posterior = 0;
    double log_evidence = 0;
    bool leaves_remainder = false;                    ///< it is more probable with a smooth discrepancy on top than alone
    std::vector<EstimatedParameter> parameters = {};  ///< the stiffness of the particles first, where a modulus shows it
    Model model = {};                                 ///< most probable
    Eigen::MatrixXd draws = {};                       ///< from the posterior: parameters x equally probable draws

    std::string name() const { return name_of(set); }
};

/// One way to fail that the test looked at.
struct TestedStatistic {
    std::string observable;  ///< as in Misfit, or "all"
    std::string axis;        ///< as in Misfit, or "none"
    std::string measure;     ///< "chi-square", "smooth components" or "neighbours"
    double value = 0;
    double score = 0;  ///< standardised
};

/// A kind of departure, and how probable it is that the data follow it.
struct FollowedKind {
    Kind kind{};
    double posterior = 0;       ///< of its causes and its free form together
    double log_factor = unset;  ///< of its free form on the evidence of the base model; NaN where it has none
};

/// This says what the data follow, whatever the cause is.
struct Follows {
    Kind kind{};
    double posterior = 0;       ///< of this kind
    bool link_is_told = false;  ///< something was measured that tells this link from others that follow the same axis
    double change = unset;      ///< mean departure over |G*| at the upper end of the axis less that at the lower one; of the sample
                                ///< that departs most, and along no axis, the mean one
    double largest = unset;     ///< mean of those departures that are half as large as the largest or larger
    double from = unset;        ///< lowest and highest value of the axis
    double to = unset;
    std::string sample = {};  ///< that departs most, where that is the axis
};

/// A condition says what a name needs, and whether the best cause has it.
struct Condition {
    std::string name;
    double value = 0;  ///< NaN where nothing is known of it
    double limit = 0;
    bool holds = false;
};

/// A smooth departure along a coordinate; differences of data and base model over the prediction, or as Observable::whole says.
struct SmoothMisfit {
    double before = 0;           ///< mean difference up to Misfit::from
    bool over_largest = false;   ///< differences are over the largest predicted modulus
    bool base_is_zero = false;   ///< the base model predicts nothing
    bool time_is_stated = true;  ///< tables state the times of these rows
    bool is_the_same = false;    ///< the difference is about the same all along
};

/// The level of the moduli asks for another stiffness or viscosity than the known one.
struct LevelMisfit {
    double known = 0;
    double score = 0;  ///< departure over its standard deviation
};

/// A sample departs as a whole.
struct SampleMisfit {
    std::string sample;
    double score = 0;  ///< departure over its standard deviation
};

/// Images of the same particles differ more than exact ones.
struct ImageMisfit {
    double value = 0;
    double score = 0;  ///< departure over its standard deviation
};

/// Where the base model fails.
struct Misfit {
    std::string observable;       ///< key of the observable
    std::string axis;             ///< "strain", "angular_frequency", "time", "gap" ..., "normal_stiffness", "sample", "frame"
    double log_bayes_factor = 0;  ///< of a smooth departure along the axis against none
    double from = 0;  ///< value of the axis from which on it departs; stiffness that is asked for; number of the sample, from 1
    double departure = 0;  ///< mean relative difference of data and base model there
    std::variant<SmoothMisfit, LevelMisfit, SampleMisfit, ImageMisfit> what = {};
};

/// Values of a coordinate.
struct CoordinateRange {
    std::string coordinate;  ///< its name
    double low = 0;
    double high = 0;
};

/// Deviation that remains beside a model.
struct Remainder {
    bool detected = false;  ///< p_value is not above the level of the test
    double p_value = 1;     ///< of the test, applied to that model
    bool most = false;      ///< with a smooth departure on top the model still leaves more than half of the base model's misfit
    // Where something is left over:
    std::string observable = {};              ///< key of the one that departs most
    double largest = 0;                       ///< its largest departure over |G*|
    std::vector<CoordinateRange> where = {};  ///< where it departs more than half as far, the same way
};

/// Predictions of a row by models that were fitted without the held-out rows [Pa].
struct HeldOutPrediction {
    std::size_t row = 0;  ///< of Diagnosis::rows
    double base = 0;
    double extended = 0;
    double flexible = 0;
};

/// Gain of the diagnosis on data held out: whole samples (or sweeps, or the ends of tables) are held out in turn,
/// the cause is chosen and fitted on the rest. NaN where no rows were held out.
struct Gain {
    std::size_t held_out = 0;  ///< numbers
    double rmse_base = unset;  ///< of the relative difference
    double rmse_extended = unset;
    double rmse_flexible = unset;    ///< of a base model with a smooth (Gaussian process) correction
    double rmse_ratio = unset;       ///< base over extended
    double elpd_difference = unset;  ///< in expected log predictive density, extended less base
    double elpd_low = unset;         ///< 90 % interval by block bootstrap; NaN with fewer than two blocks of rows
    double elpd_high = unset;
    std::vector<HeldOutPrediction> predictions = {};
    std::vector<CauseSet> chosen = {};  ///< cause that the rest of each fold asks for: the same each time if the data are clear
};

/// A measurement that would tell the causes of a tie apart.
struct Proposal {
    std::string measurement;           ///< key: "amplitude-sweep", "gap-series-with-oil" ...
    std::vector<double> lengths = {};  ///< gaps or radius [m]; NaN where nobody knows them
    double rest = unset;               ///< between two sweeps [s]
    double information = 0;            ///< expected information gain [bit]
    double resolution = 0;             ///< probability that one cause is then certain to 95 %
};

/// One observation beside the models.
struct PredictedRow {
    std::size_t measurement = 0;
    std::size_t row = 0;
    std::string observable;
    double measured = 0;
    double standard_deviation = 0;  ///< of a row
    double base = 0;                ///< without the effect of its sample
    double extended = 0;
    double base_fitted = 0;  ///< with the most probable effect of its sample and errors of the prediction, as residuals have it
    double extended_fitted = 0;
    bool held_out = false;
    double base_residual =
        0;  ///< measured less predicted, sample effects taken out, over the standard deviation (and decorrelated)
    double extended_residual = 0;
    double distance = unset;  ///< of the middle of the shells, over the diameter, where these are neighbours
};

/// Prediction of a cause other than the best, to compare with the data.
struct OtherPrediction {
    CauseSet cause;
    std::vector<double> values;  ///< of each of Diagnosis::rows, without the effect of the sample
    std::vector<double> fitted;  ///< as PredictedRow::extended_fitted
};

struct Diagnosis {
    bool detected = false;
    double p_value = 1;
    Verdict verdict = Verdict::no_discrepancy;
    Cause base;
    std::vector<Cause> causes;           ///< all that were compared, most probable first
    std::vector<CauseSet> credible_set;  ///< smallest set with 95 % of the posterior; pairs with a member of the set left out
    CauseSet best;                       ///< cause that explains most, alone or with a discrepancy, where something was detected
    CauseSet certain;                    ///< causes that all of the credible set have, alone or in a pair
    Follows follows;                     ///< where something was detected
    std::vector<FollowedKind> kinds;     ///< of departure, most probable first
    std::vector<Condition> conditions;   ///< of the name of the best cause
    std::vector<Misfit> misfits;         ///< strongest first
    double extended_p_value = 1;         ///< of the test, applied to the best cause
    Remainder remainder;                 ///< that the best cause leaves over
    bool level_alone = false;            ///< a departure of the level of the moduli alone says as much as the best cause
    Gain gain;
    std::vector<Proposal> proposals;  ///< most informative first
    double sample_deviation = 0;      ///< of the factor of a sample, less 1, beforehand
    std::vector<PredictedRow> rows;
    std::size_t observations = 0;
    std::vector<TestedStatistic> statistics;     ///< of the base model, largest score first
    std::vector<double> bootstrap;               ///< largest score of each data set drawn from the base model
    std::vector<SampleEffect> base_effects;      ///< most probable b of each sample, prediction x (1 + b)
    std::vector<SampleEffect> extended_effects;  ///< the same for the best cause
    std::vector<OtherPrediction> others;         ///< of the next most probable causes, at most four
};

/// The cause that explains most: predicted rows, conditions, p-value and remainder are its. Null where nothing was detected.
const Cause* best_cause(const Diagnosis& diagnosis);

/// Checks made before anything is simulated: throws InputError when there are fewer than five usable numbers, too little to say
/// anything, or too many, when no cause can show, or when rows of a structure series have no structures.
void check(const Experiment& experiment, const DiagnosisOptions& options);

/// Diagnoses an experiment whose tables have passed check_data. Throws as `check` does.
Diagnosis diagnose(const Experiment& experiment, Simulator& simulator, const DiagnosisOptions& options = {},
                   const Progress& progress = {});

}  // namespace coagula::diagnose
