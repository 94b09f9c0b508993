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
    std::vector<Packing> packings;
    std::vector<std::string> hashes;  ///< SHA-256 of the positions
    diagnose::OtherStages stages;     ///< what the simulator asks of the generators and of characterize
};

/// Reads or generates them, and notes their sizes and volume fractions in the experiment. Throws InputError when there are none, or
/// one has no periodic cell.
ExperimentStructures structures_of(diagnose::Experiment& experiment, const Progress& progress);

/// Each in one sentence: where it is from, its particles and hash.
std::vector<std::string> structure_sentences(const diagnose::Experiment& experiment, const ExperimentStructures& structures);

}  // namespace coagula::experiment
