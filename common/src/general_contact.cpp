// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/general_contact.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_law.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

double or_zero(double value) {
    return std::isnan(value) ? 0.0 : value;
}

double effective(double first_radius, double second_radius) {
    return first_radius * second_radius / (first_radius + second_radius);
}

Vector3d along(const Vector3d& vector, const Vector3d& normal) {
    return vector.dot(normal) * normal;
}

/// Relaxes the displacement of a Maxwell spring that grew by `increment`, included in `held`, within `duration`.
Vector3d relaxed(const Vector3d& held, const Vector3d& increment, double duration, double time) {
    const double lost = -std::expm1(-duration / time);
    return (1 - lost) * (held - increment) + (time / duration) * lost * increment;
}

}  // namespace

/// Johnson, Kendall and Roberts 1971 in terms of the contact radius a: overlap a^2/R - sqrt(2 pi W a / E), force 4/3 E a^3/R -
/// sqrt(8 pi W E a^3).
struct GeneralContact::Jkr {
    double modulus;
    double radius;
    double adhesion;

    double slope() const { return std::sqrt(2 * pi * adhesion / modulus); }
    double overlap(double a) const { return a * a / radius - slope() * std::sqrt(a); }
    double force(double a) const { return 4.0 / 3 * modulus * a * a * a / radius - 2 * modulus * slope() * a * std::sqrt(a); }
    double overlap_rate(double a) const { return 2 * a / radius - 0.5 * slope() / std::sqrt(a); }
    double force_rate(double a) const { return 4 * modulus * a * a / radius - 3 * modulus * slope() * std::sqrt(a); }
    /// Integral of force d overlap from a = 0.
    double energy(double a) const {
        const double q = slope();
        return modulus *
               (8.0 / 15 * std::pow(a, 5) / (radius * radius) - 4.0 / 3 * q / radius * std::pow(a, 3.5) + 0.5 * q * q * a * a);
    }
    /// Contact radius without force.
    double rest() const { return std::cbrt(4.5 * pi * adhesion * radius * radius / modulus); }
    /// Contact radius at which the law ends when the distance is controlled.
    double end() const { return std::cbrt(pi * adhesion * radius * radius / (8 * modulus)); }
    double contact_radius(double wanted) const {
        // The overlap is convex in a, and the start lies beyond the root: Newton's steps come down to it.
        double a = std::sqrt(radius * std::max(wanted, 0.0)) + rest();
        for (int iteration = 0; iteration < 100; ++iteration) {
            const double change = (overlap(a) - wanted) / overlap_rate(a);
            a = std::max(a - change, end());
            if (std::abs(change) < 1e-15 * a) {
                break;
            }
        }
        return a;
    }
    double contact_radius_under(double force) const {
        const double pull = 3 * pi * adhesion * radius;
        const double root = std::sqrt(std::max(0.0, pull * (2 * force + pull)));
        return std::cbrt(0.75 * radius / modulus * (force + pull + root));
    }
};

GeneralContact::GeneralContact(const ContactModel& model) : model_(model) {
    check(model);
    require(std::isnan(model.normal_springpot_stiffness) && std::isnan(model.shear_springpot_stiffness),
            "the contact model has a springpot, whose force depends on its whole past: it acts at a frequency only");
    normal_stiffness_ = stiffness_in_series(model.normal_stiffness, model.normal_stiffness);
    shear_stiffness_ = stiffness_in_series(model.shear_stiffness, model.shear_stiffness);
    adhesion_ = or_zero(model.work_of_adhesion);
    if (!std::isnan(model.young_modulus)) {
        // Two bodies of the same material: E* = E / (2 (1 - nu^2)), G* = G / (2 (2 - nu)), G = E / (2 (1 + nu)).
        const double nu = model.poisson_ratio;
        contact_modulus_ = model.young_modulus / (2 * (1 - nu * nu));
        shear_modulus_ = model.young_modulus / (4 * (1 + nu) * (2 - nu));
    }
}

