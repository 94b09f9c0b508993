// coagula shear: elastic response of the bonded packing.
#include "output_file.hpp"
#include "progress_bar.hpp"
#include "provenance.hpp"
#include "report.hpp"
#include "shear_results.hpp"
#include "verbs.hpp"

#include <coagula/characterize/inner_particles.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/mechanics/relaxation.hpp>

#include <algorithm>
#include <optional>

namespace coagula::tools {

namespace {

mechanics::LinearSolver chosen_solver(const std::string& name) {
    if (name == "direct") {
        return mechanics::LinearSolver::direct;
    }
    return name == "iterative" ? mechanics::LinearSolver::iterative : mechanics::LinearSolver::automatic;
}

mechanics::LinearOptions linear_options(const Arguments& arguments) {
    mechanics::LinearOptions options;
    options.normal_stiffness = arguments.quantity("normal-stiffness");
    options.shear_stiffness = arguments.quantity("shear-stiffness");
    options.solver = chosen_solver(arguments.text("solver"));
    options.memory_limit = arguments.quantity("memory-limit");
    options.tolerance = arguments.quantity("tolerance");
    options.modulus_tolerance = arguments.quantity("modulus-tolerance");
    return options;
}

void check_method(const std::string& method) {
    if (method != "linear") {
        throw InputError("--method " + method + " is not available in this version; use --method linear");
    }
}

/// A sample with a free surface is strained by its outer particles, those whose Voronoi cells the surroundings could change; the
/// stress is averaged over the cells of the others.
void hold_surface(const Packing& packing, mechanics::LinearOptions& options) {
    const std::vector<bool> inner = characterize::inner_particles(packing);
    options.held.resize(inner.size());
    std::transform(inner.begin(), inner.end(), options.held.begin(), [](bool is_inner) { return !is_inner; });
    options.volume = characterize::measure_pores(packing, {.radii = 4}).volume;
}

/// The network at rest, if the user asks for it.
std::optional<mechanics::RelaxedNetwork> relaxed(const Arguments& arguments, const Packing& packing, const ContactNetwork& bonds,
                                                 const Progress& progress) {
    const std::string& scheme = arguments.text("relax");
    if (scheme == "none") {
        return std::nullopt;
    }
    mechanics::RelaxationOptions options;
    options.normal_stiffness = arguments.quantity("normal-stiffness");
    options.shear_stiffness = arguments.quantity("shear-stiffness");
    options.scheme = scheme == "paper" ? mechanics::RelaxationScheme::stopped_steps : mechanics::RelaxationScheme::minimise;
    return mechanics::relax(packing, bonds, options, progress);
}

void run(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    check_method(arguments.text("method"));
    mechanics::LinearOptions options = linear_options(arguments);
    const double tolerance = arguments.quantity("bond-tolerance");
    const Packing packing = io::read_structure(arguments.input()).packing;
    const std::string target = checked_target(arguments);

    if (!packing.cell.is_periodic()) {
        hold_surface(packing, options);
    }
    const ContactNetwork bonds = find_contacts(packing, tolerance);
    const auto rest = relaxed(arguments, packing, bonds, progress);
    const mechanics::LinearResponse response = rest ? mechanics::solve_linear(rest->packing, rest->bonds, options, progress)
                                                    : mechanics::solve_linear(packing, bonds, options, progress);
    Results results = datasets_of(response, tolerance, options);
    std::vector<io::ParticleField> fields = fields_of(response);
    if (rest) {
        append_relaxation(results, fields, *rest);
    }
    progress.update("writing", 1.0);
    io::add_results(arguments.input(), target, {"/mechanics/linear"}, bonds, fields, results,
                    describe_call(arguments, &packing, clock), arguments.flag("force"));

    Json json = to_json(results, "/mechanics/linear");
    if (response.floppy_modes < 0) {
        json["floppy_modes"] = nullptr;
    }
    json["output"] = target;
    json["seconds"] = clock.seconds();
    Table table = table_of(response);
    table.emplace_back("written to", target);
    report(arguments, json, table);
}

}  // namespace

Verb shear_verb() {
    return {
        .name = "shear",
        .summary = "shear modulus and elastic tensor of the bonded packing",
        .input = "FILE.h5",
        .options = {choice("method", {"linear", "quasistatic", "dem"}, "how the response is computed", "linear"),
                    quantity("normal-stiffness", "N/m", "normal stiffness of a particle, two in series make a contact", "100N/m",
                             above(0)),
                    quantity("shear-stiffness", "N/m", "shear stiffness of a particle", "10N/m", at_least(0)),
                    quantity("bond-tolerance", "1", "pairs nearer than (1 + X) (r_i + r_j) are bonded", "0.01", within(0, 1)),
                    choice("relax", {"none", "minimise", "paper"},
                           "bring the bonded packing to rest first: by minimisation, or by steps with velocities set to zero",
                           "none"),
                    choice("solver", {"auto", "direct", "iterative"}, "of the linear equations", "auto"),
                    quantity("memory-limit", "byte", "memory of the direct solver; beyond it 'auto' iterates", "4GB", above(0)),
                    quantity("tolerance", "1", "direct solver: relative residual of every strain", "1e-10", within(1e-14, 1e-2)),
                    quantity("modulus-tolerance", "1", "iterative solver: estimated relative error of the moduli", "1e-5",
                             within(1e-12, 1e-2)),
                    output("write to a new file; results are added to the input file when not given"),
                    flag("force", "replace an existing output file")},
        .run = run,
        .notes = {"--relax moves the particles for the calculation only; how far is stored as relaxation_displacement.",
                  "The methods quasistatic and dem are not available in this version."}};
}

}  // namespace coagula::tools
