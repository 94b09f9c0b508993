// coagula shear: elastic response of the bonded packing, or its response to harmonic strain.
#include "cli/output_file.hpp"
#include "cli/progress_bar.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"
#include "frequency_list.hpp"
#include "frequency_results.hpp"
#include "load_structure_results.hpp"
#include "network_keys.hpp"
#include "over_structures.hpp"
#include "quasistatic_run.hpp"
#include "rheometer_run.hpp"
#include "shear_conditions.hpp"
#include "shear_results.hpp"
#include "stages.hpp"

#include <coagula/characterize/inner_particles.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/io/conditions.hpp>
#include <coagula/io/contact_model_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/mechanics/relaxation.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>

namespace coagula::tools {

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
        throw InputError("--" + option + " is " + to_text(given) + " N/m, but " + arguments.text("model") + " has " +
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
            throw InputError(arguments.text("model") + " has " + parameter.name +
                             ", a loss that acts at a frequency only: give --frequency or --frequency-sweep");
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

/// The network at rest, if the user asks for it.
std::optional<mechanics::RelaxedNetwork> relaxed(const Arguments& arguments, const Packing& packing, const ContactNetwork& bonds,
                                                 const ContactModel& model, const Progress& progress) {
    const std::string& scheme = arguments.text("relax");
    if (scheme == "none") {
        return std::nullopt;
    }
    if (!std::isnan(model.prestress)) {
        throw InputError(
            "--relax brings bonds of rest length r_i + r_j to rest and takes them as unstressed there, but " +
            arguments.text("model") +
            " has prestress, which every bond would carry again after the relaxation; --method quasistatic and dem bring "
            "a prestressed network to rest themselves");
    }
    if (!std::isnan(model.young_modulus)) {
        throw InputError("--relax supports linear springs only, but " + arguments.text("model") +
                         " has young_modulus; --method quasistatic and dem with --rest-length radii bring such contacts to rest");
    }
    mechanics::RelaxationOptions options;
    options.normal_stiffness = model.normal_stiffness;
    options.shear_stiffness = model.shear_stiffness;
    options.scheme = scheme == "paper" ? mechanics::RelaxationScheme::stopped_steps : mechanics::RelaxationScheme::minimise;
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
Findings linear_response(const Arguments& arguments, const Packing& before, const Packing& packing, const ContactNetwork& bonds,
                         const ContactModel& model, const Progress& progress) {
    mechanics::LinearOptions options = linear_options(arguments, model);
    options.bond_tangents = mechanics::bond_tangents(packing, bonds, model);
    if (!before.cell.is_periodic()) {
        const characterize::FreeSurface surface = characterize::free_surface(before);
        options.held = surface.outer;
        options.volume = surface.inner_volume;
    }
    const mechanics::LinearResponse response = mechanics::solve_linear(packing, bonds, options, progress);
    Findings found{.group = "/mechanics/linear",
                   .results = datasets_of(response, arguments.quantity("bond-tolerance"), options),
                   .fields = fields_of(response),
                   .table = table_of(response)};
    append_load_structure(found, mechanics::find_load_structure(packing, bonds, response, {.held = options.held}),
                          packing.cell.is_periodic());
    return found;
}

Findings frequency_response(const Arguments& arguments, const Packing& packing, const ContactNetwork& bonds,
                            const ContactModel& model, const std::vector<double>& frequencies, const Progress& progress) {
    const auto response = mechanics::solve_frequency_sweep(packing, bonds, model, frequencies,
                                                           {.tolerance = arguments.quantity("tolerance")}, progress);
    Findings found{.group = "/mechanics/frequency",
                   .results = datasets_of(response, arguments.quantity("bond-tolerance"), model),
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
        throw InputError("--method quasistatic reads a frequency only with --amplitudes: a ramp has none");
    }
    if (frequencies.size() > 1) {
        throw InputError("--method quasistatic runs at one frequency, but " + std::to_string(frequencies.size()) + " are given");
    }
}

/// What needs no packing. Returns the contact.
ContactModel check_options(const Arguments& arguments) {
    const std::vector<double> frequencies = frequencies_of(arguments);
    check_frequencies(arguments, frequencies);
    const ContactModel model = contact_model(arguments);
    if (frequencies.empty() && arguments.text("method") == "linear") {
        check_elastic(arguments, model);
    }
    return model;
}

struct Shown {
    Json json;
    Table table;
};

/// Adds the response of the file `source` to `target`.
Shown shear_file(const Arguments& arguments, const std::string& source, const std::string& target, const Packing& packing,
                 const Progress& progress) {
    const Stopwatch clock;
    auto [bonds, found] = shear_packing(arguments, packing, progress);
    progress.update("writing", 1.0);
    Json json = to_json(found.results, found.group);
    std::move(found.bond_results.begin(), found.bond_results.end(), std::back_inserter(found.results));
    io::add_results(source, target, replaced_groups(found), bonds, found.fields, found.results,
                    describe_call(arguments, &packing, clock), arguments.flag("force"), found.bond_fields);
    if (json.value("floppy_modes", 0) < 0) {
        json["floppy_modes"] = nullptr;
    }
    json["output"] = target;
    json["seconds"] = clock.seconds();
    found.table.emplace_back("written to", target);
    return {std::move(json), std::move(found.table)};
}

/// Results of the same method in the file itself are replaced by those of the same conditions only.
void check_replaced(const Arguments& arguments, const std::string& file, const ContactModel& model) {
    if (!arguments.has("output") && !arguments.flag("force")) {
        io::check_conditions(file, shear_group(arguments), shear_conditions(arguments, model));
    }
}

/// Everything about the files that can be wrong is found before the first is sheared.
void check_files(const Arguments& arguments, const std::vector<std::string>& files, const ContactModel& model) {
    for (const char* name : {"output", "checkpoint"}) {
        if (arguments.has(name)) {
            throw InputError(std::string("--") + name + " is for one file, but " + std::to_string(files.size()) +
                             " are given: without it each gets its own results");
        }
    }
    std::set<std::filesystem::path> seen;
    for (const std::string& file : files) {
        check_updatable(file);
        if (!seen.insert(std::filesystem::canonical(file)).second) {
            throw InputError(file + " is given twice, but the scatter of the structures is that of different ones");
        }
        check_replaced(arguments, file, model);
    }
}

std::string how_to_have_it_faster(const Arguments& arguments) {
    const std::string& method = arguments.text("method");
    if (method == "linear") {
        return {};
    }
    const std::string shorter = method == "dem"               ? "--oscillations and --steps-per-oscillation"
                                : arguments.has("amplitudes") ? "amplitudes, of which the largest take most, and --steps-per-cycle"
                                                              : "--ramp-steps";
    return (arguments.text("orientation") == "all" ? "--orientation xy takes a sixth of it, and fewer " : "fewer ") + shorter +
           " take less";
}

void shear_files(const Arguments& arguments, const std::vector<std::string>& files, const ContactModel& model) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"), how_to_have_it_faster(arguments));
    check_files(arguments, files, model);
    std::vector<Json> structures;
    for (const std::string& file : files) {
        Json json = {{"file", file}};
        json.update(shear_file(arguments, file, file, io::read_structure(file).packing, progress).json);
        structures.push_back(std::move(json));
    }
    const Json json = {{"method", structures.front().at("method")},
                       {"structures", structures},
                       {"over_structures", over_structures(structures)},
                       {"seconds", clock.seconds()}};
    report(arguments, json, table_over_structures(structures));
}

void run_shear(const Arguments& arguments) {
    const ContactModel model = check_options(arguments);
    const std::vector<std::string> files = arguments.inputs();
    if (files.size() > 1) {
        shear_files(arguments, files, model);
        return;
    }
    const Progress progress = make_progress(arguments.flag("quiet"), how_to_have_it_faster(arguments));
    const std::string target = checked_target(arguments);
    check_replaced(arguments, files.front(), model);
    const Packing packing = io::read_structure(files.front()).packing;
    const Shown shown = shear_file(arguments, files.front(), target, packing, progress);
    report(arguments, shown.json, shown.table);
}

}  // namespace

Sheared shear_packing(const Arguments& arguments, const Packing& packing, const Progress& progress) {
    const std::vector<double> frequencies = frequencies_of(arguments);
    const ContactModel model = check_options(arguments);
    const bool explicit_run = arguments.text("method") == "dem";
    const bool quasistatic = arguments.text("method") == "quasistatic";
    ContactNetwork bonds = find_contacts(packing, arguments.quantity("bond-tolerance"));
    const auto rest = relaxed(arguments, packing, bonds, model, progress);
    const Packing& sheared = rest ? rest->packing : packing;
    const ContactNetwork& network = rest ? rest->bonds : bonds;
    Findings found = explicit_run          ? rheometer_response(arguments, sheared, network, model, frequencies, progress)
                     : quasistatic         ? quasistatic_response(arguments, sheared, network, model, frequencies, progress)
                     : frequencies.empty() ? linear_response(arguments, packing, sheared, network, model, progress)
                                           : frequency_response(arguments, sheared, network, model, frequencies, progress);
    if (!explicit_run && !quasistatic) {
        append_without_effect(found, model);
    }
    if (rest) {
        append_relaxation(found.group, found.results, found.fields, *rest);
    }
    for (io::Dataset& condition : shear_conditions(arguments, model)) {
        found.results.push_back(std::move(condition));
    }
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
             quantity("bond-tolerance", "1", "pairs nearer than (1 + X) (r_i + r_j) are bonded", "0.01", within(0, 1)),
             text("frequency", "LIST", "compute the response to an oscillating strain at these frequencies, such as 1Hz,10Hz"),
             text("frequency-sweep", "FROM:TO:N", "compute it at N frequencies in logarithmic steps, such as 0.1Hz:1kHz:20"),
             reads(text("model", "FILE.toml", "all parameters of the contacts and the solvent (docs/reference/contact-model.md)")),
             choice("relax", {"none", "minimise", "paper"},
                    "bring the bonded packing to rest first: by minimisation, or by steps with velocities set to zero", "none"),
             choice("solver", {"auto", "direct", "iterative"}, "solver of the linear equations", "auto"),
             quantity("memory-limit", "byte", "memory for the direct solver; auto takes the iterative one where this is not enough",
                      "4GB", within(1, 1e18)),
             quantity("tolerance", "1", "direct solver: relative residual of every strain", "1e-10", within(1e-14, 1e-2)),
             quantity("modulus-tolerance", "1", "iterative solver: estimated relative error of the moduli", "1e-5",
                      within(1e-12, 1e-2)),
             output("write to a new file; results are added to the input file when not given"),
             flag("force", "replace an existing output file, or results of the same method under other conditions")},
        .run = run_shear,
        .notes = {
            "--method dem takes one --frequency (default 1Hz) and scales the masses so that its time steps are few enough.",
            "With --frequency the springs may have losses (--model), and only --tolerance of the solver's options has an effect.",
            "Bond strengths, friction and ageing have no effect at vanishing strain; linear and --frequency results list those "
            "given.",
            "--relax moves the particles for the calculation only; relaxation_displacement in the file says how far.",
            "--method quasistatic without --amplitudes and --ramp computes secant moduli at a strain of 1e-6."}};
    verb.notes.emplace_back(
        "Each of several files gets its own results; the mean of G' and its standard error over the structures are printed.");
    verb.many_inputs = true;
    for (const std::vector<Option>& own : {rheometer_options(), quasistatic_options()}) {
        verb.options.insert(verb.options.end() - 2, own.begin(), own.end());
    }
    const std::vector<std::string> of_solver = {"solver", "memory-limit", "modulus-tolerance"};
    read_only_with(verb.options, {"solver", "memory-limit", "modulus-tolerance", "tolerance"}, "method", {"linear"});
    not_read_with(verb.options, of_solver, "frequency");
    not_read_with(verb.options, of_solver, "frequency-sweep");
    read_only_with(verb.options, {"memory-limit"}, "solver", {"auto"});
    read_only_with(verb.options, {"modulus-tolerance"}, "solver", {"auto", "iterative"});
    return verb;
}

}  // namespace coagula::tools
