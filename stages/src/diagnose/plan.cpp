// SPDX-License-Identifier: GPL-3.0-or-later
// diagnose plan: what a planned experiment could find.
#include "diagnosis_options.hpp"

#include <coagula/experiment/experiment_file.hpp>
#include <coagula/experiment/experiment_structures.hpp>
#include <coagula/experiment/simulation_cache.hpp>
#include <coagula/report/result_folder.hpp>
#include <coagula/stages/diagnose.hpp>
#include <coagula/stages/provenance.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace coagula::stages {

namespace {

using coagula::report::ResultFolder;
using diagnose::CausePower;
using diagnose::NamingRuns;
using diagnose::Power;
using diagnose::Share;
using diagnose::Threshold;
using namespace experiment;

Json json_of(const Share& share) {
    return {{"count", share.count}, {"of", share.of}, {"low", share.low}, {"high", share.high}};
}

Json json_of(const Threshold& threshold, const std::string& unit) {
    if (!std::isfinite(threshold.value)) {
        return nullptr;
    }
    const auto end = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    return {{"value", threshold.value}, {"low", end(threshold.low)}, {"high", end(threshold.high)}, {"unit", unit}};
}

Json json_of(const CausePower& cause) {
    const NamingRuns& naming = cause.naming;
    Json json = {{"name", cause.name},
                 {"parameter", cause.parameter},
                 {"unit", cause.unit},
                 {"range", {cause.range_low, cause.range_high}},
                 {"other_parameters", Json::object()},
                 {"found_half", json_of(cause.half, cause.unit)},
                 {"found_most", json_of(cause.most, cause.unit)},
                 {"curve", Json::array()},
                 {"diagnoses", nullptr}};
    for (const auto& [name, value] : cause.others) {
        json["other_parameters"][name] = value;
    }
    for (const diagnose::PowerPoint& point : cause.curve) {
        json["curve"].push_back({{"strength", point.strength}, {"found", json_of(point.found)}});
    }
    if (naming.runs > 0) {
        json["diagnoses"] = {{"strength", naming.strength},
                             {"runs", naming.runs},
                             {"named", json_of(diagnose::share_of(naming.named, naming.runs))},
                             {"tied", naming.tied},
                             {"misnamed", naming.misnamed},
                             {"none_of_catalogue", naming.none},
                             {"missed", naming.missed},
                             {"rivals", naming.rivals}};
    }
    return json;
}

Json json_of(const Power& power, const diagnose::PowerOptions& options) {
    Json json = {{"level", options.diagnosis.level},
                 {"moduli", power.moduli},
                 {"third_harmonics", power.third_harmonics},
                 {"storage_modulus", power.storage_modulus},
                 {"normal_stiffness", power.normal_stiffness},
                 {"by_chance", json_of(power.by_chance)},
                 {"noise",
                  {{"relative", options.noise.relative},
                   {"floor", options.noise.floor},
                   {"phase", options.noise.phase},
                   {"sample", options.noise.sample}}},
                 {"causes", Json::array()}};
    for (const CausePower& cause : power.causes) {
        json["causes"].push_back(json_of(cause));
    }
    return json;
}

std::string rounded_percent(double part) {
    return with_unit(std::round(1000 * part) / 10, "1") + " %";
}

std::string describe(const Share& share) {
    return std::to_string(share.count) + " of " + std::to_string(share.of) + " (" + rounded_percent(share.low) + " to " +
           rounded_percent(share.high) + ")";
}

std::string describe(const Threshold& threshold, const CausePower& cause) {
    if (!std::isfinite(threshold.value)) {
        return "not within its range";
    }
    const double weakest = cause.curve.front().strength;
    const auto text = [&](double value) { return std::isfinite(value) ? with_unit(value, cause.unit) : std::string("not known"); };
    return threshold.value == weakest
               ? "any strength of its range"
               : text(threshold.value) + (cause.curve.back().strength > weakest ? " or more (" : " or less (") +
                     text(threshold.low) + " to " + text(threshold.high) + ")";
}

std::string describe(const NamingRuns& naming) {
    if (naming.runs == 0) {
        return {};
    }
    std::string text = "named alone in " + describe(diagnose::share_of(naming.named, naming.runs));
    const auto add = [&](int count, const std::string& what) {
        text += count > 0 ? ", " + std::to_string(count) + " " + what : "";
    };
    add(naming.tied, "tied");
    add(naming.misnamed, "misnamed");
    add(naming.none, "none of the catalogue");
    add(naming.missed, "not found");
    std::string rivals;
    for (const auto& [name, count] : naming.rivals) {
        rivals += (rivals.empty() ? "; with " : ", ") + name + " (" + std::to_string(count) + ")";
    }
    return text + rivals;
}

Table power_table(const Power& power, const diagnose::PowerOptions& options) {
    const std::string waveforms =
        power.third_harmonics > 0 ? ", " + std::to_string(power.third_harmonics) + " parts of third harmonics" : "";
    Table table{
        {"planned", std::to_string(power.moduli) + " moduli, G' about " + with_unit(power.storage_modulus, "Pa") + waveforms},
        {"found by chance", describe(power.by_chance) + " at the level of " + rounded_percent(options.diagnosis.level)}};
    for (const CausePower& cause : power.causes) {
        if (!std::isfinite(cause.half.value)) {
            table.emplace_back(cause.name, "cannot be found: " + describe(cause.curve.back().found) + " at its strongest, " +
                                               cause.parameter + " " + with_unit(cause.curve.back().strength, cause.unit));
            continue;
        }
        table.emplace_back(cause.name, cause.parameter + ": found with 50 % at " + describe(cause.half, cause) + ", with 95 % at " +
                                           describe(cause.most, cause));
        const std::string naming = describe(cause.naming);
        if (!naming.empty()) {
            table.emplace_back("", "at " + with_unit(cause.naming.strength, cause.unit) + " " + naming);
        }
    }
    return table;
}

/// Many data sets are diagnosed, each with fewer draws than a single diagnosis.
int bootstrap_of(const Arguments& arguments) {
    constexpr std::int64_t most = 199;
    if (arguments.given("bootstrap") && arguments.count("bootstrap") > most) {
        throw InputError(arguments.spelled("bootstrap") + " is at most " + std::to_string(most) +
                         " in a plan, which diagnoses many data sets");
    }
    return static_cast<int>(std::min(arguments.count("bootstrap"), most));
}

}  // namespace

