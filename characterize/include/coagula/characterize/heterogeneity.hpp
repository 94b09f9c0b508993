// SPDX-License-Identifier: GPL-3.0-or-later
// Degree of heterogeneity: the width a of the error function fitted to the pore-size curve (Schenker et al. 2012, section 2.3).
#pragma once

#include <coagula/characterize/pore_sizes.hpp>

namespace coagula::characterize {

/// Least-squares fit of P(r_P > r) = 1 - erf((r/r0 - b) / (a sqrt 2)) with a and b free, over all radii of the curve.
struct DegreeOfHeterogeneity {
    double a = unset;         ///< width in units of r0: the degree of heterogeneity
    double b = unset;         ///< position in units of r0, near zero
    double a_stderr = unset;  ///< standard errors from the curvature of the sum of squares and the residual variance
    double b_stderr = unset;
    double rms_residual = unset;  ///< of P
    int iterations = 0;
};

/// @param r0 radius that makes lengths dimensionless [m].
/// @param lowest_probability only the part of the curve with P at or above it is fitted; 0: all of it, as published.
DegreeOfHeterogeneity fit_degree_of_heterogeneity(const PoreSizes& pores, double r0, double lowest_probability = 0);

}  // namespace coagula::characterize
