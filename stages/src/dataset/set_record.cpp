// SPDX-License-Identifier: GPL-3.0-or-later
#include "set_record.hpp"

#include <coagula/characterize/measure.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/io/checksums.hpp>
#include <coagula/stages/characterize.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/shear.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace coagula::stages {

namespace {

const std::string uncertainty = "uncertainty/";

std::string dotted(std::string path) {
    std::replace(path.begin(), path.end(), '/', '.');
    return path;
}

/// Whether characterize has results under this name, so that those of shear need another one.
bool is_name_of_measure(const std::string& name) {
    static const std::vector<std::string> measures = characterize::measure_names();
    const std::string first = name.substr(0, name.find('.'));
    return std::find(measures.begin(), measures.end(), first) != measures.end();
}

/// Whether an option has this name, which says the same.
bool is_name_of_option(const std::string& name) {
    static const std::set<std::string> options = [] {
        std::set<std::string> names;
        for (const Verb& verb : {generate_vem_verb(), generate_brownian_verb(), characterize_verb(), shear_verb()}) {
            for (const Option& option : verb.options) {
                names.insert(option.name);
            }
        }
        return names;
    }();
    return options.contains(name);
}

/// The column of a result; empty for what is no result of its own.
std::string column_of(const std::string& group, const std::string& path) {
    std::string name = path.substr(group.size() + 1);
    if (name.starts_with("conditions/") || name.starts_with("left_out/")) {
        return {};
    }
    if (group.starts_with("/generation")) {
        return "generation." + dotted(name);
    }
    if (name.starts_with(uncertainty)) {
        return dotted(name.substr(uncertainty.size())) + ".stderr";
    }
    name = dotted(name);
    if (is_name_of_option(name)) {
        return {};
    }
    return group.starts_with("/mechanics") && is_name_of_measure(name) ? "shear." + name : name;
}

}  // namespace

void append_results(SetRecord& record, const Findings& found) {
    for (const io::Dataset& dataset : found.results) {
        const std::string name = dataset.shape.empty() ? column_of(found.group, dataset.path) : std::string{};
        const auto* real = std::get_if<std::vector<double>>(&dataset.values);
        const auto* whole = std::get_if<std::vector<std::int64_t>>(&dataset.values);
        if (name.empty() || (real == nullptr && whole == nullptr)) {
            continue;
        }
        const double value = real != nullptr ? real->front() : static_cast<double>(whole->front());
        record.results.emplace_back(name, SetValue{value, real == nullptr, dataset.unit, dataset.description});
    }
}

