// SPDX-License-Identifier: GPL-3.0-or-later
// generate brownian: coagulation of a stabilised suspension by Brownian dynamics.
#include "brownian_by_lammps.hpp"
#include "brownian_checkpoint.hpp"
#include "brownian_results.hpp"
#include "potential.hpp"
#include "size_distribution_text.hpp"

#include <coagula/generators/coagulation.hpp>
#include <coagula/io/checkpoint_file.hpp>
#include <coagula/io/checkpoint_lock.hpp>
#include <coagula/stages/bond_potential.hpp>
#include <coagula/stages/provenance.hpp>

#include <filesystem>
#include <iterator>

namespace coagula::stages {

namespace {

using generators::BrownianCheckpoint;
using generators::BrownianControl;
using generators::BrownianOptions;
using generators::PairPotential;
using generators::PlateauOf;

BrownianOptions brownian_options(const Arguments& arguments) {
    BrownianOptions options;
    options.temperature = arguments.quantity("temperature");
    options.viscosity = arguments.quantity("viscosity");
    options.slowing = arguments.quantity("slowing");
    options.resistance = {.tangential_stiffness = arguments.optional_quantity("contact-shear-stiffness").value_or(unset),
                          .friction = arguments.optional_quantity("friction").value_or(unset),
                          .rolling_stiffness = arguments.optional_quantity("rolling-stiffness").value_or(unset),
                          .rolling_friction = arguments.optional_quantity("rolling-friction").value_or(unset)};
    options.cutoff_gap = arguments.optional_quantity("cutoff-gap").value_or(unset);
    options.integrator =
        arguments.text("integrator") == "euler" ? generators::Integrator::euler : generators::Integrator::stabilised;
    options.sedimentation = {.gravity = arguments.optional_quantity("gravity").value_or(unset),
                             .density_difference = arguments.optional_quantity("density-difference").value_or(unset)};
    options.flow = {.rate = arguments.optional_quantity("shear-rate").value_or(unset),
                    .amplitude = arguments.optional_quantity("shear-amplitude").value_or(unset),
                    .frequency = arguments.optional_quantity("shear-frequency").value_or(unset)};
    options.time_step = arguments.optional_quantity("time-step").value_or(unset);
    options.stop_time = arguments.optional_quantity("stop-time").value_or(unset);
    options.stop_coordination = arguments.optional_quantity("stop-coordination").value_or(unset);
    const std::string plateau = arguments.text("stop-plateau");
    options.stop_plateau = plateau == "coordination" ? PlateauOf::coordination
                           : plateau == "mean-gap"   ? PlateauOf::mean_gap
                                                     : PlateauOf::nothing;
    options.plateau_time = arguments.optional_quantity("plateau-time").value_or(unset);
    options.plateau_change = arguments.quantity("plateau-change");
    options.contact_tolerance = arguments.quantity("contact-tolerance");
    options.sample_interval = arguments.optional_quantity("sample-interval").value_or(unset);
    for (const std::string& time : split(arguments.text("snapshots", ""))) {
        options.snapshot_times.push_back(parse_quantity(time, "s", physical::duration));
    }
    options.seed = static_cast<std::uint64_t>(arguments.count("seed"));
    return options;
}

/// What only a suspension has that is made here.
const std::vector<std::string> of_suspension = {"particles",         "volume-fraction",         "radius",
                                                "size-distribution", "equilibration-potential", "equilibration-time"};

/// Refuses options that nothing reads where a run goes on from a packing. The table of options cannot do it, because it does not
/// know Python's `start`. A given packing has no double layer but that of the run.
void check_beside_start(const Arguments& arguments) {
    std::vector<std::string> not_read = of_suspension;
    if (arguments.has("potential-table")) {
        not_read.insert(not_read.end(),
                        {"debye-length", "ionic-strength", "double-layer", "hamaker-constant", "permittivity", "valency"});
    }
    for (const std::string& name : not_read) {
        if (arguments.given(name)) {
            throw InputError(arguments.spelled(name) + " is not read where the run goes on from a packing" +
                             (arguments.has("potential-table") ? " by a table of the potential" : ""));
        }
    }
}

/// What the options need to be read.
void add_conditions(std::vector<Option>& options) {
    std::vector<std::string> of_run;  // those of the potential apart, and what a picture needs
    for (const Option& option : options) {
        of_run.push_back(option.name);
    }
    for (const Option& option : potential_options()) {
        std::erase(of_run, option.name);
    }
    for (const char* name : {"radius", "start", "force"}) {
        std::erase(of_run, name);
    }
    not_read_with(options, of_suspension, "start");
    not_read_with(options, {"equilibration-potential", "contact-shear-stiffness", "rolling-stiffness"}, "law", {"depletion"});
    not_read_with(options, of_run, "potential-curve");
    read_only_with(options, {"picture"}, "potential-curve");
    read_only_with(options, {"friction"}, "contact-shear-stiffness");
    read_only_with(options, {"rolling-friction"}, "rolling-stiffness");
    read_only_with(options, {"density-difference"}, "gravity");
    read_only_with(options, {"shear-frequency"}, "shear-amplitude");
    not_read_with(options, {"gravity", "snapshots", "heterogeneity", "shear-amplitude"}, "shear-rate");
    not_read_with(options, {"gravity", "snapshots", "heterogeneity"}, "shear-amplitude");
    read_only_with(options, {"plateau-time", "plateau-change"}, "stop-plateau", {"coordination", "mean-gap"});
    read_only_with(options, {"checkpoint-interval"}, "checkpoint");
    // Its styles have no overdamped particles that turn, and nothing here restarts it.
    not_read_with(
        options,
        {"contact-shear-stiffness", "rolling-stiffness", "gravity", "shear-rate", "shear-amplitude", "integrator", "checkpoint"},
        "engine", {"lammps"});
}

Suspension suspension_of(const Arguments& arguments, const Eigen::VectorXd& given, std::uint64_t seed) {
    if (!arguments.has("volume-fraction")) {
        throw InputError(arguments.caller_of() + " needs " + arguments.spelled("volume-fraction") + ", or " +
                         arguments.spelled("start"));
    }
    return {{arguments.quantity("volume-fraction"), radii_of(arguments, given, seed), seed},
            arguments.quantity("equilibration-potential"),
            arguments.optional_quantity("equilibration-time").value_or(unset)};
}

/// Random positions, brought to equilibrium at a high surface potential.
Packing made_suspension(const BrownianRun& run, const Progress& progress) {
    const Suspension& suspension = *run.suspension;
    return stabilised_suspension(
        suspension.placed,
        [&](double radius) { return make_stable_potential(run.forces, radius, suspension.stabilising_potential); }, run.motion,
        suspension.duration, progress);
}

/// What must be the same for a run to go on: everything but when it stops and where results go.
std::string fingerprint(const Arguments& arguments) {
    Json options = arguments.to_json();
    for (const char* name : {"output", "force", "quiet", "json", "threads", "checkpoint", "checkpoint-interval", "picture",
                             "stop-time", "stop-coordination"}) {
        options.erase(name);
    }
    return options.dump();
}

/// Samples that follow from the stop time go on as they began, whatever it is now. The first one is at time 0.
void keep_sample_interval(const BrownianCheckpoint& checkpoint, BrownianOptions& options) {
    if (std::isnan(options.sample_interval) && checkpoint.series.time.size() > 1) {
        options.sample_interval = checkpoint.series.time[1];
    }
}

/// What a gel in the well of an attraction says about its bonds.
void append_bonds(Findings& found, const PairForces& forces, const PairPotential& potential, double radius, double temperature) {
    Findings bonds = bond_findings(potential, radius, temperature, forces.depletion->range_of(radius));
    std::move(bonds.results.begin(), bonds.results.end(), std::back_inserter(found.results));
    std::move(bonds.table.begin(), bonds.table.end(), std::back_inserter(found.table));
}

/// The run, from its checkpoint if there is one.
generators::BrownianRun run_or_resume(const BrownianRun& run, const Packing& start, const PairPotential& potential,
                                      BrownianOptions& options, const Progress& progress) {
    const std::string& path = run.checkpoint.path;
    if (!run.checkpoint.wanted()) {
        return simulate_brownian(start, potential, options, progress);
    }
    const io::CheckpointLock lock(path);
    const std::string signature = run.checkpoint.signature + io::positions_sha256(start);
    std::optional<BrownianCheckpoint> resumed;
    if (std::filesystem::exists(path)) {
        resumed = read_brownian_checkpoint(path, signature);
        keep_sample_interval(*resumed, options);
    }
    BrownianControl control;
    control.resume = resumed ? &*resumed : nullptr;
    Stopwatch since;
    control.checkpoint_due = [&] { return since.seconds() > run.checkpoint_interval; };
    control.on_checkpoint = [&](const BrownianCheckpoint& checkpoint) {
        write_checkpoint(path, signature, checkpoint);
        since = Stopwatch();
    };
    return io::with_checkpoint(path, [&] { return simulate_brownian(start, potential, options, progress, control); });
}

/// Appends what is known of LAMMPS, which moved the particles.
void append_engine(Findings& found, const LammpsBrownianRun& made) {
    const std::string group = found.group + "/engine/";
    found.engine = "LAMMPS " + made.version;
    found.results.push_back(io::text(group + "name", found.engine, "program that moved the particles, with its version"));
    found.results.push_back(
        io::scalar(group + "memory", made.memory, "s", "mass times mobility: a particle forgets its velocity in this time"));
    found.table.emplace_back("moved by", found.engine);
}

/// Wrong options of the potential and of the engine shall not wait for the equilibration.
void check_motion(const BrownianRun& run, const Packing* start, double radius) {
    if (run.lammps) {
        const Eigen::VectorXd& radii = start != nullptr ? start->radii : run.suspension->placed.radii;
        check_for_lammps(radii, start != nullptr ? &start->cell : nullptr, run.motion.cutoff_gap);
    }
    if (start != nullptr || std::isnan(radius)) {
        return;
    }
    const PairPotential potential = make_potential(run.forces, radius);
    if (run.lammps) {
        choose_inertial_step(potential, radius, radius, run.motion);
    } else {
        choose_time_step(potential, radius, radius, run.motion);
    }
}

/// What follows from the range of the attraction where it is not given: how far forces reach, and what counts as a contact.
void take_ranges(const Arguments& arguments, BrownianRun& run, double radius) {
    const double range = run.forces.depletion->range_of(radius);
    const double rest = make_potential(run.forces, radius).contact().equilibrium_gap;
    if (!arguments.has("cutoff-gap")) {
        run.motion.cutoff_gap = rest + 2 * range;
    }
    if (!arguments.given("contact-tolerance")) {
        run.motion.contact_tolerance = (rest + range) / (2 * radius);
    }
}

void check_end(const Arguments& arguments, const BrownianOptions& options) {
    if (std::isnan(options.stop_time) && std::isnan(options.stop_coordination) && options.stop_plateau == PlateauOf::nothing) {
        throw InputError(arguments.caller_of() + " needs " + arguments.spelled("stop-time") + ", " +
                         arguments.spelled("stop-coordination") + " or " + arguments.spelled("stop-plateau"));
    }
}

/// The structure and the findings of a run that has ended. @param first the packing that it began with.
Generated described(const BrownianRun& run, const Packing& first, const PairPotential& potential, const BrownianOptions& options,
                    generators::BrownianRun made, const Progress& progress) {
    Findings found{
        .group = "/generation/brownian", .results = datasets_of(made, potential, options), .table = table_of(made, options)};
    if (run.forces.depletion) {
        append_bonds(found, run.forces, potential, mean_radius(first), options.temperature);
    }
    if (run.heterogeneity) {
        const Results measured = heterogeneity_of(made, first, options, progress);
        found.results.insert(found.results.end(), measured.begin(), measured.end());
    }
    check_finite(found.results);
    io::Structure structure{std::move(made.packing), std::move(made.contacts), {}, made.time};
    for (generators::Snapshot& snapshot : made.snapshots) {
        structure.earlier.push_back({snapshot.time, std::move(snapshot.positions)});
    }
    return {std::move(structure), std::move(found)};
}

}  // namespace

BrownianRun brownian_run(const Arguments& arguments, const Packing* start, const Eigen::VectorXd& radii) {
    BrownianRun run;
    run.motion = brownian_options(arguments);
    check_end(arguments, run.motion);
    if (arguments.has("shear-amplitude") && !arguments.has("shear-frequency")) {
        throw InputError(arguments.spelled("shear-amplitude") + " needs " + arguments.spelled("shear-frequency"));
    }
    if (arguments.text("hydrodynamics") == "mean-field" && (start != nullptr || arguments.has("volume-fraction"))) {
        run.motion.slowing *=
            generators::mean_field_slowing(start != nullptr ? volume_fraction(*start) : arguments.quantity("volume-fraction"));
    }
    run.forces = pair_forces(arguments);
    const double radius = radii.size() > 0 ? radii.mean() : arguments.optional_quantity("radius").value_or(unset);
    if (start != nullptr) {
        check_beside_start(arguments);
    } else {
        run.suspension = suspension_of(arguments, radii, run.motion.seed);
    }
    if (run.forces.depletion) {
        take_ranges(arguments, run, start != nullptr ? mean_radius(*start) : run.suspension->placed.radii.mean());
    }
    run.lammps = engine_of(arguments, "lammps");
    check_motion(run, start, radius);
    run.heterogeneity = arguments.flag("heterogeneity");
    run.checkpoint = {arguments.text("checkpoint", ""), fingerprint(arguments)};
    if (arguments.has("checkpoint-interval")) {  // a sweep has none
        run.checkpoint_interval = arguments.quantity("checkpoint-interval");
    }
    return run;
}

Generated generate(const BrownianRun& run, const Packing* start, const Progress& progress) {
    BrownianOptions options = run.motion;
    const Packing first = start != nullptr ? *start : made_suspension(run, progress);
    const PairPotential potential = make_potential(run.forces, mean_radius(first));
    if (run.lammps) {
        LammpsBrownianRun made = brownian_by_lammps(*run.lammps, first, potential, options, progress);
        Generated generated = described(run, first, potential, options, std::move(made.run), progress);
        append_engine(generated.findings, made);
        return generated;
    }
    generators::BrownianRun made = run_or_resume(run, first, potential, options, progress);
    return described(run, first, potential, options, std::move(made), progress);
}

Generated Trajectory::next(const BrownianRun& run, const Progress& progress) {
    if (!start_) {
        start_ = made_suspension(run, progress);
    }
    if (run.lammps) {
        return generate(run, &*start_, progress);
    }
    const PairPotential potential = make_potential(run.forces, mean_radius(*start_));
    std::optional<BrownianCheckpoint> reached;
    BrownianControl control{.checkpoint_due = {},
                            .on_checkpoint = [&](const BrownianCheckpoint& here) { reached = here; },
                            .at_end = true,
                            .resume = reached_ ? &*reached_ : nullptr};
    generators::BrownianRun made = simulate_brownian(*start_, potential, run.motion, progress, control);
    if (reached) {
        reached_ = std::move(reached);
    }
    return described(run, *start_, potential, run.motion, std::move(made), progress);
}

Verb generate_brownian_verb() {
    std::vector<Option> options = {
        count("particles", "number of particles", "8000", within(2, 1e8)),
        quantity("volume-fraction", "1", "volume of the spheres over that of the box; required without --start", "",
                 between(0, 0.55)),
        particle_radius("mean radius of the particles; required, unless a table or a file gives the radii"),
        reads(text(
            "size-distribution", "NAME",
            "monodisperse, normal:S, lognormal:S (S = standard deviation over the mean) or FILE.csv (columns radius, fraction)",
            "monodisperse")),
        reads(text("start", "FILE", "go on from the packing in this file instead of a suspension in equilibrium")),
        quantity("equilibration-potential", "V", "surface potential at which the suspension is brought to equilibrium", "50mV",
                 within(1e-6, 1)),
        quantity("equilibration-time", "s", "duration of that equilibration; a quarter of R^2/D when not given", "",
                 physical::duration)};
    for (Option& option : potential_options()) {
        options.push_back(std::move(option));
    }
    const std::vector<Option> rest = {
        quantity("viscosity", "Pa s", "viscosity of the liquid", "1e-3", within(1e-9, 1e9)),
        quantity("slowing", "1", "diffusion coefficient of a particle over that of a free one, by hydrodynamics on average", "1",
                 within(1e-6, 1)),
        choice("hydrodynamics", {"none", "mean-field"},
               "mean-field: diffusion is also reduced by the factor (1 - 1.56 phi)(1 - 0.27 phi)", "none"),
        formerly("tangential-stiffness",
                 quantity("contact-shear-stiffness", "N/m", "shear stiffness of a contact; contacts slide freely when not given",
                          "", physical::stiffness)),
        quantity(
            "friction", "1",
            "coefficient of friction: a contact slips beyond this times its elastic normal force; it never slips when not given",
            "", physical::friction),
        quantity("rolling-stiffness", "N/m", "rolling stiffness of a contact; contacts roll freely when not given", "",
                 physical::stiffness),
        quantity("rolling-friction", "1",
                 "coefficient of rolling friction: a contact rolls beyond this; its resistance has no limit when not given", "",
                 physical::friction),
        quantity("gravity", "m/s2", "acceleration by which particles settle towards a floor; they do not settle when not given", "",
                 within(1e-9, 1e9)),
        quantity("density-difference", "kg/m3", "density of the particles less that of the liquid, with --gravity", "",
                 within(-1e6, 1e6)),
        quantity("shear-rate", "1/s",
                 "shear along x, gradient along z, at this rate of strain, and measure the stress; 0 measures it at rest", "",
                 within(-1e12, 1e12)),
        quantity("shear-amplitude", "1", "oscillating shear of this strain amplitude instead, with --shear-frequency", "",
                 within(1e-9, 1e3)),
        quantity("shear-frequency", "Hz", "frequency of the oscillating shear", "", physical::frequency),
        choice("integrator", {"stabilised", "euler"}, "time integration: stabilised is SK-ROCK, euler is Euler-Maruyama",
               "stabilised"),
        quantity("time-step", "s", "time step; chosen from the potential when not given", "", physical::time),
        quantity("stop-time", "s", "simulated time at which the run ends", "", physical::duration),
        quantity("stop-coordination", "1", "the run ends at a sample of the time series with this mean number of contacts", "",
                 between(0, 12)),
        choice("stop-plateau", {"none", "coordination", "mean-gap"}, "the run ends as soon as this quantity is level", "none"),
        quantity("plateau-time", "s",
                 "time over which --stop-plateau compares the means of the two halves; R^2/D/10 when not given", "",
                 physical::time),
        quantity("plateau-change", "1", "relative difference of these means below which the quantity is level", "0.01",
                 within(1e-12, 1)),
        quantity("contact-tolerance", "1",
                 "pairs nearer than (1 + X) (r_i + r_j) are in contact; with depletion the range of the attraction when not given",
                 "0.01", within(0, 0.5)),
        quantity("sample-interval", "s", "time between samples of the time series; a 200th of the stop time when not given", "",
                 physical::time),
        text("snapshots", "LIST", "times at which positions are kept, such as 1ms,2ms"),
        flag("heterogeneity", "measure the degree of heterogeneity at the start, at the snapshots and at the end"),
        writes(text("checkpoint", "FILE",
                    "file for the state of the run; a run that finds it goes on from there, also to another stop time")),
        quantity("checkpoint-interval", "s", "wall-clock time between checkpoints", "60s", physical::duration),
        count("seed", "seed of the random numbers", "1", at_least(0)),
        output("HDF5 file to write"),
        flag("force", "replace an existing file")};
    options.insert(options.end(), rest.begin(), rest.end());
    const std::vector<Option> engine =
        engine_options({"builtin", "lammps"}, "what moves the particles: coagula itself, or LAMMPS, which must be installed");
    options.insert(options.end() - 3, engine.begin(), engine.end());
    add_conditions(options);
    return {.name = "generate brownian",
            .summary = "coagulate a stabilised suspension by Brownian dynamics with DLVO forces or depletion attraction",
            .input = "",
            .options = std::move(options)};
}

}  // namespace coagula::stages
