// SPDX-License-Identifier: GPL-3.0-or-later
// The structures that an experiment file names or describes.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <string>
#include <vector>

namespace coagula::experiment {

struct ExperimentStructures {
    std::vector<Packing> packings;    ///< none of a recipe until they are made
    std::vector<std::string> hashes;  ///< SHA-256 of the positions
    diagnose::OtherStages stages;     ///< what the simulator asks of the generators and of characterize
};

/// Reads the files or checks the recipe, and notes sizes and volume fractions in the experiment. Throws InputError when one
/// has no periodic cell or is a copy of another, or the recipe can make none. There may be none yet.
ExperimentStructures check_structures(diagnose::Experiment& experiment);

/// Makes those of a recipe that has been checked. Throws InputError when there are no structures, or
/// nothing coagulates.
void make_structures(diagnose::Experiment& experiment, ExperimentStructures& structures, const Progress& progress);

/// The calls of `coagula generate`, one per seed, that make the structures of the recipe with a change; none without a change.
std::vector<std::string> remaking_calls(const diagnose::Experiment& experiment, const diagnose::StructureChange& change);

/// Each in one sentence: where it is from, its particles and hash.
std::vector<std::string> structure_sentences(const diagnose::Experiment& experiment, const ExperimentStructures& structures);

}  // namespace coagula::experiment
