// SPDX-License-Identifier: GPL-3.0-or-later
#include "lammps_brownian.hpp"

#include "lammps_process.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::stages {

namespace {

constexpr double first_distance = 1.5;  // LAMMPS stops where particles come nearer
constexpr double spacing = 2.5e-5;      // contacts fluctuate by some 1e-3
constexpr std::uint64_t most_seed = 900'000'000;

/// LAMMPS takes seeds from 1 to 9e8. @param purpose tells the seeds of a run apart.
std::string seed_text(std::uint64_t seed, std::uint64_t purpose) {
    return std::to_string(1 + (2 * (seed % most_seed) + purpose) % most_seed);
}

}  // namespace

std::string lammps_start(const Packing& packing, double length) {
    std::string text = "particles, lengths in radii\n\n" + std::to_string(packing.size()) + " atoms\n1 atom types\n\n";
    const Eigen::Vector3d lengths = packing.cell.lengths() / length;
    const std::string axes = "xyz";
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name(1, axes[static_cast<std::size_t>(axis)]);
        text += "0 " + to_text(lengths[axis]) + ' ' + name + "lo " + name + "hi\n";
    }
    text += "\nAtoms # atomic\n\n";
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d at = (packing.cell.wrap(packing.positions.col(particle)) - packing.cell.origin()) / length;
        text += std::to_string(particle + 1) + " 1 " + to_text(at.x()) + ' ' + to_text(at.y()) + ' ' + to_text(at.z()) + '\n';
    }
    return text;
}

std::size_t lammps_table_rows(double last) {
    return static_cast<std::size_t>(std::ceil((last - first_distance) / spacing)) + 1;
}

std::string lammps_force_table(const std::function<double(double)>& force, double last) {
    const std::size_t rows = lammps_table_rows(last);
    const double step = (last - first_distance) / static_cast<double>(rows - 1);
    std::vector<double> forces(rows);
    std::vector<double> energies(rows);
    for (std::size_t row = rows; row-- > 0;) {
        forces[row] = force(first_distance + static_cast<double>(row) * step);
        energies[row] = row + 1 < rows ? energies[row + 1] + 0.5 * (forces[row] + forces[row + 1]) * step : 0.0;
    }
    std::string text = "# force and energy of two particles, in radii and kB T\n\nPAIR\nN " + std::to_string(rows) + " R " +
                       to_text(first_distance) + ' ' + to_text(last) + "\n\n";
    for (std::size_t row = 0; row < rows; ++row) {
        text += std::to_string(row + 1) + ' ' + to_text(first_distance + static_cast<double>(row) * step) + ' ' +
                to_text(energies[row]) + ' ' + to_text(forces[row]) + '\n';
    }
    return text;
}

std::string lammps_setup(const LammpsBrownian& run) {
    const std::string mass = to_text(run.mass);
    return "units lj\n"
           "atom_style atomic\n"
           "boundary p p p\n"
           "newton on\n"
           "read_data " +
           quoted(run.folder / "start.data") +
           "\n"
           "mass 1 " +
           mass +
           "\n"
           "pair_style table linear " +
           std::to_string(run.rows) +
           "\n"
           "pair_coeff 1 1 " +
           quoted(run.folder / "force.table") +
           " PAIR\n"
           "neighbor 0.3 bin\n"
           "neigh_modify delay 0 every 1 check yes one 10000 page 200000\n"
           "velocity all create 1 " +
           seed_text(run.seed, 0) +
           " dist gaussian loop geom\n"
           // The damping time of a mass at mobility 1; gjf must stand before nve.
           "fix noise all langevin 1 1 " +
           mass + ' ' + seed_text(run.seed, 1) +
           " gjf vhalf\n"
           "fix move all nve\n"
           "timestep " +
           to_text(run.time_step) +
           "\n"
           "thermo 2000000000\n";
}

std::filesystem::path lammps_frame(const LammpsBrownian& run, int number) {
    return run.folder / ("frame-" + std::to_string(number) + ".dump");
}

std::string lammps_piece(const LammpsBrownian& run, std::int64_t steps, int number) {
    const std::string part = quoted(run.folder / "frame.part");
    // A piece goes on from the one before without another set-up, which would draw noise once more.
    return "run " + std::to_string(steps) + (number == 0 ? "" : " pre no") +
           " post no\n"
           "write_dump all custom " +
           part +
           " id x y z modify sort id format float %.17g\n"
           "shell mv " +
           part + ' ' + quoted(lammps_frame(run, number)) + "\n";
}

}  // namespace coagula::stages
