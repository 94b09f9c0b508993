#include "structure_recipe.hpp"

#include "cli/verbs.hpp"
#include "verbs/generate.hpp"

#include <coagula/common/checks.hpp>

#include <cmath>
#include <vector>

namespace coagula::tools {

namespace {

using diagnose::Sample;
using diagnose::StructureChange;
using diagnose::StructureRecipe;

constexpr double usual_coordination = 4.69;  ///< where coagulation stops, as void expansion does

double needed(double value, const std::string& key, const std::string& generator) {
    if (std::isnan(value)) {
        throw InputError("structures by '" + generator + "' need " + key);
    }
    return value;
}

/// What follows `coagula generate vem` or `coagula generate brownian`. The viscosity is not in it: it sets how long coagulation
/// takes, not what comes of it.
std::vector<std::string> words_of(const StructureRecipe& recipe, const Sample& sample, std::size_t seed,
                                  const StructureChange& change) {
    const bool coagulates = recipe.generator == "brownian";
    std::vector<std::string> words;
    const auto add = [&](const std::string& option, const std::string& value) {
        words.insert(words.end(), {"--" + option, value});
    };
    const auto add_needed = [&](const std::string& option, double value, const std::string& key) {
        add(option, to_text(needed(value, key, recipe.generator)));
    };
    add("particles", std::to_string(recipe.particles));
    if (recipe.voids > 0) {
        add("voids", std::to_string(recipe.voids));
    }
    add_needed("volume-fraction", sample.volume_fraction, "sample.volume_fraction");
    add_needed("radius", sample.particle_radius, "sample.particle_radius");
    if (change.size_deviation > 0) {
        add("size-distribution", "lognormal:" + to_text(change.size_deviation));
    }
    const double coordination = std::isfinite(recipe.target_coordination) ? recipe.target_coordination : usual_coordination;
    if (coagulates) {
        const bool changed = std::isfinite(change.surface_potential);
        add_needed("surface-potential", changed ? change.surface_potential : recipe.surface_potential,
                   "structures.surface_potential");
        if (std::isfinite(sample.temperature)) {
            add("temperature", to_text(sample.temperature));
        }
    }
    add(coagulates ? "stop-coordination" : "target-coordination", to_text(coordination));
    add("seed", std::to_string(seed));
    return words;
}

}  // namespace

std::string generation_call(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change) {
    std::string call = "coagula generate " + recipe.generator;
    for (const std::string& word : words_of(recipe, sample, seed, change)) {
        call += " " + word;
    }
    return call;
}

Packing generate_structure(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change,
                           const Progress& progress) {
    std::vector<std::string> words = words_of(recipe, sample, seed, change);
    words.insert(words.end(), {"--output", "unused"});
    try {
        return recipe.generator == "vem" ? expanded_packing({generate_vem_verb(), words}, progress)
                                         : coagulated_packing({generate_brownian_verb(), words}, progress);
    } catch (const InputError& error) {
        throw InputError("structures by '" + generation_call(recipe, sample, seed, change) + "': " + error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError("structures by '" + generation_call(recipe, sample, seed, change) + "': " + error.what());
    }
}

}  // namespace coagula::tools
