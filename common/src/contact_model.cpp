// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_directions.hpp"

#include <coagula/common/contact_model.hpp>

#include <cmath>
#include <numbers>

namespace coagula {

namespace {

using Complex = std::complex<double>;

/// i w t / (1 + i w t).
Complex maxwell_factor(double w_t) {
    return Complex(0, w_t) / Complex(1, w_t);
}

/// (i x)^a = x^a e^{i a pi / 2}.
Complex springpot_factor(double x, double exponent) {
    return std::polar(std::pow(x, exponent), exponent * std::numbers::pi / 2);
}

Complex direction_stiffness(const ContactModel& m, double w, const Direction& d) {
    Complex k = m.*d.stiffness / 2;  // two equal springs in series
    if (has(m, d.viscosity)) {
        k += Complex(0, w * m.*d.viscosity);
    }
    if (has(m, d.maxwell_stiffness)) {
        k += m.*d.maxwell_stiffness * maxwell_factor(w * m.*d.maxwell_time);
    }
    if (has(m, d.springpot_stiffness)) {
        k += m.*d.springpot_stiffness * springpot_factor(w * m.*d.springpot_time, m.*d.springpot_exponent);
    }
    return k;
}

Complex direction_derivative(const ContactModel& m, double w, const Direction& d, Parameter parameter) {
    if (parameter == d.stiffness) {
        return 0.5;
    }
    if (parameter == d.viscosity) {
        return {0, w};
    }
    if (parameter == d.maxwell_stiffness) {
        return maxwell_factor(w * m.*d.maxwell_time);
    }
    if (parameter == d.maxwell_time) {
        const Complex slowing(1, w * m.*d.maxwell_time);
        return m.*d.maxwell_stiffness * Complex(0, w) / (slowing * slowing);
    }
    if (parameter != d.springpot_stiffness && parameter != d.springpot_time && parameter != d.springpot_exponent) {
        return 0;
    }
    const double x = w * m.*d.springpot_time;
    const Complex factor = springpot_factor(x, m.*d.springpot_exponent);
    if (parameter == d.springpot_stiffness) {
        return factor;
    }
    const Complex stiffness = m.*d.springpot_stiffness * factor;
    return parameter == d.springpot_time ? stiffness * (m.*d.springpot_exponent / m.*d.springpot_time)
                                         : stiffness * Complex(std::log(x), std::numbers::pi / 2);
}

}  // namespace

ContactStiffness complex_stiffness(const ContactModel& model, double angular_frequency) {
    return {direction_stiffness(model, angular_frequency, normal_direction),
            direction_stiffness(model, angular_frequency, shear_direction)};
}

ContactStiffness stiffness_derivative(const ContactModel& model, double angular_frequency, double ContactModel::*parameter) {
    return {direction_derivative(model, angular_frequency, normal_direction, parameter),
            direction_derivative(model, angular_frequency, shear_direction, parameter)};
}

double translation_drag(double radius) {
    return 6 * std::numbers::pi * radius;
}

double rotation_drag(double radius) {
    return 8 * std::numbers::pi * radius * radius * radius;
}

}  // namespace coagula