std::string record_text(const SetRecord& record) {
    Json json = {{"id", record.id},           {"done", record.done},     {"message", record.message},
                 {"version", record.version}, {"sha256", record.sha256}, {"results", Json::array()}};
    for (const auto& [name, result] : record.results) {
        json["results"].push_back({name, std::isfinite(result.value) ? Json(result.value) : Json(nullptr), result.whole,
                                   result.unit, result.description});
    }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<SetRecord> record_from(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        SetRecord record{.id = json.at("id"),
                         .done = json.at("done"),
                         .message = json.at("message"),
                         .version = json.at("version"),
                         .sha256 = json.at("sha256")};
        for (const Json& entry : json.at("results")) {
            record.results.emplace_back(entry.at(0).get<std::string>(),
                                        SetValue{entry.at(1).is_null() ? unset : entry.at(1).get<double>(), entry.at(2).get<bool>(),
                                                 entry.at(3), entry.at(4)});
        }
        return record;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

namespace {

const std::vector<std::string>& texts_in(const io::SetHead& set, const std::string& name) {
    static const std::vector<std::string> none;
    const io::SetColumn* column = set.column(name);
    const auto* texts = column == nullptr ? nullptr : std::get_if<std::vector<std::string>>(&column->values);
    if (texts == nullptr) {
        throw InputError("the index of the data set has no column '" + name + "' of texts");
    }
    return *texts;
}

}  // namespace

std::map<std::string, SetRecord> records_in(const io::SetHead& set) {
    const std::vector<std::string>& ids = texts_in(set, "id");
    std::map<std::string, SetRecord> records;
    for (std::size_t row = 0; row < ids.size(); ++row) {
        records[ids[row]] = {.id = ids[row],
                             .done = texts_in(set, "status")[row] == "done",
                             .message = texts_in(set, "message")[row],
                             .version = texts_in(set, "version")[row],
                             .sha256 = texts_in(set, "sha256")[row]};
    }
    for (const io::SetColumn& column : set.index) {
        if (column.description.starts_with("option of ")) {
            continue;
        }
        for (std::size_t row = 0; row < ids.size(); ++row) {
            SetRecord& record = records[ids[row]];
            if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
                record.results.emplace_back(column.name,
                                            SetValue{static_cast<double>((*wholes)[row]), true, column.unit, column.description});
            } else if (const auto* reals = std::get_if<std::vector<double>>(&column.values)) {
                record.results.emplace_back(column.name, SetValue{(*reals)[row], false, column.unit, column.description});
            }
        }
    }
    return records;
}

namespace {

/// A column of options as it grows: what each row has, or nothing.
struct OptionColumn {
    std::string name;
    Option option;
    std::string verb;
    std::vector<std::optional<Given>> values = {};

    bool varies() const {
        return std::any_of(values.begin(), values.end(), [&](const auto& value) { return value != values.front(); });
    }
};

std::optional<Given> value_of(const Arguments& arguments, const Option& option) {
    if (option.kind == Option::Kind::flag) {
        return Given(std::int64_t{arguments.flag(option.name)});
    }
    if (!arguments.has(option.name)) {
        return std::nullopt;
    }
    if (option.kind == Option::Kind::count) {
        return Given(arguments.count(option.name));
    }
    return option.kind == Option::Kind::quantity ? Given(arguments.quantity(option.name)) : Given(arguments.text(option.name));
}

io::SetColumn column_from(const OptionColumn& column) {
    io::SetColumn made{column.name, column.option.unit.empty() ? "1" : column.option.unit,
                       "option of " + column.verb + ": " + column.option.meaning};
    const bool all = std::all_of(column.values.begin(), column.values.end(), [](const auto& value) { return value.has_value(); });
    const bool whole = column.option.kind == Option::Kind::count || column.option.kind == Option::Kind::flag;
    if (column.option.kind == Option::Kind::text) {
        std::vector<std::string> texts;
        for (const auto& value : column.values) {
            texts.push_back(value ? std::get<std::string>(*value) : std::string{});
        }
        made.values = std::move(texts);
    } else if (whole && all) {
        std::vector<std::int64_t> numbers;
        for (const auto& value : column.values) {
            numbers.push_back(std::get<std::int64_t>(*value));
        }
        made.values = std::move(numbers);
    } else {
        std::vector<double> numbers;
        for (const auto& value : column.values) {
            const auto* number = value ? std::get_if<std::int64_t>(&*value) : nullptr;
            numbers.push_back(!value ? unset : number != nullptr ? static_cast<double>(*number) : std::get<double>(*value));
        }
        made.values = std::move(numbers);
    }
    return made;
}

/// The options of one stage, by their names. A name that an earlier stage has gets that of its own in front.
void append_options(std::vector<OptionColumn>& columns, const std::vector<SetRow>& rows, const std::vector<Verb>& verbs,
                    const std::function<const Arguments*(const SetRow&)>& stage) {
    const std::size_t before = columns.size();
    for (const Verb& verb : verbs) {
        const std::string word = verb.name.substr(0, verb.name.find(' '));
        for (const Option& option : verb.options) {
            const auto known = [&](const OptionColumn& column) { return column.option.name == option.name; };
            const auto own = columns.begin() + static_cast<std::ptrdiff_t>(before);
            if (std::any_of(own, columns.end(), known)) {
                continue;
            }
            const bool taken = std::any_of(columns.begin(), own, known);
            columns.push_back({(taken ? word + "." : "") + option.name, option, word});
        }
    }
    for (std::size_t k = before; k < columns.size(); ++k) {
        for (const SetRow& row : rows) {
            const Arguments* arguments = stage(row);
            columns[k].values.push_back(arguments == nullptr ? std::nullopt : value_of(*arguments, columns[k].option));
        }
    }
}

std::vector<io::SetColumn> option_columns(const std::vector<SetRow>& rows) {
    std::vector<OptionColumn> columns;
    append_options(columns, rows, {in_memory(generate_vem_verb()), in_memory(generate_brownian_verb())},
                   [](const SetRow& row) { return &row.generate; });
    append_options(columns, rows, {in_memory(characterize_verb())},
                   [](const SetRow& row) { return row.characterize ? &*row.characterize : nullptr; });
    append_options(columns, rows, {in_memory(shear_verb())}, [](const SetRow& row) { return row.shear ? &*row.shear : nullptr; });
    std::vector<io::SetColumn> made;
    for (const OptionColumn& column : columns) {
        if (column.name == "seed" || column.varies()) {
            made.push_back(column_from(column));
        }
    }
    return made;
}

/// Every result that any structure has, in the order of the first.
std::vector<io::SetColumn> result_columns(const std::vector<SetRow>& rows, const std::map<std::string, SetRecord>& records) {
    std::vector<io::SetColumn> columns;
    std::map<std::string, std::size_t> places;
    std::vector<bool> whole;
    std::vector<std::vector<double>> values;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        for (const auto& [name, result] : records.at(rows[row].id).results) {
            const auto [place, added] = places.emplace(name, columns.size());
            if (added) {
                columns.push_back({name, result.unit, result.description});
                whole.push_back(true);
                values.emplace_back(rows.size(), unset);
            }
            const bool missing = !result.whole && std::isnan(result.value);
            values[place->second][row] = result.value;
            whole[place->second] = whole[place->second] && (result.whole || missing);
        }
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const bool complete = std::all_of(values[k].begin(), values[k].end(), [](double value) { return std::isfinite(value); });
        if (whole[k] && complete) {
            columns[k].values = std::vector<std::int64_t>(values[k].begin(), values[k].end());
        } else {
            columns[k].values = std::move(values[k]);
        }
    }
    return columns;
}

}  // namespace

