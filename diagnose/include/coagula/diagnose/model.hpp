// SPDX-License-Identifier: GPL-3.0-or-later
// The base model with some mechanisms at work: what a prediction is made from.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/diagnose/mechanism.hpp>
#include <coagula/diagnose/settings.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// The base model with these mechanisms.
using Hypothesis = std::vector<const Mechanism*>;

/// Such sets are compared: causes of the catalogue, of which the base model has none, or a cause that the catalogue does not have.
struct CauseSet {
    std::vector<std::size_t> members = {};  ///< places in the catalogue
    bool unknown = false;                   ///< no cause of the catalogue

    CauseSet() = default;
    CauseSet(const Hypothesis& hypothesis);  // NOLINT(google-explicit-constructor): the same set
    static CauseSet none_of_catalogue();

    bool operator==(const CauseSet&) const = default;
    bool is_base() const { return members.empty() && !unknown; }
    bool contains(std::size_t member) const { return std::find(members.begin(), members.end(), member) != members.end(); }
    /// Whether all causes of the other one, some, and more are in this.
    bool has_more_than(const CauseSet& other) const;
    CauseSet without(const CauseSet& other) const;
};

/// The name of each member.
std::vector<std::string> names_in(const CauseSet& set);
/// "base", "ageing", "ageing + wall-slip", "none of the catalogue".
std::string name_of(const CauseSet& set);
std::vector<std::string> names_of(const std::vector<CauseSet>& sets);

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

    /// Whether a mechanism that changes this link acts.
    template <class Link>
    bool has() const {
        return std::any_of(acting.begin(), acting.end(),
                           [](const ActingMechanism& one) { return std::holds_alternative<Link>(one.mechanism->effect); });
    }

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