void GeneralContact::set_age_factor(double factor) {
    age_ = require_positive(factor, "the factor of ageing");
}

double GeneralContact::overlap_under(double force, double effective_radius, bool bonded) const {
    const double fresh = force / age_;
    if (!is_hertzian()) {
        return fresh / normal_stiffness_;
    }
    if (adhesion_ == 0 || !bonded) {
        const double stiffness = 4.0 / 3 * contact_modulus_ * std::sqrt(effective_radius);
        return std::copysign(std::pow(std::abs(fresh) / stiffness, 2.0 / 3), fresh);
    }
    const Jkr law{contact_modulus_, effective_radius, adhesion_};
    return law.overlap(law.contact_radius_under(fresh)) - law.overlap(law.rest());
}

ContactMemory GeneralContact::make_bond(const Vector3d& branch, double first_radius, double second_radius,
                                        double unstressed_distance) const {
    ContactMemory memory;
    const double radius = effective(first_radius, second_radius);
    const double prestress = or_zero(model_.prestress);
    require(adhesion_ == 0 || -prestress < 1.5 * pi * adhesion_ * radius,
            "prestress of the contact model is " + to_text(prestress) + " N: adhesion bears a tension of " +
                to_text(1.5 * pi * adhesion_ * radius) + " N between these particles, 3/2 pi W R");
    memory.branch = branch;
    memory.rest_length = unstressed_distance + overlap_under(prestress, radius, true);
    memory.shear_stiffness = normal(memory.rest_length - branch.norm(), radius, true).shear_stiffness;
    return memory;
}

ContactMemory GeneralContact::make_contact(const Vector3d& branch, double first_radius, double second_radius) const {
    ContactMemory memory;
    memory.branch = branch;
    memory.bonded = false;
    memory.rest_length = first_radius + second_radius;
    memory.shear_stiffness =
        normal(memory.rest_length - branch.norm(), effective(first_radius, second_radius), false).shear_stiffness;
    return memory;
}

NormalResponse GeneralContact::hertz(double overlap, double effective_radius) const {
    const double depth = std::abs(overlap);
    const double contact_radius = std::sqrt(effective_radius * depth);
    const double stiffness = 2 * contact_modulus_ * contact_radius;
    return {2.0 / 3 * stiffness * overlap, stiffness, 4.0 / 15 * stiffness * depth * depth, 8 * shear_modulus_ * contact_radius};
}

NormalResponse GeneralContact::jkr(double overlap, double effective_radius) const {
    const Jkr law{contact_modulus_, effective_radius, adhesion_};
    const double total = overlap + law.overlap(law.rest());
    const double beyond = total - law.overlap(law.end());
    if (beyond <= 0) {  // where the bond is to be broken; until then the force stays
        const double force = law.force(law.end());
        return {force, 0, law.energy(law.end()) + force * beyond - law.energy(law.rest()), 8 * shear_modulus_ * law.end()};
    }
    const double a = law.contact_radius(total);
    return {law.force(a), law.force_rate(a) / law.overlap_rate(a), law.energy(a) - law.energy(law.rest()), 8 * shear_modulus_ * a};
}

NormalResponse GeneralContact::normal(double overlap, double effective_radius, bool bonded) const {
    NormalResponse response;
    if (!bonded && overlap <= 0) {
        return response;
    }
    if (!is_hertzian()) {
        response = {normal_stiffness_ * overlap, normal_stiffness_, 0.5 * normal_stiffness_ * overlap * overlap, shear_stiffness_};
    } else {
        response = bonded && adhesion_ > 0 ? jkr(overlap, effective_radius) : hertz(overlap, effective_radius);
    }
    response.force *= age_;
    response.stiffness *= age_;
    response.energy *= age_;
    response.shear_stiffness *= age_;
    return response;
}

void GeneralContact::follow_stiffness(ContactMemory& memory, double now) {
    if (now > memory.shear_stiffness) {
        memory.shear *= memory.shear_stiffness / now;
    }
    memory.shear_stiffness = now;
}

