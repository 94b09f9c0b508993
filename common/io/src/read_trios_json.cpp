// SPDX-License-Identifier: GPL-3.0-or-later
// JSON exports of TA Instruments TRIOS (schema software.tainstruments.com/schemas/TRIOSJSONExportSchema): Results hold, per
// processing, ColumnHeaders (key -> name and unit), Rows (key -> value) and the ResultsSteps that the rows belong to.
#include "measured_readers.hpp"

#include "text_reader.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace coagula::io {

namespace {

using Json = nlohmann::json;

constexpr const char* step_key = "Results Step Id";

const Json& member(const Json& object, const char* key) {
    static const Json none;
    return object.is_object() && object.contains(key) ? object[key] : none;
}

/// The value itself if it is an object, else an empty one, so that a loop may run over what is missing.
const Json& members(const Json& value) {
    static const Json none = Json::object();
    return value.is_object() ? value : none;
}

const Json& elements(const Json& value) {
    static const Json none = Json::array();
    return value.is_array() ? value : none;
}

std::string text_of(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : "";
}

std::string unit_of(const Json& object) {
    return normal_unit(text_of(member(member(object, "Unit"), "Name")));
}

bool is_json(const MeasuredText& text) {
    const auto first =
        std::find_if(text.lines.begin(), text.lines.end(), [](const std::string& line) { return !trim(line).empty(); });
    return first != text.lines.end() && trim(*first).starts_with('{');
}

Json parse(const MeasuredText& text) {
    std::string contents;
    for (const std::string& line : text.lines) {
        contents += line + '\n';
    }
    try {
        return Json::parse(contents);
    } catch (const Json::exception& error) {
        const std::string what = error.what();
        throw InputError(text.path + " begins as JSON but is none: " + what.substr(std::min(what.size(), what.find("] ") + 2)));
    }
}

/// Values of the geometry as lines "Diameter, 25.0 mm".
void add_metadata(const Json& root, MeasuredFile& file) {
    file.metadata.push_back({"Sample", "Name", text_of(member(member(root, "Sample"), "Name"))});
    const Json& instruments = member(member(member(root, "Procedure"), "Configuration"), "InstrumentConfigurations");
    for (const Json& instrument : elements(instruments)) {
        file.metadata.push_back({"", "Instrument name", text_of(member(instrument, "Name"))});
        for (const auto& [key, value] : members(member(instrument, "Geometry")).items()) {
            const std::string plain = value.is_object() ? text_of(member(value, "Value")) + " " + unit_of(value) : text_of(value);
            file.metadata.push_back({"Geometry", key, plain});
        }
    }
}

/// The tables of one processing: a table per step that has rows.
void add_tables(const MeasuredText& text, const Json& result, MissingCells& missing, std::vector<PlainTable>& tables) {
    const Json& columns = member(result, "ColumnHeaders");
    const Json& rows = member(result, "Rows");
    if (!columns.is_object() || !rows.is_array()) {
        throw InputError(text.path + ": Results hold no ColumnHeaders and Rows; export the measurement with its results");
    }
    std::vector<HeadingWithUnit> headings;
    for (const auto& [key, column] : columns.items()) {
        const std::string name = text_of(member(column, "DisplayName"));
        headings.push_back({name.empty() ? key : name, unit_of(column)});
    }
    std::map<std::string, TableBuilder> builders;  // by the step
    for (const Json& row : rows) {
        missing.add(text, 0, columns.size(), row.size());
        std::vector<std::string> cells;
        for (const auto& column : columns.items()) {
            cells.push_back(text_of(member(row, column.key().c_str())));
        }
        builders.try_emplace(text_of(member(row, step_key)), headings, false).first->second.add_row(cells);
    }
    std::map<std::string, std::string> names;
    std::vector<std::string> order;
    for (const Json& step : elements(member(result, "ResultsSteps"))) {
        order.push_back(text_of(member(step, "Id")));
        names[order.back()] = text_of(member(step, "Name"));
    }
    for (const auto& [id, builder] : builders) {
        order.push_back(id);
    }
    for (const std::string& id : order) {
        if (auto builder = builders.extract(id)) {
            tables.push_back(builder.mapped().take(names[id], static_cast<int>(tables.size()) + 1));
        }
    }
}

MeasuredFile read(const MeasuredText& text) {
    const Json root = parse(text);
    MeasuredFile file{text.path, MeasuredFormat::trios_json, false, {}, {}};
    add_metadata(root, file);
    MissingCells missing;
    for (const auto& result : members(member(root, "Results")).items()) {
        add_tables(text, result.value(), missing, file.tables);
    }
    if (file.tables.empty()) {
        throw InputError(text.path + " is JSON, but holds no Results as TRIOS exports them; export the measurement as text or CSV");
    }
    return file;
}

}  // namespace

const MeasuredReader trios_json_reader{MeasuredFormat::trios_json, "TRIOS JSON", is_json, read};

}  // namespace coagula::io
