// SPDX-License-Identifier: GPL-3.0-or-later
// diagnose: structures, noise, diagnosis, files.
#include "diagnosis_options.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/model.hpp>
#include <coagula/experiment/checked_experiment.hpp>
#include <coagula/experiment/simulation_cache.hpp>
#include <coagula/io/contact_model_file.hpp>
#include <coagula/report/data_notes.hpp>
#include <coagula/report/diagnosis_datasets.hpp>
#include <coagula/report/diagnosis_page.hpp>
#include <coagula/report/diagnosis_results.hpp>
#include <coagula/report/result_folder.hpp>
#include <coagula/stages/diagnose.hpp>
#include <coagula/stages/provenance.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace coagula::stages {

namespace {

using diagnose::Experiment;
using namespace experiment;
using namespace coagula::report;

/// What a model of the contact cannot have of a cause.
std::string outside_of_contact(const diagnose::CauseSet& set) {
    std::string text;
    for (std::size_t place = 0; place < diagnose::catalogue().size(); ++place) {
        const diagnose::Mechanism& mechanism = diagnose::catalogue()[place];
        if (!mechanism.in_contact && set.contains(place)) {
            text += "# " + mechanism.name + " does not act in the contact; the contact below leaves it out.\n";
        }
    }
    return text;
}

/// The best cause; null where nothing departs, or none of the catalogue leads.
const diagnose::Cause* cause_to_extend_by(const diagnose::Diagnosis& diagnosis) {
    const auto& set = diagnosis.credible_set;
    return set.empty() || set.front().unknown ? nullptr : diagnose::best_cause(diagnosis);
}

/// The contact of the best cause as a TOML file; empty when there is none or nothing shows its stiffness.
std::string model_text(const diagnose::Diagnosis& diagnosis, double radius) {
    const diagnose::Cause* best = cause_to_extend_by(diagnosis);
    if (best == nullptr || std::isnan(radius) || diagnosis.base.parameters.empty()) {
        return {};
    }
    return "# " + best->name() + ": " + best->words + "\n" + outside_of_contact(best->set) +
           io::contact_model_text(diagnose::contact_model_of(best->model, radius));
}

/// Whether a row of a structure series stands for a group; without their column the rows are counted.
bool has_group(const diagnose::Measurement& table, double group) {
    if (table.kind != diagnose::MeasurementKind::structure_series) {
        return false;
    }
    const diagnose::Column* column = diagnose::find_column(table, "structure");
    return column == nullptr ? group <= static_cast<double>(table.rows())
                             : std::find(column->values.begin(), column->values.end(), group) != column->values.end();
}

/// The notes of the experiment file, and notes where the structures differ from the sample.
std::vector<std::string> notes_on(const Experiment& experiment, double radius, std::vector<std::string> notes) {
    constexpr double noticeable = 0.05;
    const std::vector<double>& fractions = experiment.structure_volume_fractions;
    const double fraction = std::accumulate(fractions.begin(), fractions.end(), 0.0) / static_cast<double>(fractions.size());
    const auto compare = [&](double there, double stated, const std::string& what, const std::string& key,
                             const std::string& unit) {
        if (std::abs(there - stated) > noticeable * stated) {
            notes.push_back("the structures have a " + what + " of " + with_unit(there, unit) +
                            ", with which they are simulated, but " + key + " is " + with_unit(stated, unit));
        }
    };
    if (experiment.structure_groups.empty()) {
        compare(fraction, experiment.sample.volume_fraction, "volume fraction", "sample.volume_fraction", "1");
    }
    compare(radius, experiment.sample.particle_radius, "particle radius", "sample.particle_radius", "m");
    for (const std::size_t group : std::set(experiment.structure_groups.begin(), experiment.structure_groups.end())) {
        const auto stands = [&](const diagnose::Measurement& table) { return has_group(table, static_cast<double>(group)); };
        if (std::none_of(experiment.measurements.begin(), experiment.measurements.end(), stands)) {
            notes.push_back("no row of a structure series is number " + std::to_string(group) + " of structures.groups");
        }
    }
    return notes;
}

constexpr double keeping_interval = 60;  // s
constexpr const char* cache_name = "simulations.txt";

/// Keeps what was simulated once a minute and when the user interrupts, so that the same call goes on from it.
Progress keeping(const Progress& progress, ResultFolder& folder, const diagnose::SimulationCache& cache) {
    return Progress([&progress, &folder, &cache, since = Stopwatch()](std::string_view stage, double fraction,
                                                                      std::string_view remark) mutable {
        try {
            progress.update(stage, fraction, remark);
        } catch (const Cancelled&) {
            if (cache.empty()) {
                throw;
            }
            folder.keep(cache_name, cache_text(cache));
            throw std::runtime_error("interrupted: what was simulated so far is in " + (folder.path() / cache_name).string() +
                                     ", and the same call goes on from it");
        }
        if (since.seconds() > keeping_interval) {
            folder.keep(cache_name, cache_text(cache));
            since = Stopwatch();
        }
        return true;
    });
}

/// A diagnosis and all that its record needs.
struct Diagnosed {
    CheckedExperiment checked;
    double radius;  ///< of the particles in the structures [m]; unset: there are none
    std::vector<std::string> sentences;
    diagnose::Diagnosis diagnosis;
    std::string contact;                  ///< of the best cause, as TOML; empty: none
    std::vector<std::string> structures;  ///< calls that make those of the best cause; empty: those of the experiment

