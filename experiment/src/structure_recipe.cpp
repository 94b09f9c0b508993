// SPDX-License-Identifier: GPL-3.0-or-later
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

double usual_debye_length() {
    return generators::CoagulationOptions{}.debye_length;
}

/// What a structure is made of.
struct Making {
    StructureRecipe recipe;
    Sample sample;
    double size_deviation;
    double debye_length;  ///< [m]
    std::size_t seed;
};

Making making(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change) {
    // The Debye length goes as one over the root of the ionic strength.
    Making one{recipe, sample, change.size_deviation, usual_debye_length() / std::sqrt(change.ionic_strength), seed};
    if (std::isfinite(change.surface_potential)) {
        one.recipe.surface_potential = change.surface_potential;
    }
    if (std::isfinite(change.coordination)) {
        one.recipe.target_coordination = change.coordination;
    }
    if (std::isfinite(change.voids)) {
        one.recipe.voids = static_cast<int>(std::lround(change.voids * recipe.particles));
    }
    one.sample.volume_fraction *= 1 + change.volume_fraction;
    return one;
}

generators::SizeDistribution sizes_of(const Making& one) {
    if (one.size_deviation > 0) {
        return {generators::SizeKind::lognormal, one.sample.particle_radius, one.size_deviation};
    }
    return {generators::SizeKind::monodisperse, one.sample.particle_radius};
}

generators::VoidExpansionOptions expansion_of(const Making& one) {
    generators::VoidExpansionOptions options;
    options.particles = one.recipe.particles;
    options.voids = one.recipe.voids > 0 ? one.recipe.voids : one.recipe.particles / 2;
    options.volume_fraction = one.sample.volume_fraction;
    options.target_coordination = coordination_of(one.recipe);
    options.seed = one.seed;
    options.radii = generators::draw_radii(sizes_of(one), options.particles, one.seed);
    return options;
}

generators::CoagulationOptions coagulation_of(const Making& one) {
    generators::CoagulationOptions options;
    options.particles = one.recipe.particles;
    options.sizes = sizes_of(one);
    options.volume_fraction = one.sample.volume_fraction;
    options.surface_potential = one.recipe.surface_potential;
    options.debye_length = one.debye_length;
    options.temperature = std::isfinite(one.sample.temperature) ? one.sample.temperature : options.temperature;
    options.target_coordination = coordination_of(one.recipe);
    options.seed = one.seed;
    return options;
}

std::string call_of(const Making& one) {
    const bool coagulates = one.recipe.generator == "brownian";
    std::string call = "coagula generate " + one.recipe.generator;
    const auto add = [&](const std::string& option, const std::string& value) { call += " --" + option + " " + value; };
    const auto add_needed = [&](const std::string& option, double value, const std::string& key) {
        if (std::isnan(value)) {
            throw InputError("structures by '" + one.recipe.generator + "' need " + key);
        }
        add(option, to_text(value));
    };
    add("particles", std::to_string(one.recipe.particles));
    if (one.recipe.voids > 0) {
        add("voids", std::to_string(one.recipe.voids));
    }
    add_needed("volume-fraction", one.sample.volume_fraction, "sample.volume_fraction");
    add_needed("radius", one.sample.particle_radius, "sample.particle_radius");
    if (one.size_deviation > 0) {
        add("size-distribution", "lognormal:" + to_text(one.size_deviation));
    }
    if (coagulates) {
        add_needed("surface-potential", one.recipe.surface_potential, "structures.surface_potential");
        if (one.debye_length != usual_debye_length()) {
            add("debye-length", to_text(one.debye_length));
        }
        if (std::isfinite(one.sample.temperature)) {
            add("temperature", to_text(one.sample.temperature));
        }
    }
    add(coagulates ? "stop-coordination" : "target-coordination", to_text(coordination_of(one.recipe)));
    add("seed", std::to_string(one.seed));
    return call;
}

/// What `work` on a structure returns; what cannot be made is named first.
template <class Work>
auto naming_structure(const Making& one, const Work& work) {
    const std::string call = call_of(one);
    try {
        require(one.recipe.particles <= 100000000, "a structure can have at most 100 million particles");
        return work();
    } catch (const InputError& error) {
        throw InputError("structures by '" + call + "': " + error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError("structures by '" + call + "': " + error.what());
    }
}

}  // namespace

std::string generation_call(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change) {
    return call_of(making(recipe, sample, seed, change));
}

void check_recipe(const StructureRecipe& recipe, const Sample& sample) {
    const Making one = making(recipe, sample, recipe.seeds.front(), {});  // the seed decides nothing here
    naming_structure(one, [&] {
        return recipe.generator == "vem" ? generators::check(expansion_of(one)) : generators::check(coagulation_of(one));
    });
}

Packing generate_structure(const StructureRecipe& recipe, const Sample& sample, std::size_t seed, const StructureChange& change,
                           const Progress& progress) {
    const Making one = making(recipe, sample, seed, change);
    return naming_structure(one, [&] {
        return recipe.generator == "vem" ? generators::expand_voids(expansion_of(one), progress).packing
                                         : generators::coagulate(coagulation_of(one), progress);
    });
}

}  // namespace coagula::experiment