PlanRun plan_run(const Arguments& arguments) {
    PlanRun run{.experiment = arguments.input(), .folder = arguments.text("output", ""), .overwrite = arguments.flag("force")};
    const auto given = [&](const std::string& name, int otherwise) {
        return arguments.has(name) ? static_cast<int>(arguments.count(name)) : otherwise;
    };
    run.options.diagnosis = diagnosis_options_of(arguments);
    run.options.causes = std::exchange(run.options.diagnosis.causes, {});
    run.options.diagnosis.bootstrap = bootstrap_of(arguments);
    run.options.data_sets = given("data-sets", 200);
    run.options.diagnoses = given("diagnoses", 4);
    return run;
}

Printed plan_experiment(PlanRun run, const Progress& progress) {
    const Stopwatch clock;
    std::optional<ResultFolder> folder;
    if (!run.folder.empty()) {
        folder.emplace(run.folder, "power.json", std::vector<std::string>{}, run.overwrite);
    }
    ExperimentFile file = read_experiment(run.experiment);
    if (folder) {
        check_not_read(folder->files().front().string(), run.experiment, file.files);
    }
    run.options.noise = file.noise;
    run.options.storage_modulus = file.expected_storage_modulus;
    ExperimentStructures structures = naming(run.experiment, [&] {
        ExperimentStructures found = check_structures(file.experiment);
        make_structures(file.experiment, found, progress);
        return found;
    });
    diagnose::SimulationCache cache = folder ? read_cache(folder->path() / "simulations.txt") : diagnose::SimulationCache{};
    diagnose::Simulator simulator(std::move(structures.packings), std::move(structures.hashes), cache, progress,
                                  file.experiment.structure_groups);
    simulator.use(std::move(structures.stages));
    const Power power =
        naming(run.experiment, [&] { return diagnose::find_power(file.experiment, simulator, run.options, progress); });

    Json json = json_of(power, run.options);
    json["seconds"] = clock.seconds();
    Table table = power_table(power, run.options);
    if (folder) {
        folder->write("simulations.txt", cache_text(cache));
        folder->write("power.json", json.dump(2) + "\n");
        folder->publish();
        table.emplace_back("written to", (folder->path() / "power.json").string());
    }
    return {std::move(json), std::move(table)};
}

Verb diagnose_plan_verb() {
    std::vector<Option> options = options_of_plans();
    const std::vector<Option> own = diagnosis_options();
    options.insert(options.end(), own.begin(), own.end());
    return {.name = "diagnose plan",
            .summary = "before measuring: which causes an experiment could find, and from which strength on",
            .input = "EXPERIMENT.toml",
            .options = std::move(options)};
}

}  // namespace coagula::stages
