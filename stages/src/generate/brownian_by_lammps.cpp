// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_by_lammps.hpp"

#include "engine/lammps_brownian.hpp"
#include "engine/lammps_process.hpp"

#include <coagula/io/atomic_file.hpp>
#include <coagula/io/text_formats.hpp>
#include <coagula/stages/scratch_folder.hpp>

#include <cmath>
#include <limits>

namespace coagula::stages {

namespace {

using generators::BrownianOptions;
using generators::PairPotential;

constexpr double longest_cutoff = 10;                                 // mean radii; the table would become coarse
constexpr std::int64_t most_steps = std::numeric_limits<int>::max();  // of one command

/// The particles of a run that goes on from command to command.
class LammpsParticles {
public:
    LammpsParticles(const Engine& engine, const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                    const generators::InertialStep& step)
        : start_(start), length_(mean_radius(start)), process_(engine, scratch_.path()) {
        const double energy = generators::boltzmann_constant * options.temperature;
        const auto force = generators::force_within_cutoff(potential, options, length_);
        const double last = 2 + generators::cutoff_gap(options, length_) / length_;
        const double time = step.time_step.diffusion_time;
        run_ = {.folder = scratch_.path(),
                .mass = step.memory / time,
                .time_step = step.time_step.time_step / time,
                .seed = options.seed,
                .rows = lammps_table_rows(last)};
        write_for_lammps(run_.folder / "start.data", lammps_start(start, length_));
        write_for_lammps(
            run_.folder / "force.table",
            lammps_force_table([&](double distance) { return force((distance - 2) * length_) * length_ / energy; }, last));
        process_.send(lammps_setup(run_));
    }

    Eigen::Matrix3Xd move(std::int64_t steps, const std::function<void()>& meanwhile) {
        for (; steps > most_steps; steps -= most_steps) {
            advance(most_steps, meanwhile);
        }
        return advance(steps, meanwhile);
    }

    /// @return the version of LAMMPS.
    std::string finish() {
        process_.finish({});
        return process_.version();
    }

private:
    Eigen::Matrix3Xd advance(std::int64_t steps, const std::function<void()>& meanwhile) {
        const std::filesystem::path frame = lammps_frame(run_, frames_);
        process_.send(lammps_piece(run_, steps, frames_++));
        process_.wait_for(frame, meanwhile);
        io::ImportOptions options;
        options.radius = length_;
        options.length_unit = length_;
        options.wrap = true;
        Packing read = io::read_text(frame.string(), io::TextFormat::lammps_dump, options);
        std::filesystem::remove(frame);
        if (read.size() != start_.size()) {
            throw std::runtime_error("LAMMPS lost particles: of " + std::to_string(start_.size()) + " it wrote " +
                                     std::to_string(read.size()));
        }
        return read.positions.colwise() + start_.cell.origin();
    }

    const Packing& start_;
    double length_;
    ScratchFolder scratch_;
    LammpsProcess process_;
    LammpsBrownian run_;
    int frames_ = 0;
};

}  // namespace

void check_for_lammps(const Eigen::VectorXd& radii, const Cell* cell, double cutoff_gap) {
    if (radii.minCoeff() != radii.maxCoeff()) {
        throw InputError("LAMMPS moves particles of one radius only, but these have radii from " + to_text(radii.minCoeff()) +
                         " m to " + to_text(radii.maxCoeff()) + " m: take the builtin engine");
    }
    if (cell != nullptr && !(cell->is_periodic() && cell->edges().isDiagonal(0))) {
        throw InputError("LAMMPS moves particles in a rectangular periodic box only: take the builtin engine");
    }
    const double radius = radii.mean();
    if (cutoff_gap > longest_cutoff * radius) {
        throw InputError("with LAMMPS the cut-off gap may be " + to_text(longest_cutoff) + " radii at most, but it is " +
                         to_text(cutoff_gap / radius) + ": take the builtin engine");
    }
}

LammpsBrownianRun brownian_by_lammps(const Engine& engine, const Packing& start, const PairPotential& potential,
                                     const BrownianOptions& options, const Progress& progress) {
    check_for_lammps(start.radii, &start.cell, options.cutoff_gap);
    const generators::InertialStep step =
        choose_inertial_step(potential, mean_radius(start), generators::smallest_gap(start), options);
    LammpsParticles particles(engine, start, potential, options, step);
    const auto move = [&](std::int64_t steps, const std::function<void()>& meanwhile) { return particles.move(steps, meanwhile); };
    LammpsBrownianRun made;
    made.run = follow_brownian(start, potential, options, step.time_step, move, progress);
    made.version = particles.finish();
    made.memory = step.memory;
    return made;
}

}  // namespace coagula::stages
