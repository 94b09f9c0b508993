// SPDX-License-Identifier: GPL-3.0-or-later
// The response to a step, sampled in time, as a function of the frequency.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace coagula::diagnose {

/// Holds the answer of a sample to a step at time zero, over the height of the step.
struct StepResponse {
    Eigen::ArrayXd times;        ///< from 0 or more, rising [s]
    Eigen::VectorXd values;      ///< eight or more
    Eigen::VectorXd deviations;  ///< standard ones of the values
    double least_power = 0;      ///< of the time that the values follow before the first row
    double most_power = 3;
};

/// i w times the integral of a response times exp(-i w t) from zero to infinity, at one angular frequency.
struct TransformedRow {
    double angular_frequency;    ///< [rad/s]
    std::complex<double> value;  ///< in the unit of the response
    double along;                ///< standard deviation of its size, over the size
    double across;               ///< standard deviation of its phase [rad]
    double correlation;          ///< of its error with that of the row before; 0 of the first one
};

/// Transforms a step response after Evans, Tassieri, Auhl and Waigh (Phys. Rev. E 80 (2009) 012501): the integral over straight
/// lines is taken exactly. Between the rows seven further points lie on the cubic through four neighbours (Tassieri and others, J.
/// Rheol. 60 (2016) 649, who call it oversampling). What the rows do not show:
/// - before the first row, the response follows the power of time of the first octave;
/// - after the last one, its slope follows the power of time of the last two octaves.
///
/// The deviations hold the scatter of the rows, the difference from transforms of every other row (a quarter of it), and how much
/// the two powers may be wrong: half of their difference from those of the octaves beside; and one hundredth, for what the rows do
/// not show.
/// @param frequencies angular ones, not below one over the last time.
std::vector<TransformedRow> transform(const StepResponse& response, const std::vector<double>& frequencies);

/// 10^(k/5) rad/s from one over the last time to one over the first.
std::vector<double> frequencies_within(const Eigen::ArrayXd& times);

}  // namespace coagula::diagnose
