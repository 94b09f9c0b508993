// SPDX-License-Identifier: GPL-3.0-or-later
// dataset run: what is missing is computed, and the set put together.
#include "process_pool.hpp"
#include "set_cost.hpp"
#include "set_work.hpp"

#include <coagula/common/failures.hpp>
#include <coagula/common/parallel.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/checksums.hpp>
#include <coagula/io/file_lock.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;

/// What is known of the structures of a sweep before anything runs.
struct Known {
    std::map<std::string, SetRecord> records;
    std::map<std::string, io::SetStructure> structures;
    std::optional<io::SetHead> whole_set = {};  ///< of an existing set that holds just what this call is to write
};

void take_from_set(const Sweep& sweep, const SetRun& run, Known& known) {
    if (!fs::exists(run.output)) {
        return;
    }
    io::SetHead head = io::read_set(run.output);
    std::map<std::string, SetRecord> records = records_in(head);
    const std::size_t recorded = records.size();
    const std::vector<std::string> held = io::structures_in_set(run.output);
    std::set<std::string> wanted;
    for (const SetRow& row : sweep.rows) {
        wanted.insert(row.id);
    }
    const auto dropped =
        std::count_if(records.begin(), records.end(), [&](const auto& entry) { return !wanted.contains(entry.first); });
    if (dropped > 0 && !run.drop) {
        throw InputError(run.output + " holds " + std::to_string(dropped) + " structures that " + sweep.path +
                         " does not name: give another output, or --force to leave them out");
    }
    for (auto& [id, record] : records) {
        const bool whole = !record.done || !run.keep_structures || std::binary_search(held.begin(), held.end(), id);
        if (wanted.contains(id) && whole && (record.done || !run.retry)) {
            if (record.done && run.keep_structures) {
                known.structures[id] = {id, run.output, io::group_of_structure(id)};
            }
            known.records.emplace(id, std::move(record));
        }
    }
    if (known.records.size() == recorded && recorded == sweep.rows.size() && known.structures.size() == held.size()) {
        known.whole_set = std::move(head);
    }
}

/// Whether the set would be written again as it is. Its columns follow from the records, which are its own.
bool is_written(const Known& known, const io::SetHead& head) {
    const auto same = [](const auto& some, const auto& others) {  // a file has an order of its own
        return std::is_permutation(some.begin(), some.end(), others.begin(), others.end());
    };
    return known.whole_set && known.whole_set->sweep == head.sweep && same(known.whole_set->card, head.card) &&
           same(known.whole_set->provenance, head.provenance);
}

void take_from_parts(const Sweep& sweep, const SetRun& run, const SetParts& parts, Known& known) {
    for (const SetRow& row : sweep.rows) {
        if (known.records.contains(row.id)) {
            continue;
        }
        std::optional<SetRecord> record = parts.record(row.id);
        const bool whole = record && (!record->done || !run.keep_structures || fs::exists(parts.structure(row.id)));
        if (whole && (record->done || !run.retry)) {
            known.records.emplace(row.id, std::move(*record));
        }
    }
}

/// The number of the trajectory of every row, in the order in which they come first.
std::vector<std::size_t> trajectories_of(const std::vector<SetRow>& rows) {
    std::map<std::string, std::size_t> numbers;
    std::vector<std::size_t> all;
    all.reserve(rows.size());
    for (const SetRow& row : rows) {
        all.push_back(numbers.try_emplace(row.trajectory, numbers.size()).first->second);
    }
    return all;
}

/// Rows that are missing, those of one trajectory together, as it passes them.
std::vector<std::vector<const SetRow*>> missing_rows(const Sweep& sweep, const Known& known) {
    const std::vector<std::size_t> trajectories = trajectories_of(sweep.rows);
    std::map<std::size_t, std::vector<const SetRow*>> missing;
    for (std::size_t k = 0; k < sweep.rows.size(); ++k) {
        if (!known.records.contains(sweep.rows[k].id)) {
            missing[trajectories[k]].push_back(&sweep.rows[k]);
        }
    }
    std::vector<std::vector<const SetRow*>> groups;
    for (auto& [number, rows] : missing) {
        std::stable_sort(rows.begin(), rows.end(), [](const SetRow* a, const SetRow* b) { return a->stop < b->stop; });
        groups.push_back(std::move(rows));
    }
    return groups;
}

