// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coagula/diagnose/diagnosis.hpp>

#include <algorithm>
#include <string>

namespace coagula::diagnose {

inline bool in_set(const Diagnosis& found, const std::string& name) {
    return std::any_of(found.credible_set.begin(), found.credible_set.end(),
                       [&](const CauseSet& set) { return name_of(set) == name; });
}

/// The conditions of a name that do not hold, with their values.
inline std::string missing_to_a_name(const Diagnosis& found) {
    std::string text;
    for (const Condition& one : found.conditions) {
        text += one.holds ? "" : one.name + " " + std::to_string(one.value) + " (limit " + std::to_string(one.limit) + ") ";
    }
    return text;
}

}  // namespace coagula::diagnose
