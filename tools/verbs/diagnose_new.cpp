#include "diagnose_new.hpp"

#include "cli/report.hpp"
#include "new_experiment.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/experiment/measured_tables.hpp>
#include <coagula/io/atomic_file.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace coagula::tools {

using namespace experiment;
using namespace coagula::report;

namespace {

Json table_json(const io::PlainTable& table, const RecognisedTable& what) {
    Json json = {{"table", table.number},
                 {"section", table.section},
                 {"test", table.test},
                 {"result", table.title},
                 {"rows", table.rows()},
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
    std::size_t number = 0;
    for (const io::PlainTable& table : recognised.file.tables) {
        if (table.point == 0) {
            json["tables"].push_back(table_json(table, recognised.tables[number++]));
        }
    }
    for (const io::InstrumentValue& value : io::instrument_values(recognised.file)) {
        json["instrument"][value.name] = value.name == "geometry" ? Json(value.text) : Json(value.value);
    }
    return json;
}

}  // namespace

void run_new(const Arguments& arguments) {
    const std::string path = arguments.text("output", "");
    std::vector<RecognisedFile> files;
    Json json = {{"files", Json::array()}};
    std::size_t used = 0;
    std::size_t all = 0;
    for (const std::string& input : arguments.inputs()) {
        files.push_back(recognise(input));
        json["files"].push_back(file_json(files.back()));
        all += files.back().tables.size();
        used += static_cast<std::size_t>(std::count_if(files.back().tables.begin(), files.back().tables.end(),
                                                       [](const RecognisedTable& table) { return table.kind.has_value(); }));
    }
    const std::string text = new_experiment(files, std::filesystem::path(path).parent_path().string());
    json["measurements"] = used;
    json["experiment"] = text;
    if (path.empty()) {
        if (arguments.flag("json")) {
            report(arguments, json, {});
        } else {
            std::cout << text;
            flush_output();
        }
        return;
    }
    io::write_file(path, text, arguments.flag("force"));
    report(arguments, json,
           {{"experiment", path},
            {"measurements", std::to_string(used) + " of " + std::to_string(all) + " tables" +
                                 (used < all ? "; the file says why the others are not used" : "")},
            {"next", "coagula diagnose --check " + path}});
}

}  // namespace coagula::tools
