// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences say where the base model fails, what a cause leaves over and what to measure next.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>

#include <string>

namespace coagula::report {

/// "G' falls relative to the base model along strain: mean difference -2 % before and -30 % from 1 % on".
std::string sentence_on(const diagnose::Misfit& misfit);

/// "G'' lies above the model by up to 9 % of |G*|, at angular frequency 1 rad/s to 10 rad/s"; empty where nothing is left over.
std::string sentence_on(const diagnose::Remainder& remainder);

/// "an amplitude sweep on a fresh sample at a quarter of the gap (0.25 mm)".
/// Throws std::out_of_range when no measurement has this key.
std::string words_for(const diagnose::Proposal& proposal);

}  // namespace coagula::report
