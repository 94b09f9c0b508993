#include "experiment_structures.hpp"

#include "arguments.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/generators/void_expansion.hpp>
#include <coagula/io/structure_file.hpp>

#include <cmath>
#include <fstream>

namespace coagula::tools {

namespace {

Packing generate(const diagnose::StructureRecipe& recipe, const diagnose::Sample& sample, std::size_t seed,
                 const Progress& progress) {
    if (recipe.generator != "vem") {
        throw InputError("the experiment asks for structures by '" + recipe.generator +
                         "', which diagnose cannot make yet: generate them and name the files under structures");
    }
    generators::VoidExpansionOptions options;
    options.particles = recipe.particles;
    options.voids = recipe.voids;
    options.volume_fraction = sample.volume_fraction;
    options.radii = Eigen::VectorXd::Constant(recipe.particles, sample.particle_radius);
    options.seed = seed;
    if (std::isfinite(recipe.target_coordination)) {
        options.target_coordination = recipe.target_coordination;
    }
    return generators::expand_voids(options, progress).packing;
}

}  // namespace

ExperimentStructures structures_of(diagnose::Experiment& experiment, const Progress& progress) {
    ExperimentStructures found;
    for (const std::string& path : experiment.structures) {
        found.packings.push_back(io::read_structure(path).packing);
        if (!found.packings.back().cell.is_periodic()) {
            throw InputError(path + ": a structure for a diagnosis must have a periodic cell");
        }
    }
    if (found.packings.empty() && experiment.recipe) {
        for (const std::size_t seed : experiment.recipe->seeds) {
            found.packings.push_back(generate(*experiment.recipe, experiment.sample, seed, progress));
        }
    }
    if (found.packings.empty()) {
        throw InputError("the experiment names no structures: give files, or a recipe that makes them");
    }
    for (const Packing& packing : found.packings) {
        found.hashes.push_back(io::positions_sha256(packing));
        experiment.structure_sizes.push_back(static_cast<std::size_t>(packing.size()));
        experiment.structure_volume_fractions.push_back(volume_fraction(packing));
    }
    return found;
}

std::vector<std::string> structure_sentences(const diagnose::Experiment& experiment, const ExperimentStructures& structures) {
    std::vector<std::string> sentences;
    for (std::size_t k = 0; k < structures.packings.size(); ++k) {
        const std::string from = experiment.structures.empty()
                                     ? experiment.recipe->generator + ", seed " + std::to_string(experiment.recipe->seeds[k])
                                     : experiment.structures[k];
        sentences.push_back(from + ": " + std::to_string(structures.packings[k].size()) + " particles, SHA-256 of the positions " +
                            structures.hashes[k]);
    }
    return sentences;
}

diagnose::SimulationCache read_cache(const std::filesystem::path& path) {
    diagnose::SimulationCache cache;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos) {
            continue;  // a line cut off by an interruption
        }
        std::vector<double> values;
        for (const std::string& word : split(line.substr(tab + 1), ' ')) {
            values.push_back(std::strtod(word.c_str(), nullptr));
        }
        cache[line.substr(0, tab)] = std::move(values);
    }
    return cache;
}

std::string cache_text(const diagnose::SimulationCache& cache) {
    std::string text;
    for (const auto& [key, values] : cache) {
        text += key + "\t";
        for (std::size_t k = 0; k < values.size(); ++k) {
            text += (k > 0 ? " " : "") + to_text(values[k]);
        }
        text += "\n";
    }
    return text;
}

}  // namespace coagula::tools
