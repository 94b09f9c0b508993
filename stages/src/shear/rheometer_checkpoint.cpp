// SPDX-License-Identifier: GPL-3.0-or-later
#include "rheometer_checkpoint.hpp"

#include <coagula/io/checkpoint_file.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/io/structure_file.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace coagula::stages {

namespace {

using io::CheckpointReader;
using io::Integers;
using io::Numbers;

using dem::Bond;
using dem::ParticleState;
using dem::Quad;
using mechanics::Oscillation;
using mechanics::RheometerCheckpoint;
using mechanics::RheometerRun;
using Reader = CheckpointReader;

const std::string rheometer_kind = "checkpoint of coagula shear --method dem";

/// The per-particle vectors of a state with their names.
template <class State>
auto vectors_of(State& state) {
    return std::array{std::pair{"position", &state.position}, std::pair{"velocity", &state.velocity},
                      std::pair{"spin", &state.spin},         std::pair{"turn", &state.turn},
                      std::pair{"force", &state.force},       std::pair{"moment", &state.moment}};
}

/// The vectors of a bond's memory.
template <class Memory>
auto vectors_in(Memory& memory) {
    return std::array{&memory.branch, &memory.shear, &memory.bend, &memory.maxwell, &memory.dashpot};
}

constexpr std::size_t bond_integers = 6;
constexpr std::size_t bond_numbers = 17;
constexpr double largest_strain = 1000;       ///< of the cell; whole periods are taken out of it
constexpr std::int64_t farthest_image = 500;  ///< periods: farther away a particle has left all bounds

void put_bonds(std::vector<io::Dataset>& all, const std::vector<Bond>& bonds) {
    Integers integers;
    Numbers numbers;
    for (const Bond& bond : bonds) {
        integers.insert(integers.end(),
                        {bond.first, bond.second, bond.images[0], bond.images[1], bond.images[2], bond.memory.bonded ? 1 : 0});
        numbers.insert(numbers.end(), {bond.memory.rest_length, bond.memory.shear_stiffness});
        for (const Eigen::Vector3d* vector : vectors_in(bond.memory)) {
            numbers.insert(numbers.end(), vector->begin(), vector->end());
        }
    }
    io::put(all, "/state/bond_integers", std::move(integers));
    io::put(all, "/state/bond_numbers", std::move(numbers));
}

std::vector<Bond> read_bonds(const Reader& file, std::size_t particles) {
    const std::size_t count = file.get<Integers>("/state/bond_integers").size() / bond_integers;
    const auto& integers = file.table<Integers>("/state/bond_integers", bond_integers, count);
    const Numbers& numbers = file.finite("/state/bond_numbers", bond_numbers, count);
    std::vector<Bond> bonds(count);
    for (std::size_t entry = 0; entry < count; ++entry) {
        const std::int64_t* whole = &integers[bond_integers * entry];
        const double* real = &numbers[bond_numbers * entry];
        const auto particle = [&](std::int64_t number) {
            return static_cast<std::int32_t>(file.whole(number, 0, static_cast<std::int64_t>(particles), "particle"));
        };
        const auto image = [&](std::int64_t number) {
            return static_cast<int>(file.whole(number, -farthest_image, farthest_image, "image"));
        };
        Bond& bond = bonds[entry];
        bond.first = particle(whole[0]);
        bond.second = particle(whole[1]);
        bond.images = {image(whole[2]), image(whole[3]), image(whole[4])};
        bond.memory.bonded = whole[5] != 0;
        bond.memory.rest_length = real[0];
        bond.memory.shear_stiffness = real[1];
        real += 2;
        for (Eigen::Vector3d* vector : vectors_in(bond.memory)) {
            *vector << real[0], real[1], real[2];
            real += 3;
        }
    }
    return bonds;
}

void put_state(std::vector<io::Dataset>& all, const ParticleState& state) {
    for (const auto& [name, vectors] : vectors_of(state)) {
        Numbers values;
        values.reserve(4 * vectors->size());
        for (const Quad& vector : *vectors) {
            values.insert(values.end(), vector.begin(), vector.end());
        }
        io::put(all, std::string("/state/") + name, std::move(values));
    }
    io::put(all, "/state/inverse_mass", state.inverse_mass);
    io::put(all, "/state/inverse_inertia", state.inverse_inertia);
    io::put(all, "/state/shear_axes", Integers{state.shear.direction, state.shear.normal});
    io::put(all, "/state/shear_strain", Numbers{state.shear.strain});
    put_bonds(all, state.bonds);
}

/// The first two numbers, which name two axes.
std::pair<int, int> read_axes(const Reader& file, const Integers& numbers) {
    const std::pair axes{file.axis(numbers[0]), file.axis(numbers[1])};
    if (axes.first == axes.second) {
        file.fail("names the same axis twice: the checkpoint is damaged");
    }
    return axes;
}

ParticleState read_state(const Reader& file) {
    ParticleState state;
    const std::size_t particles = file.get<Numbers>("/state/inverse_mass").size();
    for (const auto& [name, vectors] : vectors_of(state)) {
        const Numbers& values = file.finite(std::string("/state/") + name, 4, particles);
        vectors->resize(particles);
        for (std::size_t particle = 0; particle < particles; ++particle) {
            (*vectors)[particle] = Quad::Map(&values[4 * particle]);
        }
    }
    state.inverse_mass = file.finite("/state/inverse_mass", 1, particles);
    state.inverse_inertia = file.finite("/state/inverse_inertia", 1, particles);
    const auto [direction, normal] = read_axes(file, file.table<Integers>("/state/shear_axes", 2, 1));
    state.shear = {direction, normal, file.finite("/state/shear_strain", 1, 1)[0]};
    if (std::abs(state.shear.strain) > largest_strain) {
        file.fail("has a strain of the cell of " + to_text(state.shear.strain) +
                  ", which no run reaches: the checkpoint is damaged");
    }
    state.bonds = read_bonds(file, particles);
    return state;
}

constexpr std::array oscillation_numbers{
    &Oscillation::amplitude,           &Oscillation::storage_modulus,  &Oscillation::loss_modulus,   &Oscillation::phase,
    &Oscillation::fundamental_storage, &Oscillation::fundamental_loss, &Oscillation::third_harmonic, &Oscillation::offset};
constexpr std::array run_numbers{&RheometerRun::plate_storage, &RheometerRun::rest_force, &RheometerRun::unbalanced_ratio,
                                 &RheometerRun::rate_error, &RheometerRun::rest_modulus};

void put_run(std::vector<io::Dataset>& all, const std::string& group, const RheometerRun& run) {
    io::put(all, group + "orientation", Integers{run.orientation.normal, run.orientation.direction, run.rest_steps});
    Numbers of_run;
    for (const auto value : run_numbers) {
        of_run.push_back(run.*value);
    }
    io::put(all, group + "numbers", std::move(of_run));
    Numbers numbers;
    Integers broken;
    for (const Oscillation& oscillation : run.oscillations) {
        for (const auto value : oscillation_numbers) {
            numbers.push_back(oscillation.*value);
        }
        broken.push_back(oscillation.broken_bonds);
    }
    io::put(all, group + "oscillations", std::move(numbers));
    io::put(all, group + "broken_per_oscillation", std::move(broken));
    io::put(all, group + "strain", run.strain);
    io::put(all, group + "stress", run.stress);
    io::put(all, group + "plate_stress", run.plate_stress);
    io::put(all, group + "sphere_storage", Numbers(run.sphere_storage.begin(), run.sphere_storage.end()));
    io::put(all, group + "spheres", Integers{run.sphere_stress.rows(), run.sphere_stress.cols()});
    io::put(all, group + "sphere_stress", Numbers(run.sphere_stress.data(), run.sphere_stress.data() + run.sphere_stress.size()));
    Integers where;
    Numbers strains;
    for (const mechanics::BrokenInShear& bond : run.broken) {
        where.insert(where.end(), {bond.first, bond.second, bond.oscillation, static_cast<std::int64_t>(bond.cause)});
        strains.push_back(bond.strain);
    }
    io::put(all, group + "broken", std::move(where));
    io::put(all, group + "broken_strain", std::move(strains));
}

RheometerRun read_run(const Reader& file, const std::string& group) {
    RheometerRun run;
    const auto& head = file.table<Integers>(group + "orientation", 3, 1);
    const auto [normal, direction] = read_axes(file, head);
    run.orientation = {normal, direction};
    run.rest_steps = file.small_count(head[2], "a number of steps");
    const auto& of_run = file.table<Numbers>(group + "numbers", run_numbers.size(), 1);
    for (std::size_t k = 0; k < run_numbers.size(); ++k) {
        run.*run_numbers[k] = of_run[k];
    }
    const auto& broken = file.get<Integers>(group + "broken_per_oscillation");
    const auto& numbers = file.table<Numbers>(group + "oscillations", oscillation_numbers.size(), broken.size());
    run.oscillations.resize(broken.size());
    for (std::size_t entry = 0; entry < broken.size(); ++entry) {
        for (std::size_t k = 0; k < oscillation_numbers.size(); ++k) {
            run.oscillations[entry].*oscillation_numbers[k] = numbers[oscillation_numbers.size() * entry + k];
        }
        run.oscillations[entry].broken_bonds = broken[entry];
    }
    const std::size_t samples = file.get<Numbers>(group + "strain").size();
    run.strain = file.finite(group + "strain", 1, samples);
    run.stress = file.finite(group + "stress", 1, samples);
    run.plate_stress = file.finite(group + "plate_stress", 1, file.get<Numbers>(group + "plate_stress").empty() ? 0 : samples);
    const auto& spheres = file.get<Numbers>(group + "sphere_storage");
    run.sphere_storage = Eigen::VectorXd::Map(spheres.data(), static_cast<Index>(spheres.size()));
    const auto& shape = file.table<Integers>(group + "spheres", 2, 1);
    const int rows = file.small_count(shape[0], "a number of samples");
    const int columns = file.small_count(shape[1], "a number of spheres");
    const Numbers& stress = file.finite(group + "sphere_stress", static_cast<std::size_t>(rows), static_cast<std::size_t>(columns));
    run.sphere_stress = Eigen::MatrixXd::Map(stress.data(), rows, columns);
    const auto& strains = file.get<Numbers>(group + "broken_strain");
    const auto& where = file.table<Integers>(group + "broken", 4, strains.size());
    for (std::size_t entry = 0; entry < strains.size(); ++entry) {
        const std::int64_t* whole = &where[4 * entry];
        const auto cause = file.whole(whole[3], 0, static_cast<std::int64_t>(BreakageCause::pull_off) + 1, "a cause of breakage");
        run.broken.push_back({file.small_count(whole[0], "particle"), file.small_count(whole[1], "particle"), strains[entry],
                              file.small_count(whole[2], "oscillation"), static_cast<BreakageCause>(cause)});
    }
    return run;
}

std::string finished_group(std::size_t number) {
    return "/finished/" + std::to_string(number) + "/";
}

}  // namespace

void write_checkpoint(const std::string& path, const std::string& signature, const RheometerCheckpoint& checkpoint) {
    std::vector<io::Dataset> all = io::checkpoint_head(rheometer_kind, signature);
    for (std::size_t run = 0; run < checkpoint.finished.size(); ++run) {
        put_run(all, finished_group(run), checkpoint.finished[run]);
    }
    put_run(all, "/current/", checkpoint.current);
    put_state(all, checkpoint.state);
    io::write_checkpoint_file(path, std::move(all));
}

RheometerCheckpoint read_checkpoint(const std::string& path, const std::string& signature) {
    const Reader file(path, rheometer_kind, signature);
    RheometerCheckpoint checkpoint;
    for (std::size_t run = 0; file.has(finished_group(run) + "orientation"); ++run) {
        checkpoint.finished.push_back(read_run(file, finished_group(run)));
    }
    checkpoint.current = read_run(file, "/current/");
    checkpoint.state = read_state(file);
    return checkpoint;
}

}  // namespace coagula::stages
