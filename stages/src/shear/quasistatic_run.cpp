// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasistatic_run.hpp"

#include <coagula/io/checkpoint_file.hpp>
#include <coagula/io/checkpoint_lock.hpp>
#include "broken_bonds.hpp"
#include "logarithmic_sweep.hpp"
#include "network_keys.hpp"
#include "orientation_list.hpp"
#include "progress_part.hpp"
#include "quasistatic_checkpoint.hpp"

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

const std::string quasistatic_group = "/mechanics/quasistatic/";
constexpr double small_strain = 1e-6;
constexpr double yield_fraction = 0.9;

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
    return {.strain = path.ramp, .steps = path.ramp_steps, .solver = {.orientation = orientation, .rest_length = path.rest_length}};
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
    if (arguments.flag("down")) {
        const std::vector<double> up = amplitudes;
        amplitudes.insert(amplitudes.end(), up.rbegin(), up.rend());
    }
    return amplitudes;
}

void append_network(Results& results, const ShearRun& run, const ContactNetwork& bonds) {
    results.push_back(
        io::text(quasistatic_group + "method", "quasistatic", "equilibria of the network in a deforming periodic cell"));
    results.push_back(io::integer(quasistatic_group + "contacts", bonds.size(), "number of bonds at the start"));
    results.push_back(io::scalar(quasistatic_group + "bond_tolerance", run.bond_tolerance, "1",
                                 "pairs nearer than (1 + tolerance) (r_i + r_j) are bonded"));
    results.push_back(io::text(quasistatic_group + "model", io::contact_model_text(run.model), "the contact as a TOML file"));
}

/// Mean, standard deviation and one array per orientation.
void append_modulus(Results& results, const std::string& name, const std::vector<Test>& tests, const Eigen::MatrixXd& values,
                    const std::string& description) {
    const Eigen::VectorXd mean = values.colwise().mean();
    const Eigen::VectorXd deviation = (values.rowwise() - mean.transpose()).array().square().colwise().mean().sqrt();
    const auto add = [&](const std::string& key, const Eigen::VectorXd& value, const std::string& of) {
        results.push_back(value.size() == 1
                              ? io::scalar(quasistatic_group + name + "/" + key, value[0], "Pa", description + ", " + of)
                              : io::vector(quasistatic_group + name + "/" + key, value, "Pa", description + ", " + of));
    };
    add("mean", mean, "mean of the orientations");
    add("std", deviation, "standard deviation over the orientations of this one structure");
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const std::string of = name_of(tests[k].orientation);
        add(of, values.row(static_cast<Index>(k)), "plate normal and shear direction " + of);
    }
}

template <class Entries, class Value>
Eigen::VectorXd collect(const Entries& entries, const Value& value) {
    Eigen::VectorXd values(static_cast<Index>(entries.size()));
    std::transform(entries.begin(), entries.end(), values.begin(), value);
    return values;
}

void append_broken(Results& results, const std::string& path, const std::vector<mechanics::BrokenBond>& broken) {
    Eigen::VectorXi bond(static_cast<Index>(broken.size()));
    std::transform(broken.begin(), broken.end(), bond.begin(), [](const auto& entry) { return static_cast<int>(entry.bond); });
    if (!broken.empty()) {
        results.push_back(io::integers(path + "broken/bond", bond, "column in the list of bonds, in the order of breakage"));
        results.push_back(io::vector(path + "broken/strain", collect(broken, [](const auto& entry) { return entry.strain; }), "1",
                                     "strain at which the bond broke"));
    }
    std::vector<BreakageCause> causes;
    std::transform(broken.begin(), broken.end(), std::back_inserter(causes), [](const auto& entry) { return entry.cause; });
    append_causes(results, path, causes);
}

/// What people read where the network failed.
std::string sentence_of(const mechanics::NetworkFailure& failure) {
    return "failed at strain " + with_unit(failure.strain, "1") + ", " + std::to_string(failure.broken) + " bonds broken: " +
           (failure.parted ? "nothing reaches from plate to plate any more"
                           : "the stress stays below 1/1000 of its largest value from there on");
}

void append_failure(Results& results, const std::string& path, const std::optional<mechanics::NetworkFailure>& failure) {
    results.push_back(io::scalar(path + "failure_strain", failure ? failure->strain : unset, "1",
                                 "strain at which the network ceased to carry load; NaN: it did not"));
    if (failure) {
        results.push_back(io::text(path + "failure", sentence_of(*failure), "description of the failure of the network"));
    }
}

