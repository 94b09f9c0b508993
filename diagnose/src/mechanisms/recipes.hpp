// SPDX-License-Identifier: GPL-3.0-or-later
// Recipes whose structures can be made again with something changed.
#pragma once

#include "data/knows.hpp"

#include <cmath>

namespace coagula::diagnose::mechanisms {

/// The volume fraction that is stated lies between these.
inline bool states_volume_fraction(const Knows& knows, double lowest, double highest) {
    const double stated = knows.experiment.sample.volume_fraction;
    return stated >= lowest && stated <= highest;
}

inline bool sees_void_expansion(const Knows& knows) {
    return knows.recipe && knows.experiment.recipe->generator == "vem";
}

/// A coordination that the generators come to at most volume fractions.
inline bool has_usual_coordination(const StructureRecipe& recipe) {
    return std::isnan(recipe.target_coordination) || (recipe.target_coordination >= 4.5 && recipe.target_coordination <= 4.9);
}

/// Whether the voids are an eighth to a half of the particles: with more, loose packings do not come to their coordination.
inline bool has_few_voids(const StructureRecipe& recipe) {
    return recipe.voids == 0 || (8 * recipe.voids >= recipe.particles && 2 * recipe.voids <= recipe.particles);
}

}  // namespace coagula::diagnose::mechanisms
