// SPDX-License-Identifier: GPL-3.0-or-later
// coagula info: what is in a file.
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/common/contact_network.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/table.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/recorded_options.hpp>

#include <iostream>
#include <map>

namespace coagula::tools {

namespace {

std::string shown_value(const io::Dataset& dataset) {
    if (const auto* text = std::get_if<std::string>(&dataset.values)) {
        return *text;
    }
    if (!dataset.shape.empty()) {
        std::string shape;
        for (const std::size_t length : dataset.shape) {
            shape += (shape.empty() ? "" : " x ") + std::to_string(length);
        }
        return shape + (dataset.shape.size() == 1 ? " values" : " matrix") + (dataset.unit == "1" ? "" : ", " + dataset.unit);
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&dataset.values)) {
        return with_unit(numbers->front(), dataset.unit);
    }
    return std::to_string(std::get<std::vector<std::int64_t>>(dataset.values).front());
}

/// Arrays longer than this, such as one value per bond, are listed with their shape only.
constexpr std::size_t longest_listed = 1000;

bool is_long(const io::Dataset& dataset) {
    return !dataset.shape.empty() && dataset.shape.front() > longest_listed;
}

Json results_json(const Results& results) {
    Json json = Json::object();
    for (const io::Dataset& dataset : results) {
        Json& entry = json[dataset.path];
        entry["value"] = is_long(dataset) ? Json(nullptr) : to_json(dataset);
        if (is_long(dataset)) {
            entry["shape"] = dataset.shape;
        }
        entry["unit"] = dataset.unit;
        entry["description"] = dataset.description;
    }
    return json;
}

Json provenance_json(const std::string& path, const std::vector<io::Provenance>& history) {
    Json list = Json::array();
    for (const io::Provenance& entry : history) {
        list.push_back({{"stage", entry.stage},
                        {"command_line", entry.command_line},
                        {"options", stages::recorded_options(path, entry.options)},
                        {"seed", entry.seed},
                        {"version", entry.version},
                        {"time", entry.time},
                        {"seconds", entry.seconds},
                        {"positions_sha256", entry.positions_sha256}});
    }
    return list;
}

Json structure_json(const io::Structure& structure) {
    const Packing& packing = structure.packing;
    Json json = {
        {"particles", packing.size()},
        {"box", box_lengths(packing.cell)},
        {"edges", box_edges(packing.cell)},
        {"periodic", packing.cell.is_periodic()},
        {"periodic_edges", packing.cell.periodicity()},
        {"volume_fraction", volume_fraction(packing)},
        {"radius", {{"mean", mean_radius(packing)}, {"min", packing.radii.minCoeff()}, {"max", packing.radii.maxCoeff()}}}};
    json["bonds"] = structure.bonds ? Json(structure.bonds->size()) : Json(nullptr);
    return json;
}

Table structure_table(const io::Structure& structure) {
    const Packing& packing = structure.packing;
    const std::string spread = is_monodisperse(packing) ? ""
                                                        : ", from " + with_unit(packing.radii.minCoeff(), "m") + " to " +
                                                              with_unit(packing.radii.maxCoeff(), "m");
    return {{"particles", std::to_string(packing.size())},
            {"box", describe(packing.cell)},
            {"volume fraction", with_unit(volume_fraction(packing), "1") +
                                    (!packing.cell.is_open() ? "" : " of the box that encloses the centres and their spheres")},
            {"radius", with_unit(mean_radius(packing), "m") + spread},
            {"bonds", structure.bonds ? std::to_string(structure.bonds->size()) : "none"}};
}

/// Numbers of bonds of the results that were found with another list of bonds than that in /connectivity, by group.
std::map<std::string, std::size_t> own_bonds(const Results& results) {
    const std::string ending = "/connectivity/bonds";
    std::map<std::string, std::size_t> found;
    for (const io::Dataset& dataset : results) {
        if (dataset.path.ends_with(ending) && !dataset.shape.empty()) {
            found[dataset.path.substr(0, dataset.path.size() - ending.size())] = dataset.shape[0];
        }
    }
    return found;
}

Json contents_json(const std::string& path, const io::Contents& contents) {
    Json json = structure_json(contents.structure);
    json["own_bonds"] = own_bonds(contents.results);
    json["results"] = results_json(contents.results);
    json["provenance"] = provenance_json(path, contents.history);
    return json;
}

Table contents_table(const io::Contents& contents) {
    Table table = structure_table(contents.structure);
    for (const auto& [group, bonds] : own_bonds(contents.results)) {
        table.emplace_back(group, "found with " + std::to_string(bonds) + " other bonds, which are in " + group + "/connectivity");
    }
    for (const io::Dataset& dataset : contents.results) {
        table.emplace_back(dataset.path, shown_value(dataset) + "   (" + dataset.description + ")");
    }
    for (const io::Provenance& entry : contents.history) {
        table.emplace_back(entry.time,
                           entry.command_line + "   (" + with_unit(entry.seconds, "s") + ", coagula " + entry.version + ")");
    }
    return table;
}

}  // namespace

void run_info(const Arguments& arguments) {
    const std::vector<std::string>& paths = arguments.inputs();
    if (arguments.flag("csv")) {
        if (arguments.flag("json") || arguments.flag("quiet")) {
            throw InputError("--csv excludes --json and --quiet");
        }
        std::cout << io::csv_text(stages::table_of_files(paths));
        flush_output();
        return;
    }
    Json files = Json::array();
    Table table;
    for (const std::string& path : paths) {
        const io::Contents contents = io::read_contents(path);
        files.push_back(contents_json(path, contents));
        if (paths.size() > 1) {
            files.back()["file"] = path;
            table.emplace_back("file", path);
        }
        const Table lines = contents_table(contents);
        table.insert(table.end(), lines.begin(), lines.end());
    }
    report(arguments, paths.size() > 1 ? Json{{"files", files}} : files.front(), table);
}

Verb info_verb() {
    return {
        .name = "info",
        .summary = "what is in files: structure, results, history",
        .input = "FILE.h5",
        .options = {stages::flag("csv", "print a table with one row per file: options of the generator and every scalar result")},
        .many_inputs = true};
}

}  // namespace coagula::tools
