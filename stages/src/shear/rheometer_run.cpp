// SPDX-License-Identifier: GPL-3.0-or-later
#include "rheometer_run.hpp"

#include <coagula/io/checkpoint_file.hpp>
#include <coagula/io/checkpoint_lock.hpp>
#include "network_keys.hpp"
#include "orientation_list.hpp"
#include "plate_stiffening.hpp"
#include "progress_part.hpp"
#include "rheometer_checkpoint.hpp"
#include "rheometer_results.hpp"

#include <coagula/io/contact_model_file.hpp>
#include <coagula/io/structure_file.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>

namespace coagula::stages {

namespace {

/// Progress of the test over all orientations, with the oscillations counted. The runs tell theirs by the name of their
/// orientation.
Progress whole_test(const Progress& progress, const std::vector<mechanics::ShearOrientation>& orientations, int oscillations) {
    return Progress([&progress, orientations, oscillations, reached = 0.0, said = std::string("coming to rest")](
                        std::string_view stage, double fraction, std::string_view /*remark*/) mutable {
        const auto count = orientations.size();
        for (std::size_t k = 0; k < count; ++k) {
            if (stage == "shear " + name_of(orientations[k])) {
                reached = std::max(reached, (static_cast<double>(k) + fraction) / static_cast<double>(count));
                const auto oscillation = std::min(static_cast<int>(fraction * oscillations) + 1, oscillations);
                said = counted("orientation", k + 1, count) + ", " +
                       counted("oscillation", static_cast<std::size_t>(oscillation), static_cast<std::size_t>(oscillations));
            }
        }
        progress.update("shearing", reached, said);
        return true;
    });
}

/// The stress that a network without a modulus shows is its inertia, which a run at a finite rate has, and no modulus of its own.
constexpr double inertial_modulus = 1e-2;  // over the affine one

void clear_inertia(const mechanics::LinearResponse& linear, mechanics::RheometerResult& result) {
    for (mechanics::RheometerRun& run : result.runs) {
        mechanics::Oscillation& last = run.oscillations.back();
        const double modulus = std::hypot(last.storage_modulus, last.loss_modulus);
        if (!has_modulus(linear, run.orientation) && modulus < inertial_modulus * linear.mean_affine_modulus()) {
            last.storage_modulus = last.loss_modulus = last.phase = 0;
            last.fundamental_storage = last.fundamental_loss = 0;
            run.rest_modulus = std::isfinite(run.rest_modulus) ? 0 : unset;
            run.rate_error = unset;
        }
    }
}

}  // namespace

std::string run_signature(const Arguments& arguments, const ContactModel& model) {
    nlohmann::ordered_json options = arguments.to_json();
    for (const char* name : {"output", "force", "quiet", "json", "threads", "checkpoint", "input", "model"}) {
        options.erase(name);
    }
    return options.dump() + "\n" + io::contact_model_text(model);
}

std::vector<Option> rheometer_options() {
    std::vector<Option> options = {
        choice("boundary", {"plates", "periodic"}, "dem: shear between plates of three layers of particles, or of a periodic cell",
               "plates"),
        quantity("amplitude", "1", "dem: strain amplitude of the last oscillation; amplitudes grow linearly up to it", "0.001",
                 within(1e-15, 1)),
        flag("constant-amplitude", "dem: all oscillations have the strain of --amplitude"),
        count("oscillations", "dem: number of oscillations", "10", within(1, 100000)),
        count("steps-per-oscillation", "dem: time steps of an oscillation, a multiple of 100", "24000", within(100, 100000000)),
        quantity("damping", "1", "dem: coefficient of the local damping", "0.9", within(0, 0.999)),
        quantity("density", "kg/m3", "dem: density of the particles, from which follows by how much their masses are scaled",
                 "3690kg/m3", within(1e-3, 1e6)),
        choice("rest-length", {"found", "radii"},
               "dem, quasistatic: distance at which a bond bears no force, that in the packing or r_i + r_j", "found"),
        text("orientation", "LIST",
             "dem, quasistatic: plate normal and shear direction, such as xy,zx, or all; of a compression xx, yy, zz", "all"),
        writes(text("checkpoint", "FILE",
                    "dem, quasistatic: file for what is done, written after every oscillation or orientation; a run that finds "
                    "it goes on from there"))};
    read_only_with(options,
                   {"boundary", "amplitude", "constant-amplitude", "oscillations", "steps-per-oscillation", "damping", "density"},
                   "method", {"dem"});
    read_only_with(options, {"rest-length", "orientation", "checkpoint"}, "method", {"quasistatic", "dem"});
    return options;
}

mechanics::RheometerOptions rheometer_options_of(const Arguments& arguments, const ContactModel& model,
                                                 const std::vector<double>& frequencies) {
    if (frequencies.size() > 1) {
        throw InputError(arguments.spelled("method", "dem") + " runs at one frequency, but " + std::to_string(frequencies.size()) +
                         " are given");
    }
    mechanics::RheometerOptions options;
    options.model = model;
    options.boundary =
        arguments.text("boundary") == "plates" ? mechanics::RheometerBoundary::plates : mechanics::RheometerBoundary::periodic;
    options.amplitude = arguments.quantity("amplitude");
    options.growing = !arguments.flag("constant-amplitude");
    options.oscillations = static_cast<int>(arguments.count("oscillations"));
    options.frequency = frequencies.empty() ? options.frequency : frequencies.front();
    options.steps_per_oscillation = static_cast<int>(arguments.count("steps-per-oscillation"));
    options.damping = arguments.quantity("damping");
    options.density = arguments.quantity("density");
    options.unstressed_as_found = arguments.text("rest-length") == "found";
    return options;
}

Findings rheometer_response(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress) {
    const mechanics::RheometerOptions& options = run.rheometer;
    const std::string& path = run.checkpoint.path;
    const std::string signature = run.checkpoint.wanted() ? run.checkpoint.signature + io::positions_sha256(packing) : "";

    std::optional<io::CheckpointLock> lock;
    std::optional<mechanics::RheometerCheckpoint> resumed;
    mechanics::RheometerControl control;
    if (run.checkpoint.wanted()) {
        lock.emplace(path);
        if (std::filesystem::exists(path)) {
            resumed = read_checkpoint(path, signature);
        }
        control.on_checkpoint = [&](const mechanics::RheometerCheckpoint& checkpoint) {
            write_checkpoint(path, signature, checkpoint);
        };
    }
    control.resume = resumed ? &*resumed : nullptr;
    const Progress whole = whole_test(progress, run.orientations, options.oscillations);
    mechanics::RheometerResult result = io::with_checkpoint(
        path, [&] { return mechanics::run_rheometer(packing, bonds, options, run.orientations, whole, control); });
    Results keys;
    const auto linear = append_network_keys(keys, "/mechanics/dem/", packing, bonds, run.model, progress);
    if (linear) {
        clear_inertia(*linear, result);
    }
    Findings found{
        .group = "/mechanics/dem", .results = datasets_of(result, options, run.bond_tolerance), .table = table_of(result, options)};
    std::move(keys.begin(), keys.end(), std::back_inserter(found.results));
    if (linear) {
        append_reason(found, packing, bonds, *linear);
    }
    if (options.boundary == mechanics::RheometerBoundary::plates) {
        append_plate_stiffening(found, packing, bonds, linear, result, options.plate_layers, progress);
    }
    return found;
}

}  // namespace coagula::stages
