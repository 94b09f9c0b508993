// SPDX-License-Identifier: GPL-3.0-or-later
// Special functions and quantiles. They stand behind one source: the templates of Boost.Math take seconds to compile wherever they
// are included.
#pragma once

namespace coagula {

/// The x below which a standard normal number lies with this probability, in (0, 1).
double normal_quantile(double probability);

/// The x above which a standard normal number lies with this probability, in (0, 1). Accurate for the smallest probabilities, and
/// faster than the other by its last digits.
double upper_normal_quantile(double probability);

/// The x below which a number with Student's distribution lies with this probability, in (0, 1).
double student_quantile(double degrees_of_freedom, double probability);

/// Probability that a number with Student's distribution lies above x.
double above_in_student(double degrees_of_freedom, double x);

/// P(shape, x), the regularised lower incomplete gamma function, and its derivative by x.
double gamma_p(double shape, double x);
double gamma_p_derivative(double shape, double x);

/// First and second derivative of ln Gamma.
double digamma(double x);
double trigamma(double x);

}  // namespace coagula
