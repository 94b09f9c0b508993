// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coagula/diagnose/diagnosis.hpp>

#include <algorithm>
#include <string>

namespace coagula::diagnose {

inline bool in_set(const Diagnosis& found, const std::string& name) {
    return std::find(found.credible_set.begin(), found.credible_set.end(), name) != found.credible_set.end();
}

}  // namespace coagula::diagnose
