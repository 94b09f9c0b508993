// SPDX-License-Identifier: GPL-3.0-or-later
// Structures by the recipe of an experiment file: what `coagula generate` makes with the same words.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/structure_source.hpp>

#include <string>

namespace coagula::experiment {

/// The call of `coagula generate` that makes a structure of the recipe with a change, without its output.
std::string generation_call(const diagnose::StructureRecipe& recipe, const diagnose::Sample& sample, std::size_t seed,
                            const diagnose::StructureChange& change = {});

/// What needs no simulation, of a recipe with seeds. Throws InputError when sample or recipe lack something, or no structure can be
/// made of them.
void check_recipe(const diagnose::StructureRecipe& recipe, const diagnose::Sample& sample);

/// Makes one. Throws InputError when sample or recipe lack something, or when nothing coagulates.
Packing generate_structure(const diagnose::StructureRecipe& recipe, const diagnose::Sample& sample, std::size_t seed,
                           const diagnose::StructureChange& change, const Progress& progress);

}  // namespace coagula::experiment
