// SPDX-License-Identifier: GPL-3.0-or-later
// The base model with some mechanisms at work: what a prediction is made from.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/diagnose/mechanism.hpp>
#include <coagula/diagnose/settings.hpp>

#include <string>
#include <vector>

namespace coagula::diagnose {

/// The base model with these mechanisms.
using Hypothesis = std::vector<const Mechanism*>;

/// "base", "ageing", "ageing + wall-slip".
std::string name_of(const Hypothesis& hypothesis);

/// All parameters of the mechanisms, in their order.
std::vector<MechanismParameter> parameters_of(const Hypothesis& hypothesis);

/// A mechanism with the values of its parameters.
struct ActingMechanism {
    const Mechanism* mechanism;
    std::vector<double> values;

    bool operator==(const ActingMechanism&) const = default;
};

struct Model {
    Settings settings = {};  ///< of the simulation without the mechanisms
    std::vector<ActingMechanism> acting = {};

    Model() = default;
    Model(const Settings& simulated) : settings(simulated) {}  // NOLINT(google-explicit-constructor): a model without mechanisms
    /// @param values of all parameters of the hypothesis, in their order.
    Model(const Hypothesis& hypothesis, Values values, double normal_stiffness = Settings{}.normal_stiffness);

    /// Settings of the simulation.
    Settings simulated() const;

    /// Calls f(effect, values) for each acting mechanism that changes this link, in the order of the catalogue.
    template <class Link, class Function>
    void for_each(const Function& f) const {
        for (const ActingMechanism& one : acting) {
            if (const auto* effect = std::get_if<Link>(&one.mechanism->effect)) {
                f(*effect, Values(one.values));
            }
        }
    }
};

/// Contact model of the simulation with those terms of the mechanisms that a contact can have.
/// @param radius mean radius of the particles [m].
ContactModel contact_model_of(const Model& model, double radius);

}  // namespace coagula::diagnose
