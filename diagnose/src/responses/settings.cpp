// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/settings.hpp>

#include <coagula/common/contact_law.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr double particle_poisson_ratio = 0.2;  // alumina 0.22, silica 0.17

}  // namespace

ContactModel contact_model_of(const Settings& settings, double radius) {
    ContactModel model;
    model.normal_stiffness = settings.normal_stiffness;
    model.shear_stiffness = settings.stiffness_ratio * settings.normal_stiffness;
    const double normal = stiffness_in_series(model.normal_stiffness, model.normal_stiffness);
    const double shear = stiffness_in_series(model.shear_stiffness, model.shear_stiffness);
    if (settings.bending_ratio > 0) {
        model.bending_stiffness = model.twisting_stiffness = settings.bending_ratio * normal * radius * radius;
    }
    if (settings.springpot_ratio > 0) {
        model.normal_springpot_stiffness = settings.springpot_ratio * normal;
        model.shear_springpot_stiffness = settings.springpot_ratio * shear;
        model.normal_springpot_time = model.shear_springpot_time = 1 / (2 * std::numbers::pi);
        model.normal_springpot_exponent = model.shear_springpot_exponent = settings.springpot_exponent;
    }
    if (settings.dashpot_time > 0) {
        model.normal_viscosity = settings.dashpot_time * normal;
        model.shear_viscosity = settings.dashpot_time * shear;
    }
    if (settings.relaxing_ratio > 0) {
        model.normal_maxwell_stiffness = settings.relaxing_ratio * normal;
        model.shear_maxwell_stiffness = settings.relaxing_ratio * shear;
        model.normal_maxwell_time = model.shear_maxwell_time = settings.relaxation_time;
    }
    if (settings.felt_viscosity > 0) {
        model.solvent_viscosity = settings.felt_viscosity;
    }
    const double tension = settings.tension * normal * 2 * radius;
    if (const double critical = std::min(settings.critical_strain, settings.rim_critical_strain); std::isfinite(critical)) {
        model.shear_strength = critical * normal * radius;
        model.normal_strength = model.shear_strength + tension;  // it is counted from the load at rest
    }
    if (tension > 0) {
        model.prestress = -tension;
    }
    if (settings.contact_preload > 0) {
        // Two equal spheres: the contact's stiffness is 2 E* sqrt(r0 / 2 x overlap), E* = E / (2 (1 - nu^2)).
        const double overlap = settings.contact_preload * radius;
        model.poisson_ratio = particle_poisson_ratio;
        model.young_modulus = (1 - std::pow(particle_poisson_ratio, 2)) * normal / std::sqrt(0.5 * radius * overlap);
    }
    return model;
}

}  // namespace coagula::diagnose