void append_points(Results& results, const std::string& path, const mechanics::RampResponse& ramp,
                   const ShearOrientation& orientation) {
    const auto add = [&](const std::string& name, const auto& value, const std::string& unit, const std::string& description) {
        results.push_back(io::vector(path + name, collect(ramp.points, value), unit, description));
    };
    using Point = mechanics::StrainPoint;
    add(
        "strain", [](const Point& p) { return p.strain; }, "1", "strain of each equilibrium");
    add(
        "stress", [&](const Point& p) { return p.stress(orientation.normal, orientation.direction); }, "Pa", "shear stress");
    add(
        "work", [](const Point& p) { return p.work; }, "J", "work done by the boundary");
    add(
        "stored", [](const Point& p) { return p.stored; }, "J", "energy in the contacts");
    add(
        "dissipated", [](const Point& p) { return p.dissipated; }, "J", "energy dissipated by friction and micro-slip");
    add(
        "breakage", [](const Point& p) { return p.breakage; }, "J", "energy released by breaking bonds");
    add(
        "released", [](const Point& p) { return p.released; }, "J", "energy released by jumps to another equilibrium");
    add(
        "bonds", [](const Point& p) { return static_cast<double>(p.bonds); }, "1", "intact bonds");
}

void append_ramps(Results& results, const std::vector<Test>& tests) {
    Eigen::MatrixXd first(static_cast<Index>(tests.size()), 1);
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const ShearOrientation& orientation = tests[k].orientation;
        const mechanics::RampResponse& ramp = tests[k].ramp;
        first(static_cast<Index>(k), 0) = ramp.points.size() > 1 ? ramp.secant_modulus(1, orientation) : unset;
        const std::string path = quasistatic_group + "ramp/" + name_of(orientation) + "/";
        append_points(results, path, ramp, orientation);
        append_broken(results, path, ramp.broken);
        append_failure(results, path, ramp.failure);
        std::vector<double> strain;
        std::vector<double> secant;
        const auto stress = [&](const mechanics::StrainPoint& point) {
            return std::abs(point.stress(orientation.normal, orientation.direction));
        };
        const auto peak = std::max_element(ramp.points.begin(), ramp.points.end(),
                                           [&](const auto& a, const auto& b) { return stress(a) < stress(b); });
        for (std::size_t point = 1; point < ramp.points.size(); ++point) {
            strain.push_back(ramp.points[point].strain);
            secant.push_back(ramp.secant_modulus(point, orientation));
        }
        results.push_back(io::scalar(path + "yield_strain", mechanics::yield_strain(strain, secant, yield_fraction), "1",
                                     "strain where the secant modulus has fallen to 0.9 of the first one; NaN: nowhere"));
        results.push_back(io::scalar(path + "peak_strain", peak->strain, "1", "strain of the largest stress"));
        results.push_back(io::scalar(path + "peak_stress", stress(*peak), "Pa", "largest stress"));
    }
    append_modulus(
        results, "storage_modulus", tests, first,
        first.hasNaN() ? "secant modulus of the first step; NaN: the network failed there" : "secant modulus of the first step");
    append_modulus(results, "loss_modulus", tests, Eigen::MatrixXd::Constant(first.rows(), 1, unset),
                   "NaN: not measured on a ramp");
    results.push_back(io::scalar(quasistatic_group + "phase", unset, "rad", "NaN: not measured on a ramp"));
}