std::string remark_on(const PoolState& state, std::size_t pieces, double seconds) {
    std::string text = std::to_string(state.done) + " of " + std::to_string(pieces);
    if (state.done > 0 && state.done < pieces) {
        const double left = seconds * static_cast<double>(pieces - state.done) / static_cast<double>(state.done);
        text += left < 90 ? ", about " + std::to_string(std::lround(left)) + " s left"
                          : ", about " + std::to_string(std::lround(left / 60)) + " min left";
    }
    return text;
}

void compute(const std::vector<std::vector<const SetRow*>>& groups, const SetRun& run, int jobs, const SetParts& parts,
             const Progress& progress) {
    const Stopwatch clock;
    Pool pool;
    pool.pieces = groups.size();
    pool.jobs = std::min(jobs, static_cast<int>(std::min<std::size_t>(groups.size(), 1024)));
    pool.threads = usable_threads(std::max(1, omp_get_num_procs() / std::max(pool.jobs, 1)));
    pool.work = [&](std::size_t piece) { compute_rows(groups[piece], parts, run.keep_structures); };
    pool.died = [&](std::size_t piece, const std::string& reason) {
        for (const SetRow* row : groups[piece]) {
            if (!parts.record(row->id)) {
                parts.keep({.id = row->id, .message = reason, .version = version_text()});
            }
        }
    };
    pool.told = [&](const PoolState& state) {
        progress.update("structures", static_cast<double>(state.done) / static_cast<double>(pool.pieces),
                        remark_on(state, pool.pieces, clock.seconds()));
    };
    try {
        run_pool(pool);
    } catch (const Cancelled&) {
        throw std::runtime_error("interrupted: what is done lies in " + parts.folder().string() +
                                 ", and the same call goes on from it");
    }
}

/// The part of the rows that a chunk is.
std::vector<SetRow> rows_of_chunk(const std::vector<SetRow>& rows, std::size_t number, std::size_t count) {
    const std::vector<std::size_t> trajectories = trajectories_of(rows);
    std::vector<SetRow> chosen;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (trajectories[k] % count == number - 1) {
            chosen.push_back(rows[k]);
        }
    }
    return chosen;
}

/// What people and programs read about the set.
Printed printed(const std::vector<SetRow>& rows, const std::map<std::string, SetRecord>& records, std::size_t computed,
                const std::string& output, double seconds) {
    const auto failed = std::count_if(rows.begin(), rows.end(), [&](const SetRow& row) { return !records.at(row.id).done; });
    Json json = {{"structures", rows.size()}, {"computed", computed}, {"failed", failed},
                 {"failures", Json::array()}, {"output", output},     {"seconds", seconds}};
    Table table = {{"structures", std::to_string(rows.size()) + ", of which " + std::to_string(computed) + " were computed now"}};
    for (const SetRow& row : rows) {
        const SetRecord& record = records.at(row.id);
        if (!record.done) {
            json["failures"].push_back({{"id", row.id}, {"message", record.message}});
        }
    }
    if (failed > 0) {
        table.emplace_back("failed",
                           std::to_string(failed) + "; the first: " + json["failures"].front()["message"].get<std::string>());
    }
    table.emplace_back("time", with_unit(seconds, "s"));
    table.emplace_back("written to", output);
    return {std::move(json), std::move(table)};
}

/// Whether a process that was killed left it: temporary files and locks are hidden.
bool is_left_over(const fs::path& path) {
    return path.filename().string().starts_with('.') && (path.extension() == ".tmp" || path.extension() == ".lock");
}

void remove_parts(const std::vector<SetRow>& rows, const SetParts& parts) {
    std::vector<fs::path> finished;
    for (const SetRow& row : rows) {
        finished.emplace_back(parts.structure(row.id));
        finished.push_back(parts.folder() / (row.id + ".json"));
    }
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(parts.folder(), ignored)) {
        if (is_left_over(entry.path())) {
            finished.push_back(entry.path());
        }
    }
    for (const fs::path& path : finished) {
        fs::remove(path, ignored);
    }
    fs::remove(parts.folder(), ignored);  // unless others are in it
}

}  // namespace

