// SPDX-License-Identifier: GPL-3.0-or-later
// dataset plan: how many structures, and what they take.
#include "set_cost.hpp"
#include "set_work.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/scratch_folder.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;

/// Memory that the stages take for each particle, as measured with the usual measures and the direct solver [byte].
constexpr double bytes_per_particle = 3e4;
constexpr double bytes_of_program = 6e7;
constexpr std::int64_t most_calibrated = 1000;  // particles
constexpr std::size_t most_calibrations = 6;    // of a generator
constexpr double calibration_seconds = 20;      // after which none begins

double particles_of(const SetRow& row) {
    return static_cast<double>(row.generate.count("particles"));
}

/// The same structure with so few particles that it is made in seconds.
SetRow small_row(const SetRow& row) {
    SetRow small = row;
    const std::int64_t particles = row.generate.count("particles");
    if (particles > most_calibrated) {
        small.generate = row.generate.with_count("particles", most_calibrated);
        if (row.generate.has("voids")) {
            const double share = static_cast<double>(row.generate.count("voids")) / static_cast<double>(particles);
            small.generate = small.generate.with_count("voids", std::llround(share * most_calibrated));
        }
    }
    return small;
}

/// Costs of one particle; the times are those of one processor.
struct Cost {
    double generating = 0;  ///< [s]
    double stages = 0;      ///< measuring and shearing [s]
    double bytes = 0;       ///< in the set
    std::string failure;    ///< why a structure could not be made, if so
};

/// Computes one structure on one processor and removes it again.
Cost measured_cost(const SetRow& row, const SetRun& run) {
    const ScratchFolder scratch;
    const SetParts parts((scratch.path() / row.id).string());
    fs::create_directories(parts.folder());
    const SetRow small = small_row(row);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Stopwatch clock;
    const double generating = compute_rows({&small}, parts, run.keep_structures);
    const double all = clock.seconds();
    omp_set_num_threads(threads);
    const std::optional<SetRecord> record = parts.record(row.id);
    std::string failure;
    if (!record || !record->done) {
        failure = "the structure " + small.generate.call() + " with " + std::to_string(small.generate.count("particles")) +
                  " particles cannot be made: " + (record ? record->message : "nothing came of it");
    }
    std::error_code missing;
    const auto bytes = fs::file_size(parts.structure(row.id), missing);
    const double particles = particles_of(small);
    return {generating / particles, (all - generating) / particles, missing ? 0 : static_cast<double>(bytes) / particles, failure};
}

/// The last row of every trajectory of each generator.
std::map<std::string, std::vector<const SetRow*>> ends_of_trajectories(const Sweep& sweep) {
    std::map<std::string, const SetRow*> ends;
    for (const SetRow& row : sweep.rows) {
        const SetRow*& end = ends.try_emplace(row.trajectory, &row).first->second;
        end = row.stop > end->stop ? &row : end;
    }
    std::map<std::string, std::vector<const SetRow*>> of_generators;
    for (const SetRow& row : sweep.rows) {
        if (ends.at(row.trajectory) == &row) {
            of_generators[row.generate.verb()].push_back(&row);
        }
    }
    return of_generators;
}

/// The cost of a few structures that are spread over the sweep.
struct Calibration {
    std::map<std::string, Cost> costs;  ///< the mean cost of a particle by each generator
    std::size_t structures = 0;
    std::vector<std::string> failures;
};

/// A structure that cannot be made costs time, and stops a run as little as it stops this; only where none can be made is the first
/// reason an error.
Calibration calibrate(const Sweep& sweep, const SetRun& run, const Progress& progress) {
    Calibration result;
    for (const auto& [verb, rows] : ends_of_trajectories(sweep)) {
        const std::size_t wanted = std::min(most_calibrations, rows.size());
        const Stopwatch clock;
        Cost sum;
        std::size_t count = 0;
        std::size_t made = 0;
        for (; count < wanted && (made == 0 || clock.seconds() < calibration_seconds); ++count) {
            progress.update("calibration", static_cast<double>(count) / static_cast<double>(wanted), verb);
            const Cost cost = measured_cost(*rows[count * rows.size() / wanted], run);
            sum = {sum.generating + cost.generating, sum.stages + cost.stages, sum.bytes + cost.bytes, {}};
            if (cost.failure.empty()) {
                ++made;
            } else {
                result.failures.push_back(cost.failure);
            }
        }
        if (made == 0) {
            throw InputError(result.failures.back());
        }
        const auto tried = static_cast<double>(count);
        result.costs[verb] = {sum.generating / tried, sum.stages / tried, sum.bytes / static_cast<double>(made), {}};
        result.structures += count;
    }
    return result;
}

}  // namespace

