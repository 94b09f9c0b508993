#include "diagnosis_run.hpp"

#include "diagnosis_results.hpp"
#include "progress_bar.hpp"
#include "provenance.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/extended_model.hpp>
#include <coagula/generators/void_expansion.hpp>
#include <coagula/io/contact_model_file.hpp>
#include <coagula/io/structure_file.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace coagula::tools {

namespace {

using diagnose::Experiment;
namespace fs = std::filesystem;

struct Structures {
    std::vector<Packing> packings;
    std::vector<std::string> hashes;
};

Packing generate(const diagnose::StructureRecipe& recipe, const diagnose::Sample& sample, std::size_t seed,
                 const Progress& progress) {
    if (recipe.generator != "vem") {
        throw InputError("the experiment asks for structures by '" + recipe.generator +
                         "', which diagnose cannot make yet: generate them and name the files under structures");
    }
    generators::VoidExpansionOptions options;
    options.particles = recipe.particles;
    options.voids = recipe.voids;
    options.volume_fraction = sample.volume_fraction;
    options.radii = Eigen::VectorXd::Constant(recipe.particles, sample.particle_radius);
    options.seed = seed;
    if (std::isfinite(recipe.target_coordination)) {
        options.target_coordination = recipe.target_coordination;
    }
    return generators::expand_voids(options, progress).packing;
}

Structures structures_of(const Experiment& experiment, const Progress& progress) {
    Structures found;
    for (const std::string& path : experiment.structures) {
        found.packings.push_back(io::read_structure(path).packing);
        if (!found.packings.back().cell.is_periodic()) {
            throw InputError(path + ": a structure for a diagnosis must have a periodic cell");
        }
    }
    if (found.packings.empty() && experiment.recipe) {
        for (const std::size_t seed : experiment.recipe->seeds) {
            found.packings.push_back(generate(*experiment.recipe, experiment.sample, seed, progress));
        }
    }
    if (found.packings.empty()) {
        throw InputError("the experiment names no structures: give files, or a recipe that makes them");
    }
    for (const Packing& packing : found.packings) {
        found.hashes.push_back(io::positions_sha256(packing));
    }
    return found;
}

/// Gives every modulus without a standard error that of the noise model of its kind.
void state_errors(Experiment& experiment, const std::vector<diagnose::NoiseModel>& noise, diagnose::NoiseSettings& settings) {
    for (diagnose::Measurement& table : experiment.measurements) {
        for (diagnose::Column& column : table.columns) {
            const auto model = std::find_if(noise.begin(), noise.end(), [&](const diagnose::NoiseModel& one) {
                return one.kind == table.kind && one.observable == column.name;
            });
            if (model == noise.end() || !column.standard_errors.empty()) {
                continue;
            }
            settings.sample = model->sample.value;
            const diagnose::Column* strain = diagnose::find_column(table, "strain");
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const double weight = model->floor_of_stress && strain != nullptr ? 1 / strain->values[row] : 1.0;
                column.standard_errors.push_back(diagnose::standard_deviation(*model, column.values[row], weight));
            }
        }
    }
}

/// What was simulated before, one line per result: key, tab, numbers.
diagnose::SimulationCache read_cache(const fs::path& path) {
    diagnose::SimulationCache cache;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos) {
            continue;  // a line cut off by an interruption
        }
        std::vector<double> values;
        for (const std::string& word : split(line.substr(tab + 1), ' ')) {
            values.push_back(std::strtod(word.c_str(), nullptr));
        }
        cache[line.substr(0, tab)] = std::move(values);
    }
    return cache;
}

std::string cache_text(const diagnose::SimulationCache& cache) {
    std::string text;
    for (const auto& [key, values] : cache) {
        text += key + "\t";
        for (std::size_t k = 0; k < values.size(); ++k) {
            text += (k > 0 ? " " : "") + to_text(values[k]);
        }
        text += "\n";
    }
    return text;
}

/// A new file beside the target, then renamed.
void write_text(const fs::path& path, const std::string& text) {
    const fs::path temporary = path.string() + ".new";
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
        fs::remove(temporary);
        throw std::runtime_error("cannot write " + path.string());
    }
    fs::rename(temporary, path);
}

fs::path checked_folder(const Arguments& arguments) {
    const fs::path folder = arguments.text("output");
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw InputError(folder.string() + " is there already and is no folder");
    }
    if (fs::exists(folder / "diagnosis.json") && !arguments.flag("force")) {
        throw InputError((folder / "diagnosis.json").string() + " is there already; use --force to replace it");
    }
    return folder;
}

}  // namespace

std::vector<Option> diagnosis_options() {
    return {output("folder for diagnosis.json, extended_model.toml and the cache of simulations"),
            quantity("level", "1", "of the test whether anything is wrong", "0.05", between(0, 1)),
            count("bootstrap", "data sets drawn for the test", "999", within(99, 1000000)),
            count("seed", "of the random numbers", "1", at_least(0)), flag("force", "replace an existing diagnosis")};
}

void run_diagnosis(const Arguments& arguments, ExperimentFile file, const std::vector<diagnose::NoiseModel>& noise) {
    const Progress progress = make_progress(arguments.flag("quiet"));
    const fs::path folder = checked_folder(arguments);
    const Stopwatch clock;
    diagnose::DiagnosisOptions options;
    options.level = arguments.quantity("level");
    options.bootstrap = static_cast<int>(arguments.count("bootstrap"));
    options.seed = static_cast<std::uint64_t>(arguments.count("seed"));
    state_errors(file.experiment, noise, options.noise);
    Structures structures = structures_of(file.experiment, progress);

    diagnose::SimulationCache cache = read_cache(folder / "simulations.txt");
    const double radius = mean_radius(structures.packings.front());
    diagnose::Simulator simulator(std::move(structures.packings), std::move(structures.hashes), cache, progress);
    const diagnose::Diagnosis diagnosis = diagnose::diagnose(file.experiment, simulator, options, progress);

    fs::create_directories(folder);
    std::string model;
    const auto& set = diagnosis.credible_set;
    const auto best = std::find_if(diagnosis.causes.begin(), diagnosis.causes.end(),
                                   [&](const diagnose::Cause& cause) { return !set.empty() && cause.name == set.front(); });
    if (diagnosis.detected && best != diagnosis.causes.end() && !best->parameters.empty()) {
        model = (folder / "extended_model.toml").string();
        write_text(model, "# " + best->name + ": " + best->words + "\n" +
                              io::contact_model_text(diagnose::contact_model_of(best->settings, radius)));
    }
    Json json = to_json(diagnosis, model);
    json["seconds"] = clock.seconds();
    write_text(folder / "simulations.txt", cache_text(cache));
    write_text(folder / "diagnosis.json", json.dump(2) + "\n");
    Table table = table_of(diagnosis);
    table.emplace_back("written to", folder.string());
    report(arguments, json, table);
}

}  // namespace coagula::tools
