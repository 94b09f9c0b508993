// coagula info: what is in a file.
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/common/contact_network.hpp>
#include <coagula/io/structure_file.hpp>

#include <map>
#include <sstream>

namespace coagula::tools {

namespace {

std::string value_text(const io::Dataset& dataset) {
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

/// The options of a stage, which are no deeper than this; a text that is no JSON stays a text.
Json options_json(const std::string& path, const std::string& text) {
    constexpr int deepest = 16;
    const auto refuse_deep = [&](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
        if (depth > deepest) {
            throw InputError(path + ": the options in its provenance are JSON nested deeper than " + std::to_string(deepest) +
                             " levels");
        }
        return true;
    };
    const Json options = Json::parse(text, refuse_deep, false);
    return options.is_discarded() ? Json(text) : options;
}

Json provenance_json(const std::string& path, const std::vector<io::Provenance>& history) {
    Json list = Json::array();
    for (const io::Provenance& entry : history) {
        list.push_back({{"stage", entry.stage},
                        {"command_line", entry.command_line},
                        {"options", options_json(path, entry.options)},
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
    const Eigen::Vector3d box = packing.cell.lengths();
    Json json = {
        {"particles", packing.size()},
        {"box", {box.x(), box.y(), box.z()}},
        {"periodic", packing.cell.is_periodic()},
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
                                    (packing.cell.is_periodic() ? "" : " of the box that encloses the centres and their spheres")},
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

void run(const Arguments& arguments) {
    const std::string path = arguments.input();
    const auto [structure, results, history] = io::read_contents(path);

    Json json = structure_json(structure);
    const std::map<std::string, std::size_t> own = own_bonds(results);
    json["own_bonds"] = own;
    json["results"] = results_json(results);
    json["provenance"] = provenance_json(path, history);

    Table table = structure_table(structure);
    for (const auto& [group, bonds] : own) {
        table.emplace_back(group, "found with " + std::to_string(bonds) + " other bonds, which are in " + group + "/connectivity");
    }
    for (const io::Dataset& dataset : results) {
        table.emplace_back(dataset.path, value_text(dataset) + "   (" + dataset.description + ")");
    }
    for (const io::Provenance& entry : history) {
        table.emplace_back(entry.time,
                           entry.command_line + "   (" + with_unit(entry.seconds, "s") + ", coagula " + entry.version + ")");
    }
    report(arguments, json, table);
}

}  // namespace

Verb info_verb() {
    return {
        .name = "info", .summary = "what is in a file: structure, results, history", .input = "FILE.h5", .options = {}, .run = run};
}

}  // namespace coagula::tools
