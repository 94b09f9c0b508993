// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/model.hpp>

#include <algorithm>

namespace coagula::diagnose {

std::string name_of(const Hypothesis& hypothesis) {
    std::string name;
    for (const Mechanism* mechanism : hypothesis) {
        name += (name.empty() ? "" : " + ") + mechanism->name;
    }
    return name.empty() ? "base" : name;
}

std::vector<MechanismParameter> parameters_of(const Hypothesis& hypothesis) {
    std::vector<MechanismParameter> all;
    for (const Mechanism* mechanism : hypothesis) {
        all.insert(all.end(), mechanism->parameters.begin(), mechanism->parameters.end());
    }
    return all;
}

Model::Model(const Hypothesis& hypothesis, Values values, double normal_stiffness) {
    settings.normal_stiffness = normal_stiffness;
    for (const Mechanism* mechanism : hypothesis) {
        const Values own = values.first(mechanism->parameters.size());
        acting.push_back({mechanism, {own.begin(), own.end()}});
        values = values.subspan(own.size());
    }
    std::sort(acting.begin(), acting.end(),
              [](const ActingMechanism& one, const ActingMechanism& other) { return one.mechanism < other.mechanism; });
}

Settings Model::simulated() const {
    Settings run = settings;
    for_each<ChangesSimulation>([&](const ChangesSimulation& effect, Values values) { effect.set(run, values); });
    return run;
}

ContactModel contact_model_of(const Model& model, double radius) {
    ContactModel contact = contact_model_of(model.simulated(), radius);
    for (const ActingMechanism& one : model.acting) {
        if (one.mechanism->contact != nullptr) {
            one.mechanism->contact(contact, one.values);
        }
    }
    return contact;
}

}  // namespace coagula::diagnose
