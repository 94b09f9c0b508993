#include "structure_recipe.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/generators/coagulation.hpp>
#include <coagula/generators/void_expansion.hpp>

#include <cmath>

namespace coagula::experiment {

namespace {

using diagnose::Sample;
using diagnose::StructureChange;
using diagnose::StructureRecipe;

constexpr double usual_coordination = 4.69;  ///< where coagulation stops, as void expansion does

double coordination_of(const StructureRecipe& recipe) {
    return std::isfinite(recipe.target_coordination) ? recipe.target_coordination : usual_coordination;
}

double surface_potential_of(const StructureRecipe& recipe, const StructureChange& change) {
    return std::isfinite(change.surface_potential) ? change.surface_potential : recipe.surface_potential;
}

generators::SizeDistribution sizes_of(const Sample& sample, const StructureChange& change) {
    if (change.size_deviation > 0) {
        return {generators::SizeKind::lognormal, sample.particle_radius, change.size_deviation};
    }
    return {generators::SizeKind::monodisperse, sample.particle_radius};
}

generators::VoidExpansionOptions expansion_of(const StructureRecipe& recipe, const Sample& sample, std::size_t seed,
                                              const StructureChange& change) {
    generators::VoidExpansionOptions options;
    options.particles = recipe.particles;
    options.voids = recipe.voids > 0 ? recipe.voids : recipe.particles / 2;
    options.volume_fraction = sample.volume_fraction;
    options.target_coordination = coordination_of(recipe);
    options.seed = seed;
    options.radii = generators::draw_radii(sizes_of(sample, change), options.particles, seed);
    return options;
}

generators::CoagulationOptions coagulation_of(const StructureRecipe& recipe, const Sample& sample, std::size_t seed,
                                              const StructureChange& change) {
    generators::CoagulationOptions options;
    options.particles = recipe.particles;
    options.sizes = sizes_of(sample, change);
    options.volume_fraction = sample.volume_fraction;
    options.surface_potential = surface_potential_of(recipe, change);
    options.temperature = std::isfinite(sample.temperature) ? sample.temperature : options.temperature;
    options.target_coordination = coordination_of(recipe);
    options.seed = seed;
    return options;
}

/// What `work` on a structure returns; what cannot be made is named first.
template <class Work>
auto naming_structure(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change,
                      const Work& work) {
    const std::string call = generation_call(recipe, sample, seed, change);
    try {
        require(recipe.particles <= 100000000, "a structure can have at most 100 million particles");
        return work();
    } catch (const InputError& error) {
        throw InputError("structures by '" + call + "': " + error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError("structures by '" + call + "': " + error.what());
    }
}

}  // namespace

std::string generation_call(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change) {
    const bool coagulates = recipe.generator == "brownian";
    std::string call = "coagula generate " + recipe.generator;
    const auto add = [&](const std::string& option, const std::string& value) { call += " --" + option + " " + value; };
    const auto add_needed = [&](const std::string& option, double value, const std::string& key) {
        if (std::isnan(value)) {
            throw InputError("structures by '" + recipe.generator + "' need " + key);
        }
        add(option, to_text(value));
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
    if (coagulates) {
        add_needed("surface-potential", surface_potential_of(recipe, change), "structures.surface_potential");
        if (std::isfinite(sample.temperature)) {
            add("temperature", to_text(sample.temperature));
        }
    }
    add(coagulates ? "stop-coordination" : "target-coordination", to_text(coordination_of(recipe)));
    add("seed", std::to_string(seed));
    return call;
}

void check_recipe(const StructureRecipe& recipe, const Sample& sample) {
    const std::size_t seed = recipe.seeds.front();  // decides nothing here
    naming_structure(recipe, sample, seed, {}, [&] {
        return recipe.generator == "vem" ? generators::check(expansion_of(recipe, sample, seed, {}))
                                         : generators::check(coagulation_of(recipe, sample, seed, {}));
    });
}

Packing generate_structure(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change,
                           const Progress& progress) {
    return naming_structure(recipe, sample, seed, change, [&] {
        return recipe.generator == "vem" ? generators::expand_voids(expansion_of(recipe, sample, seed, change), progress).packing
                                         : generators::coagulate(coagulation_of(recipe, sample, seed, change), progress);
    });
}

}  // namespace coagula::experiment
