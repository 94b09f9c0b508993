// SPDX-License-Identifier: GPL-3.0-or-later
// dataset table, verify and join: what is done with sets that are there.
#include "set_work.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/scratch_folder.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;

std::string cell(const io::SetColumn& column, std::size_t row) {
    if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
        return (*texts)[row];
    }
    if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
        return std::to_string((*wholes)[row]);
    }
    const double value = std::get<std::vector<double>>(column.values)[row];
    return std::isfinite(value) ? to_text(value) : std::string{};
}

/// The sweep from which a set was made.
Sweep sweep_of(const io::SetHead& set, const std::string& path) {
    for (const auto& [name, text] : set.provenance) {
        if (name == "sweep_file") {
            return parse_sweep(set.sweep, text);
        }
    }
    throw InputError(path + ": /provenance/sweep_file is missing, so that the sweep cannot be read again");
}

void compare_sums(const std::string& path, const std::map<std::string, SetRecord>& records) {
    std::map<std::string, std::string> sums;
    for (const auto& [id, sum] : io::structure_sums(path)) {
        sums[id] = sum;
    }
    for (const auto& [id, record] : records) {
        if (!record.done || record.sha256.empty()) {
            continue;
        }
        if (!sums.contains(id)) {
            throw InputError(path + ": the structure " + id + " is missing; dataset run computes it again");
        }
        if (sums.at(id) != record.sha256) {
            throw InputError(path + ": the structure " + id +
                             " does not have the checksum of its row: it was changed or is damaged");
        }
    }
}

bool equal(double one, double other) {
    return one == other || (std::isnan(one) && std::isnan(other));
}

/// Throws where a result differs from that in the set. Columns of the set may hold NaN for what a structure does not have.
void compare_results(const std::string& path, const SetRecord& stored, const SetRecord& computed) {
    for (const auto& [name, result] : computed.results) {
        const auto found =
            std::find_if(stored.results.begin(), stored.results.end(), [&](const auto& entry) { return entry.first == name; });
        if (found == stored.results.end() || !equal(found->second.value, result.value)) {
            throw InputError(path + ": " + name + " of the structure " + stored.id + " is " +
                             (found == stored.results.end() ? "missing" : to_text(found->second.value)) + ", but computed again " +
                             to_text(result.value));
        }
    }
}

}  // namespace

std::vector<std::vector<std::string>> table_of_set(const io::SetHead& set) {
    std::vector<std::vector<std::string>> rows(1 + (set.index.empty() ? 0 : set.index.front().size()));
    for (const io::SetColumn& column : set.index) {
        rows[0].push_back(column.unit.empty() || column.unit == "1" ? column.name : column.name + " [" + column.unit + "]");
        for (std::size_t row = 0; row < column.size(); ++row) {
            rows[row + 1].push_back(cell(column, row));
        }
    }
    return rows;
}

Printed verify_set(const std::string& path, std::int64_t sample, const Progress& progress) {
    const Stopwatch clock;
    const io::SetHead set = io::read_set(path);
    const std::map<std::string, SetRecord> records = records_in(set);
    progress.update("checksums", 0);
    compare_sums(path, records);
    const Sweep sweep = sweep_of(set, path);
    std::vector<const SetRow*> done;
    for (const SetRow& row : sweep.rows) {
        const auto record = records.find(row.id);
        if (record == records.end()) {
            continue;  // of another chunk
        }
        if (record->second.done) {
            done.push_back(&row);
        }
    }
    if (done.empty() && std::any_of(records.begin(), records.end(), [](const auto& entry) { return entry.second.done; })) {
        throw InputError(path + ": no structure has the options that its sweep says; a file that the sweep names has changed");
    }
    const auto wanted = std::min(static_cast<std::size_t>(sample), done.size());
    const ScratchFolder scratch;
    const SetParts parts((scratch.path() / "again").string());
    fs::create_directories(parts.folder());
    for (std::size_t k = 0; k < wanted; ++k) {
        const SetRow& row = *done[wanted > 1 ? k * (done.size() - 1) / (wanted - 1) : 0];  // from the first to the last
        progress.update("computing again", static_cast<double>(k) / static_cast<double>(wanted), row.id);
        const SetRecord& stored = records.at(row.id);
        compute_rows({&row}, parts, !stored.sha256.empty());
        const SetRecord computed = parts.record(row.id).value();
        if (!computed.done) {
            throw InputError(path + ": the structure " + row.id + " cannot be computed again: " + computed.message);
        }
        compare_results(path, stored, computed);
        if (computed.sha256 != stored.sha256) {
            throw InputError(path + ": the structure " + row.id + " computed again differs from that in the set (which coagula " +
                             stored.version + " made)");
        }
    }
    const Json json = {{"structures", records.size()}, {"computed_again", wanted}, {"seconds", clock.seconds()}};
    return {json,
            {{"structures", std::to_string(records.size()) + ", all with the checksums of their rows"},
             {"computed again", std::to_string(wanted) + ", equal in every bit"}}};
}

Printed join_sets(const std::vector<std::string>& paths, const std::string& output, bool overwrite) {
    io::check_output(output, overwrite);
    const io::SetHead first = io::read_set(paths.front());
    const Sweep sweep = sweep_of(first, paths.front());
    std::map<std::string, SetRecord> records;
    std::map<std::string, io::SetStructure> held;
    for (const std::string& path : paths) {
        const io::SetHead set = io::read_set(path);
        if (set.sweep != first.sweep) {
            throw InputError(path + " was made from another sweep than " + paths.front() +
                             ": only parts of one sweep can be joined");
        }
        for (auto& [id, record] : records_in(set)) {
            records.insert_or_assign(id, std::move(record));
        }
        for (const std::string& id : io::structures_in_set(path)) {
            held[id] = {id, path, io::group_of_structure(id)};
        }
    }
    std::vector<io::SetStructure> structures;
    std::size_t missing = 0;
    for (const SetRow& row : sweep.rows) {
        missing += records.contains(row.id) ? 0 : 1;
        if (const auto found = held.find(row.id); found != held.end()) {
            structures.push_back(found->second);
        }
    }
    if (missing > 0) {
        throw InputError("the sets lack " + std::to_string(missing) + " of the " + std::to_string(sweep.rows.size()) +
                         " structures of their sweep: give the sets of all chunks");
    }
    io::write_set(output, head_of(sweep, records), structures, overwrite);
    return {{{"structures", sweep.rows.size()}, {"sets", paths.size()}, {"output", output}},
            {{"structures", std::to_string(sweep.rows.size()) + " from " + std::to_string(paths.size()) + " sets"},
             {"written to", output}}};
}

Verb dataset_table_verb() {
    return {.name = "dataset table",
            .summary = "the index of a data set as CSV, units in the headings",
            .input = "SET.h5",
            .options = {output("file to write; printed when not given"), flag("force", "replace an existing file")}};
}

Verb dataset_verify_verb() {
    return {.name = "dataset verify",
            .summary = "compare the checksums of a data set and compute some structures again, bit by bit",
            .input = "SET.h5",
            .options = {count("sample", "structures that are computed again", "3", within(0, 1e9))}};
}

Verb dataset_join_verb() {
    return {.name = "dataset join",
            .summary = "join the sets of the chunks of a sweep",
            .input = "SET.h5 ...",
            .options = {required(output("data set to write")), flag("force", "replace an existing set")},
            .many_inputs = true};
}

}  // namespace coagula::stages
