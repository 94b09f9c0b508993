// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/experiment_structures.hpp>

#include "structure_recipe.hpp"

#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/io/structure_file.hpp>

namespace coagula::experiment {

namespace {

/// Exact for equal spheres. Exact curves of unequal ones take a triangulation per radius; sampling errs by a tenth of what
/// structures scatter.
diagnose::PoreCurve measure_pores(const Packing& packing) {
    if (is_monodisperse(packing)) {
        const characterize::PoreSizes pores = characterize::measure_pores(packing);
        return {pores.max, {pores.exclusion_probability.begin(), pores.exclusion_probability.end()}};
    }
    constexpr Index radii = 200;
    constexpr Index points = 400000;
    constexpr std::uint64_t seed = 20121;
    // Twice as far until no pore is larger.
    for (double largest = 2 * mean_radius(packing);; largest *= 2) {
        const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(radii, 0, largest);
        const Eigen::VectorXd found = characterize::sample_pores(packing, radius, points, seed).exclusion_probability;
        if (found[radii - 1] == 0) {
            return {largest, {found.begin(), found.end()}};
        }
    }
}

/// The scatter of structures tells how much they leave open; a copy scatters by nothing.
void refuse_copies(const diagnose::Experiment& experiment, const std::vector<std::string>& hashes) {
    const auto& groups = experiment.structure_groups;
    for (std::size_t k = 0; k < experiment.structures.size(); ++k) {
        for (std::size_t other = 0; other < k; ++other) {
            if (hashes[k] == hashes[other] && (groups.empty() || groups[k] == groups[other])) {
                throw InputError(experiment.structures[k] + ": the same particles as in " + experiment.structures[other] +
                                 "; structures must be independent of each other");
            }
        }
    }
}

void note_packings(diagnose::Experiment& experiment, ExperimentStructures& structures) {
    experiment.structure_sizes.clear();
    experiment.structure_volume_fractions.clear();
    for (const Packing& packing : structures.packings) {
        structures.hashes.push_back(io::positions_sha256(packing));
        experiment.structure_sizes.push_back(static_cast<std::size_t>(packing.size()));
        experiment.structure_volume_fractions.push_back(volume_fraction(packing));
    }
    refuse_copies(experiment, structures.hashes);
}

}  // namespace

ExperimentStructures check_structures(diagnose::Experiment& experiment) {
    ExperimentStructures found;
    for (const std::string& path : experiment.structures) {
        found.packings.push_back(io::read_structure(path).packing);
        if (!found.packings.back().cell.is_periodic()) {
            throw InputError(path + ": a structure for a diagnosis must have a periodic cell");
        }
    }
    if (!found.packings.empty()) {
        note_packings(experiment, found);
    } else if (experiment.recipe && !experiment.recipe->seeds.empty()) {
        check_recipe(*experiment.recipe, experiment.sample);
        const std::size_t count = experiment.recipe->seeds.size();
        experiment.structure_sizes.assign(count, static_cast<std::size_t>(experiment.recipe->particles));
        experiment.structure_volume_fractions.assign(count, experiment.sample.volume_fraction);
    }
    return found;
}

void make_structures(diagnose::Experiment& experiment, ExperimentStructures& structures, const Progress& progress) {
    structures.stages.measure_pores = measure_pores;
    if (!structures.packings.empty() || experiment.material.kind != diagnose::MaterialKind::network) {
        return;
    }
    if (experiment.structure_sizes.empty()) {
        throw InputError("[structures] gives no structures: it needs 'files', or 'generator' with 'seeds'");
    }
    const auto make = [recipe = *experiment.recipe, sample = experiment.sample, progress](std::size_t k,
                                                                                          const diagnose::StructureChange& change) {
        return generate_structure(recipe, sample, recipe.seeds[k], change, progress);
    };
    for (std::size_t k = 0; k < experiment.recipe->seeds.size(); ++k) {
        structures.packings.push_back(make(k, {}));
    }
    structures.stages.make = make;
    structures.stages.name = [recipe = *experiment.recipe, sample = experiment.sample](std::size_t k,
                                                                                       const diagnose::StructureChange& change) {
        return generation_call(recipe, sample, recipe.seeds[k], change);
    };
    note_packings(experiment, structures);
}

std::vector<std::string> remaking_calls(const diagnose::Experiment& experiment, const diagnose::StructureChange& change) {
    std::vector<std::string> calls;
    if (experiment.recipe && change != diagnose::StructureChange{}) {
        for (const std::size_t seed : experiment.recipe->seeds) {
            calls.push_back(generation_call(*experiment.recipe, experiment.sample, seed, change));
        }
    }
    return calls;
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

}  // namespace coagula::experiment