void GeneralContact::limit_shear(ContactMemory& memory, double limit) {
    const double trial = memory.shear_stiffness * memory.shear.norm();
    if (trial > limit) {
        memory.shear *= limit / trial;
    }
}

Vector3d GeneralContact::losses(ContactMemory& memory, const ContactIncrement& increment, double duration,
                                double& dissipated) const {
    const Vector3d normal_part = along(increment.displacement, increment.normal);
    const Vector3d shear_part = increment.displacement - normal_part;
    const Vector3d dashpot =
        (or_zero(model_.normal_viscosity) * normal_part + or_zero(model_.shear_viscosity) * shear_part) / duration;
    // The work of the dashpot is summed by the trapezoidal rule, as central differences do work.
    dissipated += 0.5 * (memory.dashpot + dashpot).dot(increment.displacement);
    memory.dashpot = dashpot;

    Vector3d maxwell = Vector3d::Zero();
    Vector3d held = Vector3d::Zero();
    const auto add = [&](const Vector3d& all, const Vector3d& grown, double stiffness, double time) {
        if (!std::isnan(stiffness)) {
            const Vector3d kept = relaxed(all, grown, duration, time);
            dissipated += 0.5 * stiffness * (kept + all - grown).dot(all - kept);
            maxwell += stiffness * kept;
            held += kept;
        }
    };
    const Vector3d normal_held = along(memory.maxwell, increment.normal);
    add(normal_held, normal_part, model_.normal_maxwell_stiffness, model_.normal_maxwell_time);
    add(memory.maxwell - normal_held, shear_part, model_.shear_maxwell_stiffness, model_.shear_maxwell_time);
    memory.maxwell = held;
    return dashpot + maxwell;
}

ContactForce GeneralContact::update(ContactMemory& memory, const PairMotion& motion, double duration) const {
    const ContactIncrement increment = advance(memory, motion);
    const double stiffness_before = memory.shear_stiffness;
    const Vector3d shear_before = memory.shear - increment.shear_growth;
    const Vector3d trial = memory.shear;
    const NormalResponse response =
        normal(memory.rest_length - increment.distance, effective(motion.first_radius, motion.second_radius), memory.bonded);
    ContactForce result;
    follow_stiffness(memory, response.shear_stiffness);
    if (!memory.bonded) {
        limit_shear(memory, or_zero(model_.friction) * response.force);
        memory.bend.setZero();
    }
    const Vector3d shear_force = memory.shear_stiffness * memory.shear;
    if (memory.shear != trial || memory.shear_stiffness != stiffness_before) {
        // What the shear spring took in, by the trapezium rule, less what it has stored.
        const Vector3d force_before = stiffness_before * shear_before;
        result.dissipated = 0.5 * (force_before + shear_force).dot(increment.shear_growth) -
                            0.5 * (shear_force.dot(memory.shear) - force_before.dot(shear_before));
    }
    result.force = shear_force - response.force * increment.normal;
    if (duration > 0) {
        result.force += losses(memory, increment, duration, result.dissipated);
    } else {
        memory.maxwell.setZero();
    }
    const Vector3d twist = along(memory.bend, increment.normal);
    result.moment = age_ * (or_zero(model_.bending_stiffness) * (memory.bend - twist) + or_zero(model_.twisting_stiffness) * twist);
    return result;
}

double GeneralContact::energy(const ContactMemory& memory, double first_radius, double second_radius) const {
    const double distance = memory.branch.norm();
    const Vector3d direction = memory.branch / distance;
    const Vector3d twist = along(memory.bend, direction);
    const Vector3d held = along(memory.maxwell, direction);
    double energy = normal(memory.rest_length - distance, effective(first_radius, second_radius), memory.bonded).energy;
    energy += 0.5 * memory.shear_stiffness * memory.shear.squaredNorm();
    energy += 0.5 * age_ * or_zero(model_.bending_stiffness) * (memory.bend - twist).squaredNorm();
    energy += 0.5 * age_ * or_zero(model_.twisting_stiffness) * twist.squaredNorm();
    energy += 0.5 * or_zero(model_.normal_maxwell_stiffness) * held.squaredNorm();
    energy += 0.5 * or_zero(model_.shear_maxwell_stiffness) * (memory.maxwell - held).squaredNorm();
    return energy;
}