    std::vector<std::string> notes() const { return notes_on(checked.file.experiment, radius, report::notes_on(checked)); }

    /// @param model path of the extended model; empty: none.
    Json json(const std::string& model, double seconds) const {
        Json all = report::to_json(diagnosis, checked.noise, model);
        all["extended_structures"] = structures;
        all["notes"] = notes();
        all["seconds"] = seconds;
        return all;
    }
};

/// @param outputs files that will be written.
Diagnosed diagnosed(const DiagnoseRun& run, const std::vector<std::filesystem::path>& outputs, diagnose::SimulationCache& cache,
                    const Progress& progress) {
    CheckedExperiment checked = check_experiment(run.experiment, run.options);
    for (const std::filesystem::path& output : outputs) {
        check_not_read(output.string(), run.experiment, checked.file.files);
    }
    Experiment& experiment = checked.file.experiment;
    ExperimentStructures& structures = checked.structures;
    naming(run.experiment, [&] { make_structures(experiment, structures, progress); });

    const double radius = structures.packings.empty() ? unset : mean_radius(structures.packings.front());
    std::vector<std::string> sentences = structure_sentences(experiment, structures);
    diagnose::Simulator simulator(std::move(structures.packings), std::move(structures.hashes), cache, progress,
                                  experiment.structure_groups);
    simulator.use(std::move(structures.stages));
    diagnose::Diagnosis diagnosis =
        naming(run.experiment, [&] { return diagnose::diagnose(experiment, simulator, checked.options, progress); });
    std::string contact = model_text(diagnosis, radius);
    const diagnose::Cause* best = cause_to_extend_by(diagnosis);
    std::vector<std::string> calls;
    if (best != nullptr) {
        calls = remaking_calls(experiment, best->model.simulated().structures);
    }
    return {std::move(checked), radius, std::move(sentences), std::move(diagnosis), std::move(contact), std::move(calls)};
}

/// Diagnoses, and writes everything into a folder.
Printed write_diagnosis(const DiagnoseRun& run, const Progress& progress) {
    ResultFolder folder(run.folder, "diagnosis.json", {"report.html", "diagnosis.h5", "extended_model.toml"}, run.overwrite);
    const Stopwatch clock;
    diagnose::SimulationCache cache = read_cache(folder.path() / cache_name);
    const Diagnosed found = diagnosed(run, folder.files(), cache, keeping(progress, folder, cache));

    const std::string model = found.contact.empty() ? "" : (folder.path() / "extended_model.toml").string();
    if (found.contact.empty()) {
        folder.withdraw("extended_model.toml");
    } else {
        folder.write("extended_model.toml", found.contact);
    }
    const DiagnosisRecord record{found.checked.file.experiment,
                                 found.diagnosis,
                                 found.checked.noise,
                                 found.checked.options.errors,
                                 finished(run.call, clock),
                                 found.sentences,
                                 found.checked.options.level,
                                 model,
                                 found.structures,
                                 found.notes()};
    folder.write("report.html", diagnosis_page(record));
    io::write_datasets(folder.stage("diagnosis.h5").string(), datasets_of(record), true);
    folder.write(cache_name, cache_text(cache));
    Json json = found.json(model, clock.seconds());
    json["report"] = (folder.path() / "report.html").string();
    folder.write("diagnosis.json", json.dump(2) + "\n");
    folder.publish();
    Table table = report::table_of(found.diagnosis);
    for (const std::string& call : found.structures) {
        table.emplace_back("structures of the cause", call);
    }
    for (const std::string& note : record.notes) {
        table.emplace_back("note", note);
    }
    table.emplace_back("written to", folder.path().string() + ", report: " + (folder.path() / "report.html").string());
    return {std::move(json), std::move(table)};
}

}  // namespace

