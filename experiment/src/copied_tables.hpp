// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that are one measurement twice.
#pragma once

#include <coagula/diagnose/measurement.hpp>

namespace coagula::experiment {

enum class Likeness { none, same_numbers, rounded };

/// Whether one table repeats the other: the same numbers, or the same but for the rounding of the one with fewer digits in every
/// response that both have. Numbers of less than about two and a half digits agree by chance and do not count as rounded ones.
Likeness likeness(const diagnose::Measurement& one, const diagnose::Measurement& other);

}  // namespace coagula::experiment