ContactTangent GeneralContact::tangent(const ContactMemory& memory, double first_radius, double second_radius) const {
    const double distance = memory.branch.norm();
    const NormalResponse response = normal(memory.rest_length - distance, effective(first_radius, second_radius), memory.bonded);
    const double moment = memory.bonded ? age_ : 0.0;
    return {response.stiffness, response.shear_stiffness, moment * or_zero(model_.bending_stiffness),
            moment * or_zero(model_.twisting_stiffness), -response.force / distance};
}

BondLoad GeneralContact::load(const ContactMemory& memory, double first_radius, double second_radius) const {
    BondLoad load;
    if (!memory.bonded) {
        return load;
    }
    const auto compare = [&load](double ratio, BreakageCause limit) {
        if (ratio > load.ratio) {
            load = {ratio, limit};
        }
    };
    const double distance = memory.branch.norm();
    const double radius = effective(first_radius, second_radius);
    const double overlap = memory.rest_length - distance;
    if (adhesion_ > 0 && overlap < 0) {
        const Jkr law{contact_modulus_, radius, adhesion_};
        compare(overlap / (law.overlap(law.end()) - law.overlap(law.rest())), BreakageCause::pull_off);
    }
    if (!std::isnan(model_.normal_strength)) {
        compare(-normal(overlap, radius, true).force / model_.normal_strength, BreakageCause::normal);
    }
    if (!std::isnan(model_.shear_strength)) {
        compare(memory.shear_stiffness * memory.shear.norm() / model_.shear_strength, BreakageCause::shear);
    }
    if (!std::isnan(model_.bending_strength)) {
        const Vector3d twist = along(memory.bend, memory.branch / distance);
        const double bending = or_zero(model_.bending_stiffness) * (memory.bend - twist).norm();
        const double twisting = or_zero(model_.twisting_stiffness) * twist.norm();
        compare(age_ * std::max(bending, twisting) / model_.bending_strength, BreakageCause::bending);
    }
    return load;
}

double GeneralContact::break_bond(ContactMemory& memory, double first_radius, double second_radius) const {
    const double before = energy(memory, first_radius, second_radius);
    memory.bonded = false;
    memory.bend.setZero();
    memory.maxwell.setZero();
    const NormalResponse response =
        normal(memory.rest_length - memory.branch.norm(), effective(first_radius, second_radius), false);
    follow_stiffness(memory, response.shear_stiffness);
    limit_shear(memory, or_zero(model_.friction) * response.force);
    return before - energy(memory, first_radius, second_radius);
}

double GeneralContact::reage(ContactMemory& memory, double before, double first_radius, double second_radius) const {
    GeneralContact earlier = *this;
    earlier.set_age_factor(before);
    const double energy_before = earlier.energy(memory, first_radius, second_radius);
    const double radius = effective(first_radius, second_radius);
    const double distance = memory.branch.norm();
    const double force = earlier.normal(memory.rest_length - distance, radius, memory.bonded).force;
    if (memory.bonded || force > 0) {
        memory.rest_length = distance + overlap_under(force, radius, memory.bonded);
    }
    const double now = normal(memory.rest_length - distance, radius, memory.bonded).shear_stiffness;
    memory.shear *= now > 0 ? memory.shear_stiffness / now : 0.0;
    memory.shear_stiffness = now;
    memory.bend *= before / age_;
    return energy_before - energy(memory, first_radius, second_radius);
}

bool GeneralContact::touches(const ContactMemory& memory, double first_radius, double second_radius) {
    return memory.bonded || memory.branch.norm() < std::max(memory.rest_length, first_radius + second_radius);
}

}  // namespace coagula
