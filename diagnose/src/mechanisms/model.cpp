// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/model.hpp>

#include <algorithm>

namespace coagula::diagnose {

CauseSet::CauseSet(const Hypothesis& hypothesis) {
    for (const Mechanism* mechanism : hypothesis) {
        members.push_back(static_cast<std::size_t>(mechanism - catalogue().data()));
    }
}

CauseSet CauseSet::none_of_catalogue() {
    CauseSet set;
    set.unknown = true;
    return set;
}

bool CauseSet::has_more_than(const CauseSet& other) const {
    return !other.members.empty() && other.members.size() < members.size() &&
           std::all_of(other.members.begin(), other.members.end(), [&](std::size_t member) { return contains(member); });
}

CauseSet CauseSet::without(const CauseSet& other) const {
    CauseSet rest = *this;
    std::erase_if(rest.members, [&](std::size_t member) { return other.contains(member); });
    return rest;
}

std::vector<std::string> names_in(const CauseSet& set) {
    std::vector<std::string> names;
    for (const std::size_t member : set.members) {
        names.push_back(catalogue()[member].name);
    }
    return names;
}

std::string name_of(const CauseSet& set) {
    std::string name;
    for (const std::string& member : names_in(set)) {
        name += (name.empty() ? "" : " + ") + member;
    }
    return set.unknown ? "none of the catalogue" : name.empty() ? "base" : name;
}

std::vector<std::string> names_of(const std::vector<CauseSet>& sets) {
    std::vector<std::string> names(sets.size());
    std::transform(sets.begin(), sets.end(), names.begin(), [](const CauseSet& set) { return name_of(set); });
    return names;
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
