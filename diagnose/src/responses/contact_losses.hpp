// SPDX-License-Identifier: GPL-3.0-or-later
// Time-dependent elements beside the springs of every contact.
#pragma once

#include <coagula/diagnose/settings.hpp>

#include "response.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace coagula::diagnose {

inline bool has_contact_losses(const Settings& settings) {
    return settings.springpot_ratio > 0 || settings.dashpot_time > 0 || settings.relaxing_ratio > 0;
}

/// Complex stiffness of springpot, dashpot and Maxwell element over that of the spring. In the same proportion to both springs they
/// scale the whole stiffness matrix.
inline std::complex<double> contact_losses(const Settings& settings, double angular_frequency) {
    const std::complex<double> dashpot(0, angular_frequency * settings.dashpot_time);
    const std::complex<double> relaxing(0, angular_frequency * settings.relaxation_time);
    std::complex<double> losses = dashpot + settings.relaxing_ratio * relaxing / (1.0 + relaxing);
    if (settings.springpot_ratio > 0) {
        const std::complex<double> cycles(0, angular_frequency / (2 * std::numbers::pi));
        losses += settings.springpot_ratio * std::pow(cycles, settings.springpot_exponent);
    }
    return losses;
}

inline Response losses_in_contacts() {
    return {.acts = [](const Settings& settings,
                       const Conditions& at) { return has_contact_losses(settings) && std::isfinite(at.angular_frequency); },
            .factor = [](Simulator&, const Settings& settings, const Conditions& at,
                         bool) { return 1.0 + contact_losses(settings, at.angular_frequency); }};
}

}  // namespace coagula::diagnose
