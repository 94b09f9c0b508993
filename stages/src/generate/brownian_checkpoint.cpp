// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_checkpoint.hpp"

#include <coagula/io/checkpoint_file.hpp>

#include <array>
#include <limits>
#include <utility>

namespace coagula::stages {

namespace {

using io::CheckpointReader;
using io::Integers;
using io::Numbers;

using generators::BrownianCheckpoint;
using generators::BrownianSeries;
using generators::Snapshot;

const std::string brownian_kind = "checkpoint of coagula generate brownian";

template <class Checkpoint>
auto vectors_of(Checkpoint& checkpoint) {
    return std::array{
        std::pair{"/state/positions", &checkpoint.positions}, std::pair{"/state/list_reference", &checkpoint.list_reference},
        std::pair{"/state/near_reference", &checkpoint.near_reference}, std::pair{"/state/far_forces", &checkpoint.far_forces}};
}

template <class Series>
auto numbers_of(Series& series) {
    return std::array{std::pair{"/series/time", &series.time},
                      std::pair{"/series/coordination", &series.coordination},
                      std::pair{"/series/energy", &series.energy},
                      std::pair{"/series/mean_gap", &series.mean_gap},
                      std::pair{"/series/sliding_energy", &series.sliding_energy},
                      std::pair{"/series/rolling_energy", &series.rolling_energy}};
}

template <class Stress>
auto stresses_of(Stress& stress) {
    return std::array{std::pair{"/series/strain", &stress.strain},
                      std::pair{"/series/shear_stress", &stress.shear_stress},
                      std::pair{"/series/contact_shear_stress", &stress.contact_shear_stress},
                      std::pair{"/series/normal_stress_x", &stress.normal_stress_x},
                      std::pair{"/series/normal_stress_y", &stress.normal_stress_y},
                      std::pair{"/series/normal_stress_z", &stress.normal_stress_z}};
}

template <class Series>
auto counts_of(Series& series) {
    return std::array{std::pair{"/series/clusters", &series.clusters}, std::pair{"/series/largest", &series.largest},
                      std::pair{"/series/percolating", &series.percolating}, std::pair{"/series/formed", &series.formed},
                      std::pair{"/series/broken", &series.broken}};
}

using Pairs = Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic>;

Integers flat(const Pairs& pairs) {
    return {pairs.data(), pairs.data() + pairs.size()};
}

Pairs read_pairs(const CheckpointReader& file, const std::string& name, std::size_t particles) {
    const auto& numbers = file.get<Integers>(name);
    Pairs pairs(2, static_cast<Index>(numbers.size() / 2));
    for (std::size_t entry = 0; entry < 2 * (numbers.size() / 2); ++entry) {
        pairs.data()[entry] =
            static_cast<std::int32_t>(file.whole(numbers[entry], 0, static_cast<std::int64_t>(particles), "particle"));
    }
    return pairs;
}

Numbers flat(const Eigen::Matrix3Xd& vectors) {
    return {vectors.data(), vectors.data() + vectors.size()};
}

Eigen::Matrix3Xd read_vectors(const CheckpointReader& file, const std::string& name, std::size_t particles) {
    const Numbers& values = file.finite(name, 3, particles);
    return Eigen::Matrix3Xd::Map(values.data(), 3, static_cast<Index>(particles));
}

/// A flow adds the strains of the lists and the stress since the last sample to a checkpoint.
void put_flow(std::vector<io::Dataset>& all, const BrownianCheckpoint& checkpoint) {
    if (checkpoint.series.stress.strain.empty()) {
        return;
    }
    io::put(all, "/state/strains", Numbers{checkpoint.list_strain, checkpoint.near_strain});
    io::put(all, "/state/stress_times", Integers{checkpoint.stress.times});
    Numbers sums(checkpoint.stress.pairs.data(), checkpoint.stress.pairs.data() + 9);
    sums.insert(sums.end(), checkpoint.stress.sliding.data(), checkpoint.stress.sliding.data() + 9);
    io::put(all, "/state/stress", std::move(sums));
    for (const auto& [name, values] : stresses_of(checkpoint.series.stress)) {
        io::put(all, name, *values);
    }
}

void read_flow(const CheckpointReader& file, std::size_t samples, BrownianCheckpoint& checkpoint) {
    if (!file.has("/state/strains")) {
        return;
    }
    const Numbers& strains = file.finite("/state/strains", 1, 2);
    checkpoint.list_strain = strains[0];
    checkpoint.near_strain = strains[1];
    checkpoint.stress.times = file.whole(file.table<Integers>("/state/stress_times", 1, 1)[0], 0,
                                         std::numeric_limits<std::int64_t>::max(), "number of stresses");
    const Numbers& sums = file.finite("/state/stress", 9, 2);
    checkpoint.stress.pairs = Eigen::Matrix3d::Map(sums.data());
    checkpoint.stress.sliding = Eigen::Matrix3d::Map(sums.data() + 9);
    for (const auto& [name, values] : stresses_of(checkpoint.series.stress)) {
        *values = file.finite(name, 1, samples);
    }
}

std::string snapshot_name(std::size_t number) {
    return "/snapshots/" + std::to_string(number);
}

}  // namespace

void write_checkpoint(const std::string& path, const std::string& signature, const BrownianCheckpoint& checkpoint) {
    std::vector<io::Dataset> all = io::checkpoint_head(brownian_kind, signature);
    io::put(all, "/state/step", Integers{checkpoint.step});
    for (const auto& [name, vectors] : vectors_of(checkpoint)) {
        io::put(all, name, flat(*vectors));
    }
    io::put(all, "/state/contacts", flat(checkpoint.contacts));
    if (checkpoint.rotations.cols() > 0) {
        io::put(all, "/state/rotations", flat(checkpoint.rotations));
        io::put(all, "/state/touching", flat(checkpoint.memories.ends));
        io::put(all, "/state/sliding", flat(checkpoint.memories.sliding));
        io::put(all, "/state/rolling", flat(checkpoint.memories.rolling));
    }
    for (const auto& [name, values] : numbers_of(checkpoint.series)) {
        io::put(all, name, *values);
    }
    for (const auto& [name, values] : counts_of(checkpoint.series)) {
        io::put(all, name, *values);
    }
    put_flow(all, checkpoint);
    Numbers times;
    for (const Snapshot& snapshot : checkpoint.snapshots) {
        io::put(all, snapshot_name(times.size()), flat(snapshot.positions));
        times.push_back(snapshot.time);
    }
    io::put(all, "/snapshots/time", std::move(times));
    io::write_checkpoint_file(path, std::move(all));
}

BrownianCheckpoint read_brownian_checkpoint(const std::string& path, const std::string& signature) {
    const CheckpointReader file(path, brownian_kind, signature);
    BrownianCheckpoint checkpoint;
    checkpoint.step = file.whole(file.table<Integers>("/state/step", 1, 1)[0], 0, std::numeric_limits<std::int64_t>::max(), "step");
    const std::size_t particles = file.get<Numbers>("/state/positions").size() / 3;
    for (const auto& [name, vectors] : vectors_of(checkpoint)) {
        *vectors = read_vectors(file, name, particles);
    }
    checkpoint.contacts = read_pairs(file, "/state/contacts", particles);
    if (file.has("/state/rotations")) {
        checkpoint.rotations = read_vectors(file, "/state/rotations", particles);
        checkpoint.memories.ends = read_pairs(file, "/state/touching", particles);
        const auto touching = static_cast<std::size_t>(checkpoint.memories.ends.cols());
        checkpoint.memories.sliding = read_vectors(file, "/state/sliding", touching);
        checkpoint.memories.rolling = read_vectors(file, "/state/rolling", touching);
    }
    const std::size_t samples = file.get<Numbers>("/series/time").size();
    if (samples == 0) {
        file.fail("holds no samples: the checkpoint is damaged");
    }
    for (const auto& [name, values] : numbers_of(checkpoint.series)) {
        *values = file.finite(name, 1, samples);
    }
    for (const auto& [name, values] : counts_of(checkpoint.series)) {
        *values = file.table<Integers>(name, 1, samples);
    }
    read_flow(file, samples, checkpoint);
    const Numbers& times = file.finite("/snapshots/time", 1, file.get<Numbers>("/snapshots/time").size());
    for (std::size_t number = 0; number < times.size(); ++number) {
        checkpoint.snapshots.push_back({times[number], read_vectors(file, snapshot_name(number), particles)});
    }
    return checkpoint;
}

}  // namespace coagula::stages
