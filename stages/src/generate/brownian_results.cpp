// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_results.hpp"

#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/io/structure_file.hpp>

namespace coagula::stages {

namespace {

using namespace generators;

const std::string brownian_group = "/generation/brownian/";

void add_series(Results& results, const BrownianSeries& series) {
    const auto numbers = [&](const std::string& name, const std::vector<double>& values, const std::string& unit,
                             const std::string& meaning) {
        results.push_back({brownian_group + "series/" + name, {values.size()}, values, unit, meaning});
    };
    const auto counts = [&](const std::string& name, const std::vector<std::int64_t>& values, const std::string& meaning) {
        results.push_back({brownian_group + "series/" + name, {values.size()}, values, "1", meaning});
    };
    numbers("time", series.time, "s", "times of the samples");
    numbers("coordination", series.coordination, "1", "mean number of contacts");
    numbers("energy", series.energy, "J", "energy of all pairs, without sliding and rolling");
    numbers("sliding_energy", series.sliding_energy, "J", "elastic energy of the tangential displacements of the contacts");
    numbers("rolling_energy", series.rolling_energy, "J", "elastic energy of the rolling displacements of the contacts");
    numbers("mean_gap", series.mean_gap, "m", "mean gap of the contacts");
    counts("clusters", series.clusters, "particles joined by contacts, single ones included");
    counts("largest_cluster", series.largest, "particles in the largest cluster");
    counts("percolating_axes", series.percolating, "axes along which contacts reach around the box");
    counts("contacts_formed", series.formed, "contacts that are new since the sample before");
    counts("contacts_broken", series.broken, "contacts that are gone since the sample before");
}

}  // namespace

Results datasets_of(const generators::BrownianRun& run, const PairPotential& potential, const BrownianOptions& options) {
    const TimeStep& step = run.time_step;
    const double thermal = boltzmann_constant * options.temperature;
    const double farthest = std::isnan(options.cutoff_gap) ? mean_radius(run.packing) : options.cutoff_gap;
    Results results = {
        io::scalar(brownian_group + "time", run.time, "s", "simulated time"),
        io::integer(brownian_group + "steps", run.steps, "time steps"),
        io::text(brownian_group + "ended_by", run.ended_by, "criterion that ended the run: time, coordination or plateau"),
        io::scalar(brownian_group + "coordination", run.coordination, "1", "mean number of contacts at the end"),
        io::scalar(brownian_group + "contact_tolerance", options.contact_tolerance, "1",
                   "pairs nearer than (1 + x) (r_i + r_j) touch"),
        io::scalar(brownian_group + "diffusion_time", step.diffusion_time, "s", "R^2/D of a particle of mean radius"),
        io::scalar(brownian_group + "time_step/value", step.time_step, "s", "time step"),
        io::integer(brownian_group + "time_step/stages", step.stages, "force evaluations per step"),
        io::integer(brownian_group + "time_step/far_interval", step.far_interval, "steps between evaluations of the far forces"),
        io::scalar(brownian_group + "time_step/stability_bound", step.stability_bound, "s", "longest stable time step"),
        io::scalar(brownian_group + "time_step/accuracy_bound", step.accuracy_bound, "s", "longest accurate time step"),
        io::text(brownian_group + "time_step/reason", step.reason, "bound that sets the time step"),
        io::scalar(brownian_group + "potential/barrier_height", potential.barrier_height(farthest) / thermal, "1",
                   "barrier above the secondary minimum, over kB T"),
        io::scalar(brownian_group + "potential/contact_energy", potential.contact_minimum().energy / thermal, "1",
                   "energy of two particles in contact, over kB T"),
        io::scalar(brownian_group + "potential/cut_gap", potential.cut_gap(), "m", "below this gap the contact is elastic"),
        io::scalar(brownian_group + "potential/contact_stiffness", potential.contact().stiffness, "N/m",
                   "stiffness of the contact")};
    add_series(results, run.series);
    return results;
}

Results heterogeneity_of(const generators::BrownianRun& run, const Packing& start, const BrownianOptions& options,
                         const Progress& progress) {
    std::vector<double> time;
    std::vector<double> width;
    std::vector<double> coordination;
    const auto measure = [&](double at, const Eigen::Matrix3Xd& positions) {
        progress.update("degree of heterogeneity",
                        static_cast<double>(time.size()) / static_cast<double>(run.snapshots.size() + 2));
        const Packing packing{run.packing.cell, positions, run.packing.radii};
        const characterize::PoreSizes pores = characterize::measure_pores(packing);
        time.push_back(at);
        width.push_back(characterize::fit_degree_of_heterogeneity(pores, mean_radius(packing)).a);
        coordination.push_back(coordination_number(find_contacts(packing, options.contact_tolerance)));
    };
    measure(0, start.positions);
    for (const Snapshot& snapshot : run.snapshots) {
        measure(snapshot.time, snapshot.positions);
    }
    measure(run.time, run.packing.positions);
    const std::vector<std::size_t> shape = {time.size()};
    const std::string series = brownian_group + "heterogeneity/";
    return {{series + "time", shape, time, "s", "start, snapshots and end"},
            {series + "a", shape, width, "1", "degree of heterogeneity"},
            {series + "coordination", shape, coordination, "1", "mean number of contacts"}};
}

Table table_of(const generators::BrownianRun& run) {
    const TimeStep& step = run.time_step;
    return {{"particles", std::to_string(run.packing.size())},
            {"box", describe(run.packing.cell)},
            {"volume fraction", with_unit(volume_fraction(run.packing), "1")},
            {"simulated", with_unit(run.time, "s") + " in " + std::to_string(run.steps) + " steps"},
            {"time step", with_unit(step.time_step, "s") + " (" + std::to_string(step.stages) + " stages), set by " + step.reason +
                              "; stable up to " + with_unit(step.stability_bound, "s")},
            {"ended by", run.ended_by},
            {"coordination number", with_unit(run.coordination, "1")},
            {"largest cluster", std::to_string(run.series.largest.back()) + " particles"}};
}

}  // namespace coagula::stages
