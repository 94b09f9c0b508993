// SPDX-License-Identifier: GPL-3.0-or-later
// diagnose new: an experiment file from the exports of instruments.
#include <coagula/common/checks.hpp>
#include <coagula/experiment/measured_tables.hpp>
#include <coagula/experiment/new_experiment.hpp>
#include <coagula/stages/diagnose.hpp>

#include <algorithm>
#include <filesystem>

namespace coagula::stages {

using namespace experiment;

namespace {

Json table_json(const io::PlainTable& table, const RecognisedTable& what) {
    Json json = {{"table", table.number},
                 {"section", table.section},
                 {"test", table.test},
                 {"result", table.title},
                 {"rows", rows_of(table, what)},
                 {"first_row", std::max<std::size_t>(what.first, 1)},
                 {"kind", what.kind ? Json(diagnose::name_of(*what.kind)) : Json(nullptr)},
                 {"reason", what.reason},
                 {"columns", understood(table)},
                 {"not_understood", not_understood(table, {})},
                 {"cells_without_value", table.unreadable.size()},
                 {"flags", Json::object()}};
    for (const auto& [flag, rows] : table.flags) {
        json["flags"][flag] = rows;
    }
    return json;
}

Json file_json(const RecognisedFile& recognised) {
    Json json = {{"path", recognised.file.path},
                 {"format", io::name_of(recognised.file.format)},
                 {"decimal_comma", recognised.file.decimal_comma},
                 {"tables", Json::array()},
                 {"instrument", Json::object()}};
    for (const RecognisedTable& what : recognised.tables) {
        json["tables"].push_back(table_json(recognised.file.tables[what.place], what));
    }
    for (const io::InstrumentValue& value : io::instrument_values(recognised.file)) {
        json["instrument"][value.name] = value.name == "geometry" ? Json(value.text) : Json(value.value);
    }
    return json;
}

/// How many of the tables are used, and how many of these without units in their file.
struct Counts {
    std::size_t all = 0;
    std::size_t used = 0;
    std::size_t assumed = 0;
};

Counts count(const std::vector<RecognisedFile>& files) {
    Counts counts;
    for (const RecognisedFile& file : files) {
        for (const RecognisedTable& table : file.tables) {
            ++counts.all;
            counts.used += table.kind ? 1 : 0;
            counts.assumed += table.kind && !table.rules.headings.empty() ? 1 : 0;
        }
    }
    return counts;
}

/// No table can be used: why, of the first few.
[[noreturn]] void refuse(const std::vector<RecognisedFile>& files, std::size_t all) {
    constexpr std::size_t most_listed = 3;
    std::string reasons;
    std::size_t listed = 0;
    for (const RecognisedFile& file : files) {
        for (const RecognisedTable& table : file.tables) {
            if (listed++ < most_listed) {
                reasons += (reasons.empty() ? "" : "; ") + std::string("table ") +
                           std::to_string(file.file.tables[table.place].number) +
                           (files.size() > 1 ? " of " + file.file.path : "") + ": " + table.reason;
            }
        }
    }
    throw InputError((files.size() == 1 ? files.front().file.path + ": " : "") +
                     (all == 1 ? "the table" : "none of the " + std::to_string(all) + " tables") + " can" +
                     (all == 1 ? "not" : "") + " be diagnosed as it is: " + reasons + (all > most_listed ? "; ..." : ""));
}

}  // namespace

NewExperiment experiment_from_exports(const std::vector<std::string>& exports, const std::string& path) {
    std::vector<RecognisedFile> files;
    NewExperiment found{.json = {{"files", Json::array()}}, .text = {}};
    for (const std::string& input : exports) {
        files.push_back(recognise(input));
        found.json["files"].push_back(file_json(files.back()));
    }
    const Counts counts = count(files);
    found.json["measurements"] = counts.used;
    if (counts.used == 0) {
        refuse(files, counts.all);
    }
    found.text = new_experiment(files, std::filesystem::path(path).parent_path().string());
    found.json["experiment"] = found.text;
    found.table = {{"measurements", std::to_string(counts.used) + " of " + std::to_string(counts.all) + " tables" +
                                        (counts.used < counts.all ? "; the file says why the others are not used" : "")}};
    if (counts.assumed > 0) {
        found.table.emplace_back("units",
                                 "assumed for " + std::to_string(counts.assumed) + " tables whose file names none: check them");
    }
    return found;
}

Verb diagnose_new_verb() {
    return {.name = "diagnose new",
            .summary = "a commented experiment file from exports of instruments",
            .input = "EXPORT ...",
            .options = {output("file to write; printed when not given"), flag("force", "replace an existing file")},
            .many_inputs = true};
}

}  // namespace coagula::stages
