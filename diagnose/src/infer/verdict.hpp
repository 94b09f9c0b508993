// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict, on two levels: which kind of departure is certain, then which cause. All that it is made of is here: posteriors of
// the causes, the kinds of departure, the conditions of a name.
#pragma once

#include "attribution.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// A fit as what a diagnosis tells of it.
Cause cause_of(const Fit& fit, const Inference& inference);

/// Fills in what the winner leaves over, the causes by their probability, the credible set, what the data follow and which
/// conditions of a name hold; the verdict follows from these. The gain has been measured.
void judge(const Comparison& comparison, const Inference& inference, const Hypothesis& possible, const DiagnosisOptions& options,
           Diagnosis& diagnosis);

}  // namespace coagula::diagnose