double bytes_of_process(const Sweep& sweep) {
    double most = 0;
    for (const SetRow& row : sweep.rows) {
        most = std::max(most, particles_of(row));
    }
    return bytes_of_program + bytes_per_particle * most;
}

int jobs_of(const Sweep& sweep, const SetRun& run) {
    const int wanted = run.jobs > 0 ? run.jobs : omp_get_num_procs();
    if (run.memory == 0) {
        return wanted;
    }
    const double each = bytes_of_process(sweep);
    if (each > run.memory) {
        throw InputError("memory: a structure of this sweep takes about " + with_unit(each / 1e9, "1") +
                         " GB, more than the budget allows");
    }
    return std::clamp(static_cast<int>(run.memory / each), 1, wanted);
}

Printed plan_sweep(const Sweep& sweep, const SetRun& run, const Progress& progress) {
    const int jobs = jobs_of(sweep, run);
    const Calibration calibration = calibrate(sweep, run, progress);
    std::set<std::string> generated;
    std::set<std::string> trajectories;
    double seconds = 0;
    double bytes = 0;
    for (const SetRow& row : sweep.rows) {
        const Cost& cost = calibration.costs.at(row.generate.verb());
        const bool runs = trajectories.insert(row.trajectory).second;  // else it lies on the trajectory of another
        seconds += (cost.stages + (runs ? cost.generating : 0)) * particles_of(row);
        bytes += cost.bytes * particles_of(row);
        generated.insert(row.made_of);
    }
    const double on_jobs = seconds / jobs;
    const double memory = bytes_of_process(sweep) * jobs;
    Json json = {{"structures", sweep.rows.size()},
                 {"generated", generated.size()},
                 {"jobs", jobs},
                 {"processor_seconds", seconds},
                 {"seconds", on_jobs},
                 {"memory", memory},
                 {"bytes", bytes}};
    const auto duration = [](double time) {
        return time < 120    ? with_unit(std::round(time), "s")
               : time < 7200 ? to_text(std::round(time / 60)) + " min"
                             : to_text(std::round(time / 360) / 10) + " h";
    };
    const auto rounded = [](double size) { return to_text(std::round(size / 1e6)) + " MB"; };
    Table table = {
        {"structures", std::to_string(sweep.rows.size()) + ", of " + std::to_string(generated.size()) + " generated packings"},
        {"time", "about " + duration(on_jobs) + " with " + std::to_string(jobs) + (jobs == 1 ? " job" : " jobs") + ", " +
                     duration(seconds) + " of processor time"},
        {"memory", "about " + rounded(memory)},
        {"size of the set", "about " + rounded(bytes)}};
    json["notes"] = Json::array();
    if (!calibration.failures.empty()) {
        const std::string note = std::to_string(calibration.failures.size()) + " of " + std::to_string(calibration.structures) +
                                 " structures that were tried cannot be made; the first is this: " + calibration.failures.front();
        json["notes"].push_back(note);
        table.emplace_back("note", note);
    }
    return {json, table};
}

Verb dataset_plan_verb() {
    return {
        .name = "dataset plan",
        .summary = "how many structures a sweep has, and the time, memory and room that they take",
        .input = "SWEEP.toml",
        .options = {count("jobs", "structures that are computed at the same time; as many as processors when not given", "",
                          within(1, 1024)),
                    quantity("memory", "byte", "memory for all of them together", "", within(1e7, 1e15)),
                    flag("no-structures", "the set would keep its index only")},
        .notes = {
            "Up to six structures of each generator, spread over the sweep and of at most 1000 particles, are computed to tell;",
            "after 20 s none begins. Times grow as the number of particles."}};
}

}  // namespace coagula::stages
