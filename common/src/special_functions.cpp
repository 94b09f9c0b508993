// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/special_functions.hpp>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

namespace coagula {

namespace math = boost::math;

double normal_quantile(double probability) {
    return math::quantile(math::normal(), probability);
}

double upper_normal_quantile(double probability) {
    const math::normal_distribution<double, math::policies::policy<math::policies::promote_double<false>>> normal;
    return math::quantile(math::complement(normal, probability));
}

double student_quantile(double degrees_of_freedom, double probability) {
    return math::quantile(math::students_t(degrees_of_freedom), probability);
}

double above_in_student(double degrees_of_freedom, double x) {
    return math::cdf(math::complement(math::students_t(degrees_of_freedom), x));
}

double gamma_p(double shape, double x) {
    return math::gamma_p(shape, x);
}

double gamma_p_derivative(double shape, double x) {
    return math::gamma_p_derivative(shape, x);
}

double digamma(double x) {
    return math::digamma(x);
}

double trigamma(double x) {
    return math::trigamma(x);
}

}  // namespace coagula
