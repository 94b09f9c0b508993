// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the verdict in words.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>

#include <string>
#include <vector>

namespace coagula::report {

/// "p = 0.3", or "p ≤ 0.001" where no data set drawn from the base model had as large a misfit.
std::string chance_text(const diagnose::Diagnosis& found);

/// "a, b or c". @param last between the last two.
std::string joined(const std::vector<std::string>& names, const std::string& last = " or ");

/// "the time since the sample was loaded", "the sample 'B'".
std::string axis_in_words(const diagnose::Follows& follows);

/// Whether the data leave a parameter open by a factor of ten or more: its most probable value then hangs on rounding errors.
bool leaves_open(const diagnose::EstimatedParameter& parameter);

/// Says what the deviation follows, whatever its cause, and which causes are of that kind.
std::string follows_sentence(const diagnose::Diagnosis& found);

}  // namespace coagula::report