Printed run_sweep(const Sweep& whole, const SetRun& run, const Progress& progress) {
    const Stopwatch clock;
    Sweep sweep = whole;
    if (run.chunk) {
        sweep.rows = rows_of_chunk(whole.rows, run.chunk->first, run.chunk->second);
    }
    check_not_read(run.output, sweep.path, {});
    io::check_output(run.output, true);
    const io::OutputPlace place(run.output);
    io::FileLock lock(place, "run");
    if (!lock.try_take()) {
        throw InputError("another run is writing " + run.output + ": wait for its end, or give this run another output");
    }
    Known known;
    take_from_set(sweep, run, known);
    const SetParts parts(run.output);
    take_from_parts(sweep, run, parts, known);
    const auto groups = missing_rows(sweep, known);
    std::size_t computed = 0;
    if (!groups.empty()) {
        io::make_folder(parts.folder());
        compute(groups, run, jobs_of(sweep, run), parts, progress);
        for (const auto& group : groups) {
            computed += group.size();
            for (const SetRow* row : group) {
                known.records[row->id] = parts.record(row->id).value();
            }
        }
    }
    std::vector<io::SetStructure> structures;
    for (const SetRow& row : sweep.rows) {
        if (run.keep_structures && known.records.at(row.id).done) {
            const auto held = known.structures.find(row.id);
            structures.push_back(held != known.structures.end() ? held->second : io::SetStructure{row.id, parts.structure(row.id)});
        }
    }
    const io::SetHead head = head_of(sweep, known.records);
    if (!is_written(known, head)) {
        progress.update("writing", 1.0);
        io::write_set(run.output, head, structures, true);
    }
    remove_parts(sweep.rows, parts);
    return printed(sweep.rows, known.records, computed, run.output, clock.seconds());
}

SetRun set_run(const Arguments& arguments) {
    SetRun run{.output = arguments.text("output", ""),
               .jobs = arguments.has("jobs") ? static_cast<int>(arguments.count("jobs")) : 0,
               .memory = arguments.optional_quantity("memory").value_or(0),
               .keep_structures = !arguments.flag("no-structures"),
               .retry = arguments.flag("retry-failed"),
               .drop = arguments.flag("force")};
    if (arguments.has("chunk")) {
        run.chunk = arguments.parsed("chunk", [](const std::string& text) {
            const std::vector<std::string> parts = split(text, '/');
            if (parts.size() != 2) {
                throw InputError("'" + text + "' is not NUMBER/COUNT, such as 3/16");
            }
            const double number = parse_quantity(parts[0], "1", within(1, 1e6));
            const double count = parse_quantity(parts[1], "1", within(number, 1e6));
            return std::pair{static_cast<std::size_t>(number), static_cast<std::size_t>(count)};
        });
    }
    return run;
}

Verb dataset_run_verb() {
    return {
        .name = "dataset run",
        .summary = "make the structures of a sweep, measure and shear them, and write them as one set",
        .input = "SWEEP.toml",
        .options = {required(output("data set to write, SET.h5; what it holds already is not computed again")),
                    count("jobs", "structures that are computed at the same time; as many as processors when not given", "",
                          within(1, 1024)),
                    quantity("memory", "byte", "memory for all of them together; fewer jobs run where it is not enough", "",
                             within(1e7, 1e15)),
                    flag("no-structures", "keep the index only, not the structures"),
                    flag("retry-failed", "compute structures again that failed before"),
                    text("chunk", "K/N", "make the K-th of N parts of the sweep only, for dataset join"),
                    flag("force", "leave structures of an existing set out that the sweep does not name")},
        .notes = {
            "A call that was interrupted or killed goes on from SET.h5.parts when it is repeated.",
            "The data sets follow from sweep and version alone; what is made in one call has equal bytes for any number of jobs."}};
}

}  // namespace coagula::stages
