// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of departure: which link of the chain, along which axis, by causes and free forms together.
#pragma once

#include "attribution.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Weight of a single cause among those that were compared; minus infinity where it was not.
double weight_alone(const Mechanism* one, const std::vector<Compared>& all);

/// The member of a pair that explains more alone.
const Mechanism* leading_member(const Hypothesis& hypothesis, const std::vector<Compared>& all);

/// Whether the experiment holds what tells causes of this kind from their look-alikes, also from those that the catalogue does not
/// have: an oil shows a wrong level, what the clock does alone does not depend on gap, plates, trap or force, and begins anew after
/// a pause that shears. Nothing tells a loss in the contacts from a phase that the tool turns, as of an oil G'' alone is compared.
bool is_separated(Kind kind, const Experiment& experiment);

/// The same of a cause, of which more may be needed.
bool is_separated(const Mechanism& cause, const Experiment& experiment);

/// The kinds of departure, most probable first: by the causes of each, without what they leave over, and by its free form, which
/// counts as much as a cause. Where no cause fits, what was set in such an order that it runs with the time in all rows is as
/// probable as that: any function of one is a function of the other, and time passes beside whatever is set.
std::vector<FollowedKind> kinds_of(const Comparison& comparison, const Inference& inference, bool cause_fits);

/// The most probable kind, with what its free form at the base model says of it.
Follows follows_of(const std::vector<FollowedKind>& kinds, const Comparison& comparison, const Inference& inference);

}  // namespace coagula::diagnose
