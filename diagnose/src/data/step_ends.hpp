// SPDX-License-Identifier: GPL-3.0-or-later
// These curves stand for a step response before its first row and after its last one.
#pragma once

#include <Eigen/Core>

#include <complex>

namespace coagula::diagnose {

/// A power of the time, up to the first row.
class StepStart {
public:
    StepStart(const Eigen::ArrayXd& times, const Eigen::VectorXd& values, double least_power, double most_power);

    /// Returns the weight of the first value in i w times the integral up to it.
    std::complex<double> weight(double frequency) const { return weight(frequency, power_); }
    /// Error of the integral by that of the power.
    double error(double frequency) const;

private:
    std::complex<double> weight(double frequency, double power) const;

    double time_;
    double value_;
    double power_ = 1;
    double power_error_ = 1;
};

/// A slope that follows a power of the time, from the last row on.
class StepEnd {
public:
    StepEnd(const Eigen::ArrayXd& times, const Eigen::VectorXd& values, const Eigen::VectorXd& deviations);

    /// Returns the weights of all values in i w times the integral from the last row on.
    Eigen::VectorXcd weights(double frequency) const;
    /// Error of the integral by that of the power, by whether the slope falls exponentially, and by what still rings.
    double error(double frequency) const;

private:
    std::complex<double> slope_weight(double frequency, double power) const;

    double time_;
    Eigen::VectorXd slope_weights_;  ///< of the values in the slope at the end
    Eigen::VectorXd level_weights_;  ///< of the values in the level at the end
    double slope_ = 0;
    double power_ = 1;  ///< of one over the time that the slope falls with
    double power_error_ = 1;
    double ringing_ = 0;  ///< root mean square of what is left about the curve through the last octave
};

}  // namespace coagula::diagnose