/// @param amplitudes asked for; what was not reached because the network failed is NaN.
void append_sweeps(Results& results, const std::vector<Test>& tests, const std::vector<double>& amplitudes) {
    const auto count = static_cast<Index>(amplitudes.size());
    results.push_back(io::vector(quasistatic_group + "amplitude", Eigen::VectorXd::Map(amplitudes.data(), count), "1",
                                 "amplitudes of strain, in the order of the run"));
    const bool all_reached = std::all_of(tests.begin(), tests.end(),
                                         [&](const Test& test) { return test.sweep.amplitudes.size() == amplitudes.size(); });
    const std::string not_reached = all_reached ? "" : "; NaN: not reached, the network failed before";
    Eigen::MatrixXd storage(static_cast<Index>(tests.size()), count);
    Eigen::MatrixXd loss = storage;
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const auto& run = tests[k].sweep.amplitudes;
        const auto column = [&](const auto& value) {
            Eigen::VectorXd values = Eigen::VectorXd::Constant(count, unset);
            values.head(static_cast<Index>(run.size())) = collect(run, value);
            return values;
        };
        storage.row(static_cast<Index>(k)) = column([](const auto& a) { return a.storage_modulus; });
        loss.row(static_cast<Index>(k)) = column([](const auto& a) { return a.loss_modulus; });
        const std::string path = quasistatic_group + "sweep/" + name_of(tests[k].orientation) + "/";
        const auto add = [&](const std::string& name, const auto& value, const std::string& unit, const std::string& description) {
            results.push_back(io::vector(path + name, column(value), unit, description + not_reached));
        };
        using Entry = mechanics::AmplitudeResponse;
        add(
            "third_harmonic", [](const Entry& a) { return a.third_harmonic; }, "1",
            "third harmonic of the stress over its fundamental");
        add(
            "loop_area", [](const Entry& a) { return a.loop_area; }, "J/m3", "area of the loop of stress against strain");
        add(
            "peak_stress", [](const Entry& a) { return a.peak_stress; }, "Pa", "largest shear stress of the cycle");
        add(
            "bonds", [](const Entry& a) { return static_cast<double>(a.bonds); }, "1", "bonds intact at the end of the cycle");
        add(
            "balance_error", [](const Entry& a) { return a.balance_error; }, "1",
            "work less the change of energy, over the gross work");
        append_broken(results, path, tests[k].sweep.broken);
        append_failure(results, path, tests[k].sweep.failure);
    }
    append_modulus(results, "storage_modulus", tests, storage, "fundamental in phase, per amplitude" + not_reached);
    append_modulus(results, "loss_modulus", tests, loss, "fundamental ahead of the strain, per amplitude" + not_reached);
    const Eigen::VectorXd phase = loss.colwise().mean().binaryExpr(
        storage.colwise().mean(), [](double lost, double stored) { return std::atan2(lost, stored); });
    results.push_back(io::vector(quasistatic_group + "phase", phase, "rad", "phase of the mean moduli" + not_reached));
}

Table table_of_tests(const std::vector<Test>& tests, bool sweep) {
    Table table;
    for (const Test& test : tests) {
        const std::string name = name_of(test.orientation);
        if (sweep) {
            for (const auto& entry : test.sweep.amplitudes) {
                table.emplace_back(name + ", amplitude " + with_unit(entry.amplitude, "1"),
                                   "G' " + with_unit(entry.storage_modulus, "Pa") + ", G'' " + with_unit(entry.loss_modulus, "Pa") +
                                       ", " + std::to_string(entry.broken) + " bonds broken");
            }
        } else {
            const auto& points = test.ramp.points;
            table.emplace_back(name + ", strain " + with_unit(points.back().strain, "1"),
                               "secant modulus " + with_unit(test.ramp.secant_modulus(points.size() - 1, test.orientation), "Pa") +
                                   ", " + std::to_string(test.ramp.broken.size()) + " bonds broken");
        }
        const auto& failure = sweep ? test.sweep.failure : test.ramp.failure;
        if (failure) {
            table.emplace_back(name, sentence_of(*failure));
        }
    }
    return table;
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
        flag("down", "quasistatic: repeat the amplitudes in descending order"),
        count("cycles", "quasistatic: cycles per amplitude, of which the last is measured", "1", within(1, 1000)),
        count("steps-per-cycle", "quasistatic: equilibria in a cycle, a multiple of 4", "32", within(4, 100000)),
        quantity("ramp", "1", "quasistatic: shear to this strain instead of cycles", "", within(-10, 10)),
        count("ramp-steps", "quasistatic: equally spaced equilibria on the ramp", "50", within(1, 100000))};
    read_only_with(options, {"amplitudes", "ramp"}, "method", {"quasistatic"});
    read_only_with(options, {"down", "cycles", "steps-per-cycle"}, "amplitudes");
    read_only_with(options, {"ramp-steps"}, "ramp");
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
    Findings found{.group = "/mechanics/quasistatic", .results = {}};
    append_network(found.results, run, bonds);
    append_contact_stiffness(found.results, quasistatic_group, packing, bonds, run.model);
    const auto linear = append_network_keys(found.results, quasistatic_group, packing, bonds, run.model, progress);
    for (Test& test : tests) {
        clear_rounding(test, linear ? linear->mean_affine_modulus() : 0);
    }
    found.table = table_of_tests(tests, sweep);
    if (linear) {
        append_reason(found, packing, bonds, *linear);
    }
    if (sweep) {
        append_sweeps(found.results, tests, path.amplitudes);
    } else {
        append_ramps(found.results, tests);
    }
    return found;
}

}  // namespace coagula::stages
