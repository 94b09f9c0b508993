// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasistatic_run.hpp"

#include <coagula/io/checkpoint_file.hpp>
#include <coagula/io/checkpoint_lock.hpp>
#include "logarithmic_sweep.hpp"
#include "network_keys.hpp"
#include "orientation_list.hpp"
#include "progress_part.hpp"
#include "quasistatic_results.hpp"

#include <coagula/io/contact_model_file.hpp>
#include <coagula/mechanics/quasistatic.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>

namespace coagula::stages {

namespace {

using mechanics::ShearOrientation;

constexpr double small_strain = 1e-6;

using Test = QuasistaticTest;

double parse_strain(const std::string& word) {
    return parse_quantity(word, "1", physical::strain);
}

/// "1e-4,1e-3" or "1e-4:1e-2:10".
std::vector<double> parse_amplitudes(const std::string& text) {
    if (text.find(':') != std::string::npos) {
        return parse_logarithmic_sweep(text, parse_strain, "1e-4:1e-2:10");
    }
    std::vector<double> amplitudes;
    for (const std::string& word : split(text)) {
        amplitudes.push_back(parse_strain(word));
    }
    return amplitudes;
}

mechanics::SweepOptions sweep_options(const QuasistaticPath& path, const ShearOrientation& orientation) {
    return {.amplitudes = path.amplitudes,
            .cycles = path.cycles,
            .steps_per_cycle = path.steps_per_cycle,
            .frequency = path.frequency,
            .solver = {.orientation = orientation, .rest_length = path.rest_length}};
}

mechanics::RampOptions ramp_options(const QuasistaticPath& path, const ShearOrientation& orientation) {
    return {.strain = path.uniaxial ? -path.ramp : path.ramp,
            .steps = path.ramp_steps,
            .solver = {.orientation = orientation, .rest_length = path.rest_length}};
}

/// All orientations, but for those that are finished in the checkpoint, if there is one.
std::vector<Test> run_or_resume(const ShearRun& run, const Packing& packing, const Progress& progress,
                                const std::function<void(Test&, const Progress&)>& test) {
    const std::string& path = run.checkpoint.path;
    const std::string signature = run.checkpoint.wanted() ? run.checkpoint.signature + io::positions_sha256(packing) : "";
    const std::vector<ShearOrientation>& orientations = run.orientations;
    std::optional<io::CheckpointLock> lock;
    std::vector<Test> tests;
    if (run.checkpoint.wanted()) {
        lock.emplace(path);
        if (std::filesystem::exists(path)) {
            tests = read_quasistatic_checkpoint(path, signature);
        }
    }
    return io::with_checkpoint(path, [&] {
        for (std::size_t k = tests.size(); k < orientations.size(); ++k) {
            tests.push_back({orientations[k], {}, {}});
            test(tests.back(),
                 part_of(progress, "shearing", k, orientations.size(), counted("orientation", k + 1, orientations.size())));
            if (run.checkpoint.wanted()) {
                write_quasistatic_checkpoint(path, signature, tests);
            }
        }
        return tests;
    });
}

std::vector<double> amplitudes_of(const Arguments& arguments) {
    std::vector<double> amplitudes = arguments.parsed("amplitudes", parse_amplitudes);
    if (arguments.flag("reverse")) {
        const std::vector<double> up = amplitudes;
        amplitudes.insert(amplitudes.end(), up.rbegin(), up.rend());
    }
    return amplitudes;
}

void append_network(Results& results, const std::string& group, const ShearRun& run, const ContactNetwork& bonds) {
    results.push_back(io::text(group + "method", "quasistatic", "equilibria of the network in a deforming periodic cell"));
    results.push_back(io::integer(group + "contacts", bonds.size(), "number of bonds at the start"));
    results.push_back(
        io::scalar(group + "bond_tolerance", run.bond_tolerance, "1", "pairs nearer than (1 + tolerance) (r_i + r_j) are bonded"));
    results.push_back(io::text(group + "model", io::contact_model_text(run.model), "the contact as a TOML file"));
}

/// A modulus below this share of the affine one is what rounding leaves, also of a loss.
constexpr double rounding = 1e-8;
constexpr double balance = 1e-6;  // of work against energy, to which equilibria are found

void clear_rounding(Test& test, double affine) {
    const auto clear = [&](double& modulus) { modulus = std::abs(modulus) < rounding * affine ? 0 : modulus; };
    for (mechanics::AmplitudeResponse& entry : test.sweep.amplitudes) {
        clear(entry.storage_modulus);
        clear(entry.loss_modulus);
        const bool within_balance = std::abs(entry.loss_modulus) < balance * std::abs(entry.storage_modulus);
        entry.loss_modulus = entry.loss_modulus < 0 && within_balance ? 0 : entry.loss_modulus;  // nothing is gained in a cycle
    }
    const auto [normal, direction] = std::pair(test.orientation.normal, test.orientation.direction);
    for (mechanics::StrainPoint& point : test.ramp.points) {
        const double start = test.ramp.points.front().stress(normal, direction);
        const double change = point.stress(normal, direction) - start;
        if (std::abs(change) < rounding * affine * std::abs(point.strain)) {
            point.stress(normal, direction) = point.stress(direction, normal) = start;
        }
    }
}

/// Equilibria of contacts that have no stiffness to begin with are not found but in lattices.
void check_stiffness_at_rest(const Arguments& arguments, const ContactModel& model) {
    const bool hertzian = !std::isnan(model.young_modulus) && std::isnan(model.work_of_adhesion);
    const bool unloaded = std::isnan(model.prestress) || model.prestress == 0;
    if (hertzian && unloaded && arguments.text("rest-length") == "found") {
        throw InputError(arguments.spelled("method", "quasistatic") + " needs contacts with a stiffness at rest, and those of " +
                         arguments.text("model") +
                         ", by Hertz's law and unstressed as found, have none: give work_of_adhesion, or use " +
                         arguments.spelled("method", "dem"));
    }
}

}  // namespace

std::vector<Option> quasistatic_options() {
    std::vector<Option> options = {
        text("amplitudes", "LIST", "quasistatic: amplitudes of strain such as 1e-4,1e-3 or FROM:TO:N in logarithmic steps"),
        formerly("down", flag("reverse", "quasistatic: repeat the amplitudes in descending order")),
        count("cycles", "quasistatic: cycles per amplitude, of which the last is measured", "1", within(1, 1000)),
        count("steps-per-cycle", "quasistatic: equilibria in a cycle, a multiple of 4", "32", within(4, 100000)),
        quantity("ramp", "1", "quasistatic: shear to this strain instead of cycles", "", within(-10, 10)),
        choice("strain", {"shear", "uniaxial"}, "quasistatic: shear, or uniaxial compression by --ramp as a share of the height",
               "shear"),
        count("ramp-steps", "quasistatic: equally spaced equilibria on the ramp", "50", within(1, 100000))};
    read_only_with(options, {"amplitudes", "ramp"}, "method", {"quasistatic"});
    read_only_with(options, {"reverse", "cycles", "steps-per-cycle"}, "amplitudes");
    read_only_with(options, {"ramp-steps", "strain"}, "ramp");
    return options;
}

QuasistaticPath quasistatic_path(const Arguments& arguments, const ContactModel& model, const std::vector<double>& frequencies) {
    const bool sweep = arguments.has("amplitudes");
    if (sweep && arguments.has("ramp")) {
        throw InputError(arguments.spelled("amplitudes") + " and " + arguments.spelled("ramp") + " exclude each other");
    }
    check_stiffness_at_rest(arguments, model);
    QuasistaticPath path;
    path.rest_length = arguments.text("rest-length") == "found" ? mechanics::RestLength::as_found : mechanics::RestLength::touching;
    path.amplitudes = sweep ? amplitudes_of(arguments) : std::vector<double>{};
    path.cycles = arguments.count("cycles");
    path.steps_per_cycle = arguments.count("steps-per-cycle");
    path.frequency = frequencies.empty() ? unset : frequencies.front();
    path.ramp = arguments.optional_quantity("ramp").value_or(small_strain);
    path.ramp_steps = arguments.has("ramp") ? arguments.count("ramp-steps") : 1;
    path.uniaxial = arguments.text("strain") == "uniaxial";
    if (path.uniaxial && path.ramp >= 1) {
        throw InputError(arguments.spelled("ramp") + " is " + to_text(path.ramp) + ", but " +
                         arguments.spelled("strain", "uniaxial") +
                         " compresses the cell by this share of its height, which must be below 1");
    }
    return path;
}

Findings quasistatic_response(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress) {
    const QuasistaticPath& path = run.quasistatic;
    const bool sweep = !path.amplitudes.empty();
    std::vector<Test> tests = run_or_resume(run, packing, progress, [&](Test& test, const Progress& part) {
        if (sweep) {
            test.sweep = mechanics::sweep_amplitudes(packing, bonds, run.model, sweep_options(path, test.orientation), part);
        } else {
            test.ramp = mechanics::shear_to(packing, bonds, run.model, ramp_options(path, test.orientation), part);
        }
    });
    Findings found{.group = run.group(), .results = {}};
    const std::string group = found.group + "/";
    append_network(found.results, group, run, bonds);
    append_contact_stiffness(found.results, group, packing, bonds, run.model);
    const auto linear = append_network_keys(found.results, group, packing, bonds, run.model, progress);
    for (Test& test : tests) {
        clear_rounding(test, linear ? linear->mean_affine_modulus() : 0);
        if (path.uniaxial) {
            count_compression_positive(test);
        }
    }
    found.table = table_of_tests(tests, sweep);
    if (linear) {
        append_reason(found, packing, bonds, *linear);
    }
    if (sweep) {
        append_sweeps(found.results, tests, path.amplitudes);
    } else if (path.uniaxial) {
        append_compressions(found.results, tests, volume_fraction(packing));
    } else {
        append_ramps(found.results, tests);
    }
    return found;
}

}  // namespace coagula::stages
