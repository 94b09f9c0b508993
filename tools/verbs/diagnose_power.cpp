#include "diagnose_power.hpp"

#include "cli/output_file.hpp"
#include "cli/progress_bar.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"

#include <coagula/diagnose/power.hpp>
#include <coagula/experiment/experiment_file.hpp>
#include <coagula/experiment/experiment_structures.hpp>
#include <coagula/experiment/simulation_cache.hpp>
#include <coagula/report/result_folder.hpp>

#include <cmath>
#include <optional>

namespace coagula::tools {

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
                  {{"relative", options.noise.stated_relative},
                   {"floor", options.noise.stated_floor},
                   {"phase", options.noise.stated_phase},
                   {"sample", options.noise.stated_sample}}},
                 {"causes", Json::array()}};
    for (const CausePower& cause : power.causes) {
        json["causes"].push_back(json_of(cause));
    }
    return json;
}

std::string percent(double part) {
    return with_unit(std::round(1000 * part) / 10, "1") + " %";
}

std::string describe(const Share& share) {
    return std::to_string(share.count) + " of " + std::to_string(share.of) + " (" + percent(share.low) + " to " +
           percent(share.high) + ")";
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
        {"found by chance", describe(power.by_chance) + " at the level of " + percent(options.diagnosis.level)}};
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
        throw InputError("--bootstrap is at most " + std::to_string(most) + " with --power, which diagnoses many data sets");
    }
    return static_cast<int>(std::min(arguments.count("bootstrap"), most));
}

}  // namespace

void run_power(const Arguments& arguments) {
    const Stopwatch clock;
    const int bootstrap = bootstrap_of(arguments);
    std::optional<ResultFolder> folder;
    if (arguments.has("output")) {
        folder.emplace(arguments.text("output"), "power.json", std::vector<std::string>{}, arguments.flag("force"));
    }
    const Progress progress = make_progress(arguments.flag("quiet"));
    ExperimentFile file = read_experiment(arguments.input());
    if (folder) {
        check_not_read(arguments, folder->files().front().string(), file.files);
    }
    diagnose::PowerOptions options;
    options.noise = file.noise;
    options.storage_modulus = file.expected_storage_modulus;
    if (arguments.has("causes")) {
        options.causes = split(arguments.text("causes"));
        diagnose::require_causes(options.causes);
    }
    const auto given = [&](const std::string& name, int otherwise) {
        return arguments.has(name) ? static_cast<int>(arguments.count(name)) : otherwise;
    };
    options.data_sets = given("data-sets", 200);
    options.diagnoses = given("diagnoses", 4);
    options.diagnosis.level = arguments.quantity("level");
    options.diagnosis.bootstrap = bootstrap;
    options.diagnosis.seed = static_cast<std::uint64_t>(arguments.count("seed"));
    ExperimentStructures structures = naming(arguments.input(), [&] {
        ExperimentStructures found = check_structures(file.experiment);
        make_structures(file.experiment, found, progress);
        return found;
    });
    diagnose::SimulationCache cache = folder ? read_cache(folder->path() / "simulations.txt") : diagnose::SimulationCache{};
    diagnose::Simulator simulator(std::move(structures.packings), std::move(structures.hashes), cache, progress,
                                  file.experiment.structure_groups);
    simulator.use(std::move(structures.stages));
    const Power power =
        naming(arguments.input(), [&] { return diagnose::find_power(file.experiment, simulator, options, progress); });

    Json json = json_of(power, options);
    json["seconds"] = clock.seconds();
    Table table = power_table(power, options);
    if (folder) {
        folder->write("simulations.txt", cache_text(cache));
        folder->write("power.json", json.dump(2) + "\n");
        folder->publish();
        table.emplace_back("written to", (folder->path() / "power.json").string());
    }
    report(arguments, json, table);
}

}  // namespace coagula::tools