std::vector<Option> diagnosis_options() {
    return {output("folder for report.html, diagnosis.json, diagnosis.h5, extended_model.toml and the cache of simulations"),
            formerly("level",
                     quantity("significance", "1", "significance level of the test of the base model", "0.05", within(1e-6, 0.5))),
            count("bootstrap", "simulated data sets for that test", "999", within(99, 1000000)),
            count("seed", "seed of the random numbers", "1", at_least(0)), flag("force", "replace an existing diagnosis")};
}

diagnose::DiagnosisOptions diagnosis_options_of(const Arguments& arguments) {
    diagnose::DiagnosisOptions options;
    options.level = arguments.quantity("significance");
    options.bootstrap = static_cast<int>(arguments.count("bootstrap"));
    options.seed = static_cast<std::uint64_t>(arguments.count("seed"));
    if (arguments.has("causes")) {
        options.causes = split(arguments.text("causes"));
        diagnose::require_causes(options.causes);
    }
    return options;
}

std::vector<Option> options_of_plans() {
    return {text("causes", "NAME,NAME...", "consider only these causes, instead of the whole catalogue"),
            count("data-sets", "data sets simulated at each strength near a threshold (200)", "", within(20, 100000)),
            count("diagnoses", "full diagnoses of simulated data for each cause (4)", "", within(0, 10000))};
}

DiagnoseRun diagnose_run(const Arguments& arguments, std::string folder) {
    return {.experiment = arguments.input(),
            .folder = std::move(folder),
            .overwrite = arguments.flag("force"),
            .options = diagnosis_options_of(arguments),
            .call = describe_call(arguments, nullptr, Stopwatch())};
}

Printed diagnose_experiment(const DiagnoseRun& run, const Progress& progress) {
    if (!run.folder.empty()) {
        return write_diagnosis(run, progress);
    }
    const Stopwatch clock;
    diagnose::SimulationCache cache;
    const Diagnosed found = diagnosed(run, {}, cache, progress);
    return {found.json("", clock.seconds()), report::table_of(found.diagnosis)};
}

namespace {

/// What each way of working reads.
void add_conditions_of_modes(std::vector<Option>& options) {
    const std::vector<std::string> of_inference = {"causes", "significance", "bootstrap", "seed"};
    not_read_with(options, of_inference, "catalogue");
    not_read_with(options, of_inference, "new");
    not_read_with(options, of_inference, "check");
    not_read_with(options, {"output", "force", "check", "power", "new"}, "catalogue");
    not_read_with(options, {"output", "force"}, "check");
    not_read_with(options, {"check", "power"}, "new");
    not_read_with(options, {"check"}, "power");
    read_only_with(options, {"data-sets", "diagnoses"}, "power");
}

}  // namespace

Verb diagnose_verb() {
    Verb verb{
        .name = "diagnose",
        .summary = "where the simulation deviates from measured moduli, and the cause",
        .input = "EXPERIMENT.toml",
        .options = {flag("new", "old spelling of 'coagula diagnose new'"),
                    flag("check", "old spelling of 'coagula diagnose check'"),
                    flag("power", "old spelling of 'coagula diagnose plan'"),
                    flag("catalogue", "old spelling of 'coagula diagnose catalogue'"),
                    text("causes", "NAME,NAME...", "consider only these causes, instead of the whole catalogue"),
                    count("data-sets", "with --power: data sets simulated at each strength near a threshold (200)", "",
                          within(20, 100000)),
                    count("diagnoses", "with --power: full diagnoses of simulated data for each cause (4)", "", within(0, 10000))},
        .notes =
            {"Tables of G' and G'' against frequency, strain, time or gap, steps of stress, strain and rate, waveforms, structure "
             "series, coordinates and pore curves "
             "are diagnosed; see docs/explanation/diagnosis.md."},
        .many_beside = "new",
        .alone = "catalogue"};
    const std::vector<Option> own = diagnosis_options();
    verb.options.insert(verb.options.end(), own.begin(), own.end());
    add_conditions_of_modes(verb.options);
    return verb;
}

Verb diagnose_catalogue_verb() {
    return {.name = "diagnose catalogue",
            .summary = "the causes with their parameters and priors, as a table",
            .input = "",
            .options = {}};
}

}  // namespace coagula::stages
