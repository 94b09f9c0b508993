// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"
#include "recipes.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double quick_potential = 0.012;  // V: above it coagulation takes minutes

/// Void expansion reaches its coordination from a volume fraction of 0.3 on, and has more contacts before any void has grown from
/// 0.53 on.
bool can_be_diluted(const Knows& knows) {
    return knows.recipe && states_volume_fraction(knows, 0.355, 0.455) && has_usual_coordination(*knows.experiment.recipe) &&
           (sees_void_expansion(knows) ? has_few_voids(*knows.experiment.recipe)
                                       : knows.experiment.recipe->surface_potential <= quick_potential);
}

}  // namespace

/// A sample that lost solvent when it was filled, or particles when it was weighed.
Mechanism volume_fraction() {
    return {
        .name = "volume-fraction",
        .term =
            "the volume fraction of the sample differs from the stated one; the simulated structures are "
            "generated with that of the sample",
        .signature =
            "The pores and the number of neighbours at all distances follow the volume fraction, while the "
            "contacts do not. All moduli are higher or lower by one factor.",
        .kind = {Link::structure, Axis::volume_fraction},
        .parameters = {{"volume_fraction_over_stated", "1", 0.85, 1.15, false}},
        .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.structures.volume_fraction = values[0] - 1; }},
        .applies = can_be_diluted};
}

}  // namespace coagula::diagnose::mechanisms
