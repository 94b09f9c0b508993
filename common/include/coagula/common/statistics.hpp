// SPDX-License-Identifier: GPL-3.0-or-later
// Mean and errors of a sample.
#pragma once

#include <coagula/common/checks.hpp>

#include <Eigen/Core>

namespace coagula {

struct MeanWithError {
    Eigen::Index count = 0;
    double mean = unset;
    double standard_deviation = unset;  ///< of one value about the mean, with n - 1 in the denominator; unset for one value
    double standard_error = unset;      ///< of the mean: standard_deviation / sqrt(n); unset for one value
};

/// Of independent values, such as one modulus from each of several structures: the standard error then covers the scatter from
/// structure to structure. Values within one structure, such as its six orientations, are not independent.
/// Throws std::invalid_argument for no value, and for one that is not finite.
MeanWithError mean_and_standard_error(const Eigen::VectorXd& values);

}  // namespace coagula