std::vector<io::SetColumn> index_of(const std::vector<SetRow>& rows, const std::map<std::string, SetRecord>& records) {
    std::vector<std::string> id, status, message, generator, version, sha256;
    for (const SetRow& row : rows) {
        const SetRecord& record = records.at(row.id);
        id.push_back(row.id);
        status.emplace_back(record.done ? "done" : "failed");
        message.push_back(record.message);
        generator.push_back(row.generate.verb().substr(std::string("generate ").size()));
        version.push_back(record.version);
        sha256.push_back(record.sha256);
    }
    std::vector<io::SetColumn> columns = {{"id", "1", "name of the structure, which follows from its options", id},
                                          {"status", "1", "done or failed", status},
                                          {"message", "1", "why the structure failed", message},
                                          {"generator", "1", "generator of the structure", generator}};
    const std::vector<io::SetColumn> options = option_columns(rows);
    const std::vector<io::SetColumn> results = result_columns(rows, records);
    columns.insert(columns.end(), options.begin(), options.end());
    columns.insert(columns.end(), results.begin(), results.end());
    columns.push_back({"version", "1", "version of coagula that computed the structure", version});
    columns.push_back({"sha256", "1", "SHA-256 of all data sets of the structure but its history", sha256});
    return columns;
}

io::SetHead head_of(const Sweep& sweep, const std::map<std::string, SetRecord>& records) {
    io::SetHead head{.card = sweep.card, .sweep = sweep.text};
    head.index = index_of(sweep.rows, records);
    std::string sums;
    for (const SetRow& row : sweep.rows) {
        sums += row.id + records.at(row.id).sha256;
    }
    head.card.emplace_back("structures", std::to_string(sweep.rows.size()));
    head.card.emplace_back("checksum", io::sha256(sums));
    head.card.emplace_back("creator", "coagula " + version_text());
    head.provenance = {{"version", version_text()}, {"sweep_file", sweep.path}, {"sweep_sha256", io::sha256(sweep.text)}};
    return head;
}

}  // namespace coagula::stages
