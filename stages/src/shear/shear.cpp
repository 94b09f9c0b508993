// SPDX-License-Identifier: GPL-3.0-or-later
// shear: elastic response of the bonded packing, or its response to harmonic strain.
#include "frequency_list.hpp"
#include "frequency_results.hpp"
#include "load_structure_results.hpp"
#include "network_keys.hpp"
#include "orientation_list.hpp"
#include "quasistatic_run.hpp"
#include "rheometer_run.hpp"
#include "shear_by_lammps.hpp"
#include "shear_by_petsc.hpp"
#include "shear_conditions.hpp"
#include "shear_results.hpp"

#include <coagula/characterize/inner_particles.hpp>
#include <coagula/io/contact_model_file.hpp>
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/load_structure.hpp>
#include <coagula/stages/shear.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <map>
#include <optional>

namespace coagula::stages {

namespace {

mechanics::LinearSolver chosen_solver(const std::string& name) {
    if (name == "direct") {
        return mechanics::LinearSolver::direct;
    }
    return name == "iterative" ? mechanics::LinearSolver::iterative : mechanics::LinearSolver::automatic;
}

/// The model file would replace the option without a word.
void check_given_once(const Arguments& arguments, const std::string& option, double given, double used) {
    if (arguments.given(option) && given != used) {
        throw InputError(arguments.spelled(option) + " is " + to_text(given) + " N/m, but " + arguments.text("model") + " has " +
                         to_text(used) + " N/m: give it in one of the two places");
    }
}

/// The contact: springs from the options, and what the model file says.
ContactModel contact_model(const Arguments& arguments) {
    const ContactModel springs{.normal_stiffness = arguments.quantity("normal-stiffness"),
                               .shear_stiffness = arguments.quantity("shear-stiffness")};
    if (!arguments.has("model")) {
        return springs;
    }
    ContactModel model = io::read_contact_model(arguments.text("model"), springs);
    check_given_once(arguments, "normal-stiffness", springs.normal_stiffness, model.normal_stiffness);
    check_given_once(arguments, "shear-stiffness", springs.shear_stiffness, model.shear_stiffness);
    return model;
}

/// Losses act at a frequency only.
void check_elastic(const Arguments& arguments, const ContactModel& model) {
    for (const ContactParameter& parameter : contact_parameters()) {
        if (parameter.role == ContactRole::loss && parameter.is_set(model)) {
            throw InputError(arguments.text("model") + " has " + parameter.name + ", a loss that acts at a frequency only: give " +
                             arguments.spelled("frequency") + " or " + arguments.spelled("frequency-sweep"));
        }
    }
}

/// Parameters that the model has but that play no part at vanishing strain, by name.
std::string without_effect(const ContactModel& model) {
    std::string names;
    for (const ContactParameter& parameter : contact_parameters()) {
        if (parameter.role == ContactRole::limit && parameter.is_set(model)) {
            names += (names.empty() ? "" : ", ") + parameter.name;
        }
    }
    return names;
}

/// Says in the results what of the model did not act.
void append_without_effect(Findings& found, const ContactModel& model) {
    const std::string names = without_effect(model);
    if (!names.empty()) {
        found.results.push_back(
            io::text(found.group + "/without_effect", names, "parameters of the model that play no part at vanishing strain"));
        found.table.emplace_back("without effect", names + ": nothing breaks, slips or ages at vanishing strain");
    }
}

mechanics::LinearOptions linear_options(const Arguments& arguments, const ContactModel& model) {
    mechanics::LinearOptions options;
    options.normal_stiffness = model.normal_stiffness;
    options.shear_stiffness = model.shear_stiffness;
    options.solver = chosen_solver(arguments.text("solver"));
    options.memory_limit = arguments.quantity("memory-limit");
    options.tolerance = arguments.quantity("tolerance");
    options.modulus_tolerance = arguments.quantity("modulus-tolerance");
    return options;
}

/// The scheme by which the network is brought to rest; none where the user asks for none.
std::optional<mechanics::RelaxationScheme> relaxation_scheme(const Arguments& arguments, const ContactModel& model) {
    const std::string& scheme = arguments.text("relax");
    if (scheme == "none") {
        return std::nullopt;
    }
    const std::string others = arguments.spelled("method", "quasistatic") + " and dem";
    if (!std::isnan(model.prestress)) {
        throw InputError(arguments.spelled("relax") +
                         " brings bonds of rest length r_i + r_j to rest and takes them as unstressed there, but " +
                         arguments.text("model") + " has prestress, which every bond would carry again after the relaxation; " +
                         others + " bring a prestressed network to rest themselves");
    }
    if (!std::isnan(model.young_modulus)) {
        throw InputError(arguments.spelled("relax") + " supports linear springs only, but " + arguments.text("model") +
                         " has young_modulus; " + others + " with " + arguments.spelled("rest-length", "radii") +
                         " bring such contacts to rest");
    }
    return scheme == "paper" ? mechanics::RelaxationScheme::stopped_steps : mechanics::RelaxationScheme::minimise;
}

/// The network at rest, if the user asks for it.
std::optional<mechanics::RelaxedNetwork> relaxed(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds,
                                                 const Progress& progress) {
    if (!run.relax) {
        return std::nullopt;
    }
    mechanics::RelaxationOptions options;
    options.normal_stiffness = run.model.normal_stiffness;
    options.shear_stiffness = run.model.shear_stiffness;
    options.scheme = *run.relax;
    return mechanics::relax(packing, bonds, options, progress);
}

void append_load_structure(Findings& found, const mechanics::LoadStructure& structure, bool periodic) {
    for (io::Dataset& dataset : load_structure_datasets(structure, periodic)) {
        found.results.push_back(std::move(dataset));
    }
    for (io::ParticleField& field : load_structure_fields(structure)) {
        found.fields.push_back(std::move(field));
    }
    for (auto& line : load_structure_table(structure)) {
        found.table.push_back(std::move(line));
    }
    found.bond_results = bond_datasets(structure);
    found.bond_fields = load_structure_bond_fields(structure);
}

/// @param before the packing before it was relaxed, which tells inside and surface.
Findings linear_response(const ShearRun& run, const Packing& before, const Packing& packing, const ContactNetwork& bonds,
                         const Progress& progress) {
    mechanics::LinearOptions options = run.linear;
    options.bond_tangents = mechanics::bond_tangents(packing, bonds, run.model);
    if (!before.cell.is_periodic()) {
        const characterize::FreeSurface surface = characterize::free_surface(before);
        options.held = surface.outer;
        options.volume = surface.inner_volume;
    }
    std::optional<PetscSolver> petsc;
    if (run.petsc) {
        petsc.emplace(*run.petsc, progress).serve(options);
    }
    const mechanics::LinearResponse response = mechanics::solve_linear(packing, bonds, options, progress);
    Findings found{.group = "/mechanics/linear",
                   .results = datasets_of(response, run.bond_tolerance, options),
                   .fields = fields_of(response),
                   .table = table_of(response),
                   .engine = petsc ? "PETSc " + petsc->version() : ""};
    append_load_structure(found, mechanics::find_load_structure(packing, bonds, response, {.held = options.held}),
                          packing.cell.is_periodic());
    return found;
}

Findings frequency_response(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress) {
    const auto response =
        mechanics::solve_frequency_sweep(packing, bonds, run.model, run.frequencies, {.tolerance = run.linear.tolerance}, progress);
    Findings found{.group = "/mechanics/frequency",
                   .results = datasets_of(response, run.bond_tolerance, run.model),
                   .table = table_of(response)};
    const mechanics::FrequencyPoint& last = response.points.back();
    if ((last.modulus.diagonal().tail<3>().array() == std::complex<double>(0)).any()) {
        append_reason(found, packing, bonds, progress);
    }
    return found;
}

/// An equilibrium has no frequency, and a sweep of amplitudes, in which contacts age between the points, has one.
void check_frequencies(const Arguments& arguments, const std::vector<double>& frequencies) {
    if (arguments.text("method") != "quasistatic" || frequencies.empty()) {
        return;
    }
    if (!arguments.has("amplitudes")) {
        throw InputError(arguments.spelled("method", "quasistatic") + " reads a frequency only with " +
                         arguments.spelled("amplitudes") + ": a ramp has none");
    }
    if (frequencies.size() > 1) {
        throw InputError(arguments.spelled("method", "quasistatic") + " runs at one frequency, but " +
                         std::to_string(frequencies.size()) + " are given");
    }
}

ShearMethod method_of(const Arguments& arguments, const std::vector<double>& frequencies) {
    const std::string& name = arguments.text("method");
    if (name == "dem") {
        return ShearMethod::dem;
    }
    return name == "quasistatic" ? ShearMethod::quasistatic : frequencies.empty() ? ShearMethod::linear : ShearMethod::frequency;
}

/// An engine computes by the methods that it knows.
void check_engine(const Arguments& arguments) {
    const std::map<std::string, std::string> method_of_engine = {{"lammps", "dem"}, {"petsc", "linear"}};
    const auto needed = method_of_engine.find(arguments.text("engine"));
    if (needed != method_of_engine.end() && arguments.text("method") != needed->second) {
        throw InputError(arguments.spelled("engine", needed->first) + " computes by " +
                         arguments.spelled("method", needed->second) + " only");
    }
}

}  // namespace

std::string ShearRun::group() const {
    switch (method) {
        case ShearMethod::frequency:
            return "/mechanics/frequency";
        case ShearMethod::quasistatic:
            return quasistatic.uniaxial ? "/mechanics/compression" : "/mechanics/quasistatic";
        case ShearMethod::dem:
            return "/mechanics/dem";
        case ShearMethod::linear:
            break;
    }
    return "/mechanics/linear";
}

ShearRun shear_run(const Arguments& arguments) {
    ShearRun run;
    check_engine(arguments);
    run.lammps = engine_of(arguments, "lammps");
    run.petsc = engine_of(arguments, "petsc");
    run.frequencies = frequencies_of(arguments);
    check_frequencies(arguments, run.frequencies);
    run.method = method_of(arguments, run.frequencies);
    run.model = contact_model(arguments);
    run.model_file = arguments.text("model", "");
    if (run.method == ShearMethod::linear) {
        check_elastic(arguments, run.model);
    }
    run.bond_tolerance = arguments.quantity("bond-tolerance");
    run.relax = relaxation_scheme(arguments, run.model);
    run.linear = linear_options(arguments, run.model);
    if (run.lammps) {
        check_lammps_can_shear(arguments, run.model);
    } else if (run.method == ShearMethod::dem) {
        run.rheometer = rheometer_options_of(arguments, run.model, run.frequencies);
    }
    if (run.method == ShearMethod::quasistatic) {
        run.quasistatic = quasistatic_path(arguments, run.model, run.frequencies);
    }
    run.orientations = arguments.parsed("orientation", [&](const std::string& text) {
        return parse_orientations(text,
                                  run.quasistatic.uniaxial ? mechanics::uniaxial_orientations() : mechanics::all_orientations());
    });
    run.checkpoint = {arguments.text("checkpoint", ""), run_signature(arguments, run.model)};
    run.conditions = shear_conditions(arguments, run);
    return run;
}

ShearRun shear_run(const Arguments& arguments, const BondsOfStructure& of) {
    Arguments resolved = arguments;
    if (of.bonds && !arguments.given("bond-tolerance")) {
        resolved = resolved.with_quantity("bond-tolerance", of.bonds->tolerance);
    }
    const std::string& from = arguments.text("stiffness-from");
    if (from == "options") {
        return shear_run(resolved);
    }
    if (!of.bonds) {
        throw InputError(of.structure + " says nothing about the stiffness of its bonds, which " +
                         arguments.spelled("stiffness-from", from) + " asks for: gels of depletion attraction do");
    }
    // Two particles in series make a contact. The attraction is central: nothing resists sliding unless it is asked for.
    resolved =
        resolved.with_quantity("normal-stiffness", 2 * (from == "thermal" ? of.bonds->thermal_stiffness : of.bonds->stiffness));
    if (!arguments.given("shear-stiffness")) {
        resolved = resolved.with_quantity("shear-stiffness", 0);
    }
    ShearRun run = shear_run(resolved);
    if (run.model.normal_stiffness != resolved.quantity("normal-stiffness")) {
        throw InputError(run.model_file + " has normal_stiffness, but " + arguments.spelled("stiffness-from", from) +
                         " takes it from the gel: give it in one of the two places");
    }
    return run;
}

Sheared shear(const ShearRun& run, const Packing& packing, const Progress& progress) {
    ContactNetwork bonds = find_contacts(packing, run.bond_tolerance);
    const auto rest = relaxed(run, packing, bonds, progress);
    const Packing& sheared = rest ? rest->packing : packing;
    const ContactNetwork& network = rest ? rest->bonds : bonds;
    Findings found = run.lammps                               ? shear_by_lammps(run, sheared, network, progress)
                     : run.method == ShearMethod::dem         ? rheometer_response(run, sheared, network, progress)
                     : run.method == ShearMethod::quasistatic ? quasistatic_response(run, sheared, network, progress)
                     : run.method == ShearMethod::linear      ? linear_response(run, packing, sheared, network, progress)
                                                              : frequency_response(run, sheared, network, progress);
    if (run.method == ShearMethod::linear || run.method == ShearMethod::frequency) {
        append_without_effect(found, run.model);
    }
    if (rest) {
        append_relaxation(found.group, found.results, found.fields, *rest);
    }
    found.results.insert(found.results.end(), run.conditions.begin(), run.conditions.end());
    check_finite(found.results);
    check_finite(found.bond_results);
    return {std::move(bonds), std::move(found)};
}

Verb shear_verb() {
    Verb verb{
        .name = "shear",
        .summary = "shear modulus and elastic tensor of the bonded packing",
        .input = "FILE.h5 ...",
        .options =
            {choice("method", {"linear", "quasistatic", "dem"}, "how the response is computed", "linear"),
             quantity("normal-stiffness", "N/m", "normal stiffness of a particle, two in series make a contact", "100N/m",
                      physical::stiffness),
             quantity("shear-stiffness", "N/m", "shear stiffness of a particle", "10N/m", within(0, 1e15)),
             choice("stiffness-from", {"options", "potential", "thermal"},
                    "potential: normal stiffness by the attraction that made a depletion gel, no shear stiffness unless given; "
                    "thermal: "
                    "by the motion of bound pairs in it",
                    "options"),
             quantity(
                 "bond-tolerance", "1",
                 "pairs nearer than (1 + X) (r_i + r_j) are bonded; of a depletion gel the range of the attraction when not given",
                 "0.01", within(0, 1)),
             text("frequency", "LIST",
                  "compute the response to an oscillating strain at these frequencies, such as 1Hz,10Hz or 1rad/s"),
             text("frequency-sweep", "FROM:TO:N", "compute it at N frequencies in logarithmic steps, such as 0.1Hz:1kHz:20"),
             reads(text("model", "FILE.toml", "all parameters of the contacts and the solvent (docs/reference/contact-model.md)")),
             choice("relax", {"none", "minimise", "paper"},
                    "bring the bonded packing to rest first: by minimisation, or by steps with velocities set to zero", "none"),
             choice("solver", {"auto", "direct", "iterative"}, "solver of the linear equations", "auto"),
             quantity("memory-limit", "byte", "memory for the direct solver; auto takes the iterative one where this is not enough",
                      "500MB", within(1, 1e18)),
             quantity("tolerance", "1", "direct solver: relative residual of every strain", "1e-10", within(1e-14, 1e-2)),
             quantity("modulus-tolerance", "1", "iterative solver: estimated relative error of the moduli", "1e-5",
                      within(1e-12, 1e-2)),
             output("write to a new file; results are added to the input file when not given"),
             flag("force", "replace an existing output file, or results of the same method under other conditions")},
        .notes = {
            "--method dem takes one --frequency (default 1Hz) and scales the masses so that its time steps are few enough.",
            "With --frequency the springs may have losses (--model), and only --tolerance of the solver's options has an effect.",
            ("Bond strengths, friction and ageing have no effect at vanishing strain; linear and --frequency results list those "
             "given."),
            "--relax moves the particles for the calculation only; relaxation_displacement in the file says how far.",
            "--method quasistatic without --amplitudes and --ramp computes secant moduli at a strain of 1e-6.",
            "--engine lammps strains the periodic cell by 1e-8, without plates, and brings it to rest: it finds G', but no G''."}};
    verb.notes.emplace_back(
        "Each of several files gets its own results; the mean of G' and its standard error over the structures are printed.");
    verb.many_inputs = true;
    const std::vector<Option> engine = engine_options(
        {"builtin", "petsc", "lammps"},
        "what computes the response: coagula itself; linear: PETSc on many processors; dem: LAMMPS, which must be installed");
    for (const std::vector<Option>& own : {rheometer_options(), quasistatic_options(), engine}) {
        verb.options.insert(verb.options.end() - 2, own.begin(), own.end());
    }
    const std::vector<std::string> of_solver = {"solver", "memory-limit", "modulus-tolerance"};
    not_read_with(verb.options, {"normal-stiffness"}, "stiffness-from", {"potential", "thermal"});
    read_only_with(verb.options, {"solver", "memory-limit", "modulus-tolerance", "tolerance"}, "method", {"linear"});
    not_read_with(verb.options, of_solver, "frequency");
    not_read_with(verb.options, of_solver, "frequency-sweep");
    not_read_with(verb.options,
                  {"amplitude", "constant-amplitude", "oscillations", "steps-per-oscillation", "damping", "density", "checkpoint",
                   "frequency", "frequency-sweep"},
                  "engine", {"lammps"});
    not_read_with(verb.options, {"solver", "memory-limit", "tolerance", "frequency", "frequency-sweep"}, "engine", {"petsc"});
    read_only_with(verb.options, {"memory-limit"}, "solver", {"auto"});
    read_only_with(verb.options, {"modulus-tolerance"}, "solver", {"auto", "iterative"});
    return verb;
}

}  // namespace coagula::stages
