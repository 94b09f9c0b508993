// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_tangents.hpp"

#include <coagula/mechanics/linear.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace coagula::mechanics {

namespace {

using Tangents = std::vector<ContactTangent>;

/// Sum of weight * tangents, bond by bond.
Tangents combined(double first_weight, const Tangents& first, double second_weight, const Tangents& second) {
    Tangents sum(first.size());
    for (std::size_t bond = 0; bond < sum.size(); ++bond) {
        const ContactTangent& a = first[bond];
        const ContactTangent& b = second[bond];
        sum[bond] = {first_weight * a.normal + second_weight * b.normal, first_weight * a.shear + second_weight * b.shear,
                     first_weight * a.bending + second_weight * b.bending, first_weight * a.twisting + second_weight * b.twisting,
                     first_weight * a.tension + second_weight * b.tension};
    }
    return sum;
}

/// Small beside the parameter, or, for a prestress of zero, beside the forces that the contact can bear.
double difference_step(const Packing& packing, const ContactModel& model, double value) {
    constexpr double relative = 1e-4;
    if (value != 0) {
        return relative * std::abs(value);
    }
    const double adhesive = model.work_of_adhesion * mean_radius(packing);
    return relative * (std::isnan(adhesive) ? 1e-3 * model.normal_stiffness * mean_radius(packing) : adhesive);
}

}  // namespace

void check_tangents(const ContactNetwork& bonds, const Tangents& tangents) {
    require(tangents.size() == static_cast<std::size_t>(bonds.size()), "the stiffnesses of the bonds must be one per bond");
    for (std::size_t bond = 0; bond < tangents.size(); ++bond) {
        const ContactTangent& k = tangents[bond];
        const std::string name = "bond " + std::to_string(bond);
        require(std::isfinite(k.normal) && std::isfinite(k.tension) && k.shear >= 0 && k.bending >= 0 && k.twisting >= 0,
                name + " has an impossible stiffness");
        require(k.normal != 0, name + " has no normal stiffness: a contact by Hertz's law needs prestress or adhesion");
    }
}

ContactTangent mean_tangent(std::span<const ContactTangent> tangents) {
    if (tangents.empty()) {
        return {};
    }
    ContactTangent beyond_first;
    for (const ContactTangent& k : tangents) {
        beyond_first.normal += k.normal - tangents.front().normal;
        beyond_first.shear += k.shear - tangents.front().shear;
    }
    const auto count = static_cast<double>(tangents.size());
    return {.normal = tangents.front().normal + beyond_first.normal / count,
            .shear = tangents.front().shear + beyond_first.shear / count};
}

bool resist_moments(const Tangents& tangents) {
    return std::any_of(tangents.begin(), tangents.end(), [](const auto& k) { return k.bending > 0 || k.twisting > 0; });
}

bool may_be_unstable(const Tangents& tangents) {
    return std::any_of(tangents.begin(), tangents.end(), [](const auto& k) { return k.normal < 0 || k.tension < 0; });
}

std::vector<ContactTangent> bond_tangents(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model) {
    ContactModel springs = model;  // without the losses, of which the time-domain law does not know all
    springs.normal_springpot_stiffness = springs.shear_springpot_stiffness = unset;
    springs.normal_springpot_time = springs.shear_springpot_time = unset;
    springs.normal_springpot_exponent = springs.shear_springpot_exponent = unset;
    coagula::check(model);
    const GeneralContact law(springs);
    std::vector<ContactTangent> tangents;
    tangents.reserve(static_cast<std::size_t>(bonds.size()));
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const Eigen::Vector3d branch = bonds.branch.col(bond);
        const double first = packing.radii[bonds.ends(0, bond)];
        const double second = packing.radii[bonds.ends(1, bond)];
        tangents.push_back(law.tangent(law.make_bond(branch, first, second, branch.norm()), first, second));
    }
    return tangents;
}

Tangents tangent_derivatives(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                             const ContactParameter& parameter) {
    using Model = ContactModel;
    const auto alike = [&](const ContactTangent& tangent) { return Tangents(static_cast<std::size_t>(bonds.size()), tangent); };
    const double of_linear_spring = std::isnan(model.young_modulus) ? 0.5 : 0.0;  // two in series
    if (parameter.value == &Model::normal_stiffness) {
        return alike({.normal = of_linear_spring});
    }
    if (parameter.value == &Model::shear_stiffness) {
        return alike({.shear = of_linear_spring});
    }
    if (parameter.value == &Model::bending_stiffness) {
        return alike({.bending = 1});
    }
    if (parameter.value == &Model::twisting_stiffness) {
        return alike({.twisting = 1});
    }
    const double value = model.*parameter.value;
    const auto at = [&](double other) {
        Model changed = model;
        changed.*parameter.value = other;
        return bond_tangents(packing, bonds, changed);
    };
    double step = parameter.value == &Model::poisson_ratio ? 1e-5 : difference_step(packing, model, value);
    if (value - step >= parameter.low && value + step <= parameter.high) {
        return combined(0.5 / step, at(value + step), -0.5 / step, at(value - step));
    }
    step *= value + 2 * step <= parameter.high ? 1 : -1;
    const Tangents near = combined(2 / step, at(value + step), -1.5 / step, at(value));
    return combined(1, near, -0.5 / step, at(value + 2 * step));
}

}  // namespace coagula::mechanics
