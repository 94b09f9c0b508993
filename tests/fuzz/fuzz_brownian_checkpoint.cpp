// SPDX-License-Identifier: GPL-3.0-or-later
// The checkpoint of a Brownian run; see checkpoint_edits.hpp and hdf5_edits.hpp for what the input is.
#include "brownian_checkpoint.hpp"
#include "checkpoint_edits.hpp"

namespace {

using namespace coagula;
using generators::BrownianCheckpoint;

/// A small file as the program writes it.
std::string sound_file(const fuzz::InputFolder& folder) {
    BrownianCheckpoint checkpoint;
    checkpoint.step = 7;
    for (Eigen::Matrix3Xd* vectors : {&checkpoint.positions, &checkpoint.list_reference, &checkpoint.near_reference,
                                      &checkpoint.far_forces, &checkpoint.rotations}) {
        *vectors = Eigen::Matrix3Xd::Constant(3, 4, 0.5);
    }
    checkpoint.contacts.resize(2, 1);
    checkpoint.contacts << 0, 1;
    checkpoint.memories.ends = checkpoint.contacts;
    checkpoint.memories.sliding = checkpoint.memories.rolling = Eigen::Matrix3Xd::Zero(3, 1);
    auto& series = checkpoint.series;
    series.time = series.coordination = series.energy = series.sliding_energy = series.rolling_energy = series.mean_gap = {0, 1};
    series.clusters = series.largest = series.percolating = series.formed = series.broken = {0, 1};
    checkpoint.snapshots = {{0.5, checkpoint.positions}};
    const std::string path = folder.write("sound.h5", "");
    stages::write_checkpoint(path, "run", checkpoint);
    return fuzz::contents_of(path);
}

void check_checkpoint(const BrownianCheckpoint& checkpoint) {
    const Index particles = checkpoint.positions.cols();
    for (const Eigen::Matrix3Xd* vectors :
         {&checkpoint.positions, &checkpoint.list_reference, &checkpoint.near_reference, &checkpoint.far_forces}) {
        fuzz::expect(vectors->cols() == particles && vectors->allFinite(), "a vector of the state is missing or not finite");
    }
    fuzz::expect(
        checkpoint.rotations.allFinite() && checkpoint.memories.sliding.allFinite() && checkpoint.memories.rolling.allFinite(),
        "a memory of the state is not finite");
    fuzz::expect(checkpoint.step >= 0, "the step is negative");
    for (const auto* pairs : {&checkpoint.contacts, &checkpoint.memories.ends}) {
        fuzz::expect(pairs->size() == 0 || (pairs->minCoeff() >= 0 && pairs->maxCoeff() < particles), "a pair names no particle");
    }
    for (const generators::Snapshot& snapshot : checkpoint.snapshots) {
        fuzz::expect(snapshot.positions.allFinite() && std::isfinite(snapshot.time), "a snapshot is not finite");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    static const std::string sound = sound_file(folder);
    fuzz::read_edited_checkpoint(folder, sound, fuzz::Choices(data, size),
                                 [](const std::string& path) { check_checkpoint(stages::read_brownian_checkpoint(path, "run")); });
    return 0;
}
