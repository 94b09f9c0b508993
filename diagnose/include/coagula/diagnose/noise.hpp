// SPDX-License-Identifier: GPL-3.0-or-later
// Noise of measured data: a floor, a relative part and a random effect of each sample, estimated from replicates.
//
//     y = mu (1 + b) + e,     b ~ N(0, sample^2) once per sample,     e ~ N(0, (w floor)^2 + (relative mu (1 + b))^2) in each row
//
// A rheometer reads a torque and a phase. Where a table has both moduli, y is therefore |G*|, whose errors are those of the torque,
// and beside it the part of G* at right angles to its mean, which is |G*| times the error of the phase: that has mu = |G*|, but
// averages to zero and has no effect of the sample. The floor of a modulus is one of the stress where the strain amplitude is
// known, w = 1/strain; otherwise w = 1.
#pragma once

#include <coagula/diagnose/error_spec.hpp>
#include <coagula/diagnose/measurement.hpp>

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// One observable under the same conditions, several times.
struct Replicates {
    MeasurementKind kind = MeasurementKind::amplitude_sweep;
    std::string observable;  ///< "complex_modulus" and "phase" of a table with both moduli; else the name of its one quantity
    std::string unit;
    Eigen::VectorXd axis;                  ///< one per condition
    std::vector<std::string> samples;      ///< one per table; tables of one sample share its effect
    Eigen::MatrixXd values;                ///< conditions x tables; NaN where there is none
    Eigen::VectorXd floor_weights;         ///< w, one per condition
    bool floor_of_stress = false;          ///< w is 1/strain
    std::vector<std::string> labels = {};  ///< of the tables
    std::vector<std::size_t> tables = {};  ///< their places among the measurements
    Eigen::VectorXd levels = {};           ///< of a phase: mean |G*|, one per condition
    int fitted = 0;                        ///< parameters that were fitted to the values and taken out of them
};

/// Tables of one kind with the same run order whose axes run in the same direction and share at least three values, to 2 %, and
/// that were measured at the same frequency and strain as far as these are not the axis; moduli of sweeps and gap series only.
/// Tables without a partner make a group of their own. Where the tables of a group tell normal forces that differ in course by 0.1
/// N or more, what follows the force is taken out of their values, by least squares. The measurements must have passed check_data.
std::vector<Replicates> find_replicates(const std::vector<Measurement>& measurements);

/// A number with its interval. Of a standard deviation it is the 95 % profile-likelihood one, and low = high where it was not
/// estimated; of a cause's parameter it is the 90 % one of the posterior.
struct Estimate {
    double value = 0;
    double low = 0;
    double high = 0;
};

struct SampleEffect {
    std::string sample;
    double effect;  ///< best linear unbiased prediction of b
};

/// Noise that is stated, or usual: it is assumed where there are no replicates.
struct StatedNoise {
    double relative = 0.05;
    double sample = 0.1;
    double floor = 0;            ///< unit of the observable; of the stress where the strain is known
    double phase = 0.005;        ///< error of the phase [rad]
    double correlation = unset;  ///< of neighbouring rows; unset: nobody knows
};

struct NoiseModel {
    MeasurementKind kind = MeasurementKind::amplitude_sweep;
    std::string observable;
    std::string unit;
    Estimate floor;     ///< `unit`; of the stress in Pa where `floor_of_stress`
    Estimate relative;  ///< 1
    Estimate sample;    ///< 1
    bool floor_of_stress = false;
    bool rows_estimated = false;    ///< floor and relative part come from the data, else they are stated
    bool sample_estimated = false;  ///< likewise the sample effect
    std::size_t tables = 0;
    std::size_t samples = 0;
    std::size_t values = 0;
    std::vector<SampleEffect> sample_effects;  ///< where estimated
    /// Correlation of neighbouring residuals within a table; where it is high, rows are not independent and `relative` describes
    /// the drift of whole stretches.
    double autocorrelation = 0;
    std::vector<std::string> labels = {};                      ///< of the tables
    double stated_correlation = unset;                         ///< of neighbouring rows, where no replicates tell
    std::size_t conditions = 0;                                ///< with replicates
    double excess_kurtosis = 0;                                ///< of a single error, 0 for normal ones
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom of the rows' deviation
    /// Set value and level of every condition; empty unless estimated.
    Eigen::VectorXd axis = {};
    Eigen::VectorXd levels = {};
    bool floor_is_told = true;                          ///< the levels differ enough to separate a floor from the relative part
    bool averages_to_zero = false;                      ///< replicates do, or to less, so that they tell nothing
    std::optional<MeasurementKind> borrowed_from = {};  ///< whose replicates told the rows' noise, where it has none
};

/// Unit of the floor.
inline std::string floor_unit(const NoiseModel& noise) {
    return noise.floor_of_stress ? "Pa" : noise.unit;
}

/// Whether the errors are those of the phase, else those of the torque.
inline bool is_of_phase(const NoiseModel& noise) {
    return noise.observable == "phase";
}

/// Restricted maximum likelihood (Patterson, Thompson, Biometrika 58 (1971) 545): one free level per condition, the three variances
/// by the likelihood of the contrasts between replicates; the levels and effects in the variances are those of the previous of four
/// passes. Throws std::invalid_argument when sizes do not fit together.
NoiseModel fit_noise(const Replicates& replicates, const StatedNoise& given = {});

/// The models of all tables of moduli. Tables without replicates take the rows' noise of those that have some: that of the same
/// errors, of torque or phase, from the largest number of degrees of freedom.
std::vector<NoiseModel> noise_of_tables(const std::vector<Measurement>& measurements, const StatedNoise& stated = {});

/// Joint statement of the models of torque, or of phase, about errors besides their size. Correlation of neighbours: what
/// replicates show, freed from the bias that estimated sample effects make, where all from 0 to 0.9 are equally probable
/// beforehand. Tail: the kurtosis, drawn towards that of normal errors.
struct ErrorShape {
    ErrorLaw law;
    double factor = 1;  ///< on the model's deviation: drawn towards the other tables', and freed from what correlated rows lose to
                        ///< the sample effects
};
ErrorShape shape_of_errors(const std::vector<NoiseModel>& models, const NoiseModel& model);

/// Standard deviation of e where the sample itself has this level, mu (1 + b); of the phase, |G*|. @param floor_weight w, see
/// above.
double standard_deviation(const NoiseModel& noise, double level, double floor_weight);

/// Errors by the noise models for every modulus and viscosity whose error neither its table nor a reduction states, and the effect
/// of a sample. Models of the same samples tell the same effects; the stated one is known to a factor of e beforehand.
/// @param known errors so far: those by noise models are replaced, the others stay.
ErrorSpec estimated_errors(const Experiment& experiment, const std::vector<NoiseModel>& noise, const StatedNoise& stated = {},
                           ErrorSpec known = {});

/// Errors that are to be expected where a table will show these numbers: stated ones of torque and phase, those of one modulus or
/// viscosity alone as of the torque, and of a part of a third harmonic a quarter of it beside the unstated one.
TableErrors planned_errors(const Measurement& table, const StatedNoise& noise);

}  // namespace coagula::diagnose
