// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_results.hpp"

#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/io/structure_file.hpp>

#include <cmath>

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

void add_stress(Results& results, const StressSeries& stress) {
    const auto add = [&](const std::string& name, const std::vector<double>& values, const std::string& unit,
                         const std::string& meaning) {
        results.push_back({brownian_group + "series/" + name, {values.size()}, values, unit, meaning});
    };
    add("strain", stress.strain, "1", "strain of the shear at the time of the sample");
    add("shear_stress", stress.shear_stress, "Pa", "shear stress of the particles, mean since the sample before");
    add("contact_shear_stress", stress.contact_shear_stress, "Pa", "the part of it that opposes sliding in contacts");
    add("normal_stress_x", stress.normal_stress_x, "Pa", "normal stress of the particles along the flow, tension > 0");
    add("normal_stress_y", stress.normal_stress_y, "Pa", "the same along the vorticity");
    add("normal_stress_z", stress.normal_stress_z, "Pa", "the same along the gradient");
}

/// Viscosity or moduli. The second half of the run counts.
void add_response(Results& results, const FlowResponse& response, const generators::BrownianRun& run,
                  const BrownianOptions& options) {
    const std::string group = brownian_group + "flow/";
    const auto add = [&](const std::string& name, double value, double error, const std::string& unit, const std::string& meaning) {
        if (!std::isfinite(value)) {
            return;  // of an oscillation that has no whole period
        }
        results.push_back(io::scalar(group + name, value, unit, meaning));
        results.push_back(
            io::scalar(group + name + "_stderr", error, unit,
                       "standard error of " + name + " by blocks" + (std::isnan(error) ? "; NaN: too few blocks" : "")));
    };
    if (options.flow.oscillates()) {
        add("storage_modulus", response.storage_modulus, response.storage_modulus_error, "Pa",
            "shear stress of the particles in phase with the strain, over the amplitude");
        add("loss_modulus", response.loss_modulus, response.loss_modulus_error, "Pa",
            "shear stress of the particles in phase with the rate of strain, over the amplitude");
    } else {
        add("shear_stress", response.shear_stress, response.shear_stress_error, "Pa",
            "mean shear stress of the particles over the second half of the run");
        add("first_normal_difference", response.first_normal_difference, response.first_normal_difference_error, "Pa",
            "normal stress along the flow less that along the gradient");
        if (options.flow.rate != 0) {
            add("particle_viscosity", response.particle_viscosity, response.particle_viscosity_error, "Pa s",
                "that shear stress over the rate of strain");
        }
    }
    results.push_back(io::integer(group + "blocks", response.blocks, "blocks, or cycles, that the standard errors come from"));
    const double volume = run.packing.cell.volume();
    results.push_back(io::scalar(group + "brownian_pressure",
                                 boltzmann_constant * options.temperature * static_cast<double>(run.packing.size()) / volume, "Pa",
                                 "kB T times the number density, a part of minus the normal stresses"));
    results.push_back(io::scalar(group + "liquid_viscosity", options.viscosity * (1 + 2.5 * volume_fraction(run.packing)), "Pa s",
                                 "that of the liquid with single particles in it (Einstein), to which that of the particles adds"));
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
    if (options.flow.given()) {
        add_stress(results, run.series.stress);
        add_response(results, flow_response(options.flow, run.series.time, run.series.stress), run, options);
    }
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

Table table_of(const generators::BrownianRun& run, const BrownianOptions& options) {
    const TimeStep& step = run.time_step;
    Table table = {{"particles", std::to_string(run.packing.size())},
                   {"box", describe(run.packing.cell)},
                   {"volume fraction", with_unit(volume_fraction(run.packing), "1")},
                   {"simulated", with_unit(run.time, "s") + " in " + std::to_string(run.steps) + " steps"},
                   {"time step", with_unit(step.time_step, "s") + " (" + std::to_string(step.stages) + " stages), set by " +
                                     step.reason + "; stable up to " + with_unit(step.stability_bound, "s")},
                   {"ended by", run.ended_by},
                   {"coordination number", with_unit(run.coordination, "1")},
                   {"largest cluster", std::to_string(run.series.largest.back()) + " particles"}};
    if (!options.flow.given()) {
        return table;
    }
    const auto measured = [](double value, double error, const std::string& unit) {
        return with_unit(value, unit) + (std::isnan(error) ? "" : " +- " + with_unit(error, unit));
    };
    const FlowResponse response = flow_response(options.flow, run.series.time, run.series.stress);
    table.emplace_back("strain", with_unit(run.series.stress.strain.back(), "1"));
    if (options.flow.oscillates()) {
        if (!std::isfinite(response.storage_modulus)) {
            table.emplace_back("moduli of particles", "not measured: the run ends before a period does");
            return table;
        }
        table.emplace_back("moduli of particles", "G' " + measured(response.storage_modulus, response.storage_modulus_error, "Pa") +
                                                      ", G'' " +
                                                      measured(response.loss_modulus, response.loss_modulus_error, "Pa"));
        return table;
    }
    table.emplace_back("shear stress", measured(response.shear_stress, response.shear_stress_error, "Pa"));
    if (options.flow.rate != 0) {
        table.emplace_back("viscosity of particles",
                           measured(response.particle_viscosity, response.particle_viscosity_error, "Pa s"));
    }
    return table;
}

}  // namespace coagula::stages
