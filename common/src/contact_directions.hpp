// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of the contact model by direction: normal and shear.
#pragma once

#include <coagula/common/contact_model.hpp>

#include <cmath>

namespace coagula {

using Parameter = double ContactModel::*;

/// The parameters of one direction.
struct Direction {
    Parameter stiffness;
    Parameter viscosity;
    Parameter maxwell_stiffness;
    Parameter maxwell_time;
    Parameter springpot_stiffness;
    Parameter springpot_time;
    Parameter springpot_exponent;
};

inline constexpr Direction normal_direction{&ContactModel::normal_stiffness,           &ContactModel::normal_viscosity,
                                            &ContactModel::normal_maxwell_stiffness,   &ContactModel::normal_maxwell_time,
                                            &ContactModel::normal_springpot_stiffness, &ContactModel::normal_springpot_time,
                                            &ContactModel::normal_springpot_exponent};
inline constexpr Direction shear_direction{&ContactModel::shear_stiffness,           &ContactModel::shear_viscosity,
                                           &ContactModel::shear_maxwell_stiffness,   &ContactModel::shear_maxwell_time,
                                           &ContactModel::shear_springpot_stiffness, &ContactModel::shear_springpot_time,
                                           &ContactModel::shear_springpot_exponent};

inline bool has(const ContactModel& model, Parameter parameter) {
    return !std::isnan(model.*parameter);
}

}  // namespace coagula
