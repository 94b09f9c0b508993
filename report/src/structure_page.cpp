// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/structure_page.hpp>

#include <coagula/io/printable.hpp>
#include <coagula/report/results.hpp>

#include "bundle.hpp"
#include "html.hpp"
#include "page_arrays.hpp"
#include "thinned.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace coagula::report {

namespace {

/// No more particles of a structure are shown, and fewer where the arrays of all structures would take more bytes than this.
constexpr Index most_particles = 64000;
constexpr std::size_t most_bytes = 18000000;

/// Longer arrays are for particles and bonds, which go into the block of arrays, or too long for a plot.
constexpr std::size_t longest_result = 4096;

template <class Derived>
std::vector<double> listed(const Eigen::DenseBase<Derived>& values) {
    const Eigen::MatrixXd plain = values;
    return {plain.data(), plain.data() + plain.size()};
}

std::vector<double> numbers_of(const io::Dataset& dataset) {
    if (const auto* real = std::get_if<std::vector<double>>(&dataset.values)) {
        return *real;
    }
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&dataset.values)) {
        return {whole->begin(), whole->end()};
    }
    return {};
}

/// Length of the vector of each particle.
std::vector<double> lengths_of(const std::vector<double>& values, std::size_t components) {
    std::vector<double> lengths(values.size() / components);
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        double square = 0;
        for (std::size_t c = 0; c < components; ++c) {
            square += values[k * components + c] * values[k * components + c];
        }
        lengths[k] = std::sqrt(square);
    }
    return lengths;
}

Json field_json(const io::Dataset& dataset, const Packing& packing, PageArrays& arrays) {
    std::vector<double> values = numbers_of(dataset);
    const auto particles = static_cast<std::size_t>(packing.size());
    const std::string name = dataset.path.substr(dataset.path.rfind('/') + 1);
    if (values.empty() || values.size() % particles != 0 || dataset.shape.front() != particles || name == "radius") {
        return {};
    }
    const std::size_t components = values.size() / particles;
    const bool is_arrow = components == 3 && dataset.unit == "m";  // a displacement, which the page can draw
    return {{"name", io::printable(name)},
            {"unit", io::printable(dataset.unit)},
            {"description", (components > 1 ? "length of the vector: " : "") + io::printable(dataset.description)},
            {"components", is_arrow ? 3 : 1},
            {"values", arrays.reals(components > 1 && !is_arrow ? lengths_of(values, components) : values)}};
}

/// Methods whose numbers for each bond refer to other bonds than those of the file.
std::set<std::string> groups_with_own_bonds(const std::vector<io::Dataset>& results) {
    const std::string ending = "/connectivity/bonds";
    std::set<std::string> groups;
    for (const io::Dataset& dataset : results) {
        if (dataset.path.ends_with(ending)) {
            groups.insert(dataset.path.substr(0, dataset.path.size() - ending.size()) + "/");
        }
    }
    return groups;
}

Json bond_fields_json(const PageStructure& page, PageArrays& arrays) {
    Json fields = Json::array();
    const std::set<std::string> own = groups_with_own_bonds(page.results);
    const auto bonds = static_cast<std::size_t>(page.structure.bonds ? page.structure.bonds->size() : 0);
    for (const io::Dataset& dataset : page.results) {
        const bool fits = bonds > 0 && dataset.shape == std::vector<std::size_t>{bonds} &&
                          dataset.path.find("/bonds/") != std::string::npos && page.bonds_in_file;
        const bool other =
            std::any_of(own.begin(), own.end(), [&](const std::string& group) { return dataset.path.starts_with(group); });
        if (!fits || other) {
            continue;
        }
        const auto* whole = std::get_if<std::vector<std::int64_t>>(&dataset.values);
        const bool is_flag =
            whole != nullptr && std::all_of(whole->begin(), whole->end(), [](std::int64_t v) { return v == 0 || v == 1; });
        fields.push_back({{"name", io::printable(dataset.path)},
                          {"unit", io::printable(dataset.unit)},
                          {"description", io::printable(dataset.description)},
                          {"values", is_flag ? arrays.flags(*whole) : arrays.reals(numbers_of(dataset))}});
    }
    return fields;
}

Json results_json(const std::vector<io::Dataset>& results) {
    Json list = Json::array();
    for (const io::Dataset& dataset : results) {
        const auto* text = std::get_if<std::string>(&dataset.values);
        std::size_t count = 1;
        for (const std::size_t length : dataset.shape) {
            count *= length;
        }
        const bool is_long = count > longest_result;
        list.push_back({{"path", io::printable(dataset.path)},
                        {"unit", io::printable(dataset.unit)},
                        {"description", io::printable(dataset.description)},
                        {"shape", dataset.shape},
                        {"value", is_long           ? Json(nullptr)
                                  : text != nullptr ? Json(io::printable(*text))
                                                    : to_json(dataset)}});
    }
    return list;
}

Json history_json(const std::vector<io::Provenance>& history) {
    Json list = Json::array();
    for (const io::Provenance& entry : history) {
        list.push_back({{"stage", io::printable(entry.stage)},
                        {"command", io::printable(entry.command_line)},
                        {"seed", entry.seed},
                        {"version", io::printable(entry.version)},
                        {"time", io::printable(entry.time)},
                        {"seconds", std::isfinite(entry.seconds) ? Json(entry.seconds) : Json(nullptr)},
                        {"positions", io::printable(entry.positions_sha256)}});
    }
    return list;
}

/// What the page tells of a structure of which it shows a part; nothing where it shows all.
Json whole_json(const Packing& whole, const Packing& shown, double unit) {
    if (whole.size() == shown.size()) {
        return nullptr;
    }
    return {
        {"particles", whole.size()}, {"periodic", whole.cell.is_periodic()}, {"lengths", listed(whole.cell.edge_lengths() / unit)}};
}

/// Lengths in units of the mean radius, so that single precision does and every structure is drawn at one scale.
Json structure_json(const PageStructure& all, Index most, PageArrays& arrays) {
    const PageStructure page = thinned(all, most);
    const Packing& packing = page.structure.packing;
    const Packing& whole = all.structure.packing;
    const double unit = mean_radius(whole);
    // A tilted box, or one with open edges, is drawn in the rectangular box around it, without images.
    const Cell& cell = packing.cell;
    const Cell drawn = cell.is_rectangular() && cell.is_periodic() ? cell : cell.bounds();
    Json json = {{"name", io::printable(page.name)},
                 {"particles", packing.size()},
                 {"whole", whole_json(whole, packing, unit)},
                 {"periodic", drawn.is_periodic()},
                 {"volumeFraction", volume_fraction(whole)},
                 {"lengthUnit", unit},
                 {"lengths", listed(drawn.lengths() / unit)},
                 {"positions", arrays.reals(listed((packing.positions.colwise() - drawn.origin()) / unit))},
                 {"radii", arrays.reals(listed(packing.radii / unit))},
                 {"bondsInFile", page.bonds_in_file},
                 {"bonds", nullptr}};
    if (page.structure.bonds) {
        const ContactNetwork& bonds = *page.structure.bonds;
        json["bonds"] = {{"ends", arrays.integers({bonds.ends.data(), bonds.ends.data() + bonds.ends.size()})},
                         {"branches", arrays.reals(listed(bonds.branch / unit))}};
    }
    json["fields"] = Json::array();
    for (const io::Dataset& dataset : page.fields) {
        if (Json field = field_json(dataset, packing, arrays); !field.empty()) {
            json["fields"].push_back(std::move(field));
        }
    }
    json["bondFields"] = bond_fields_json(page, arrays);
    json["pores"] = {{"centres", arrays.reals(listed((page.pores.centres.colwise() - packing.cell.origin()) / unit))},
                     {"radii", arrays.reals(listed(page.pores.radii / unit))}};
    json["results"] = results_json(all.results);
    json["history"] = history_json(page.history);
    return json;
}

/// The JSON of the page and its arrays, with as many particles as fit.
std::pair<Json, std::string> page_content(const std::vector<PageStructure>& structures, const std::string& version) {
    for (Index most = most_particles;;) {
        PageArrays arrays;
        Json data = {{"version", version}, {"structures", Json::array()}};
        for (const PageStructure& page : structures) {
            data["structures"].push_back(structure_json(page, most, arrays));
        }
        std::string packed = arrays.base64();
        if (packed.size() <= most_bytes || most == 1) {
            return {std::move(data), std::move(packed)};
        }
        const double share = 0.9 * static_cast<double>(most_bytes) / static_cast<double>(packed.size());
        most = std::max(Index{1}, static_cast<Index>(share * static_cast<double>(most)));
    }
}

}  // namespace

std::string structure_page(const std::vector<PageStructure>& structures, const std::string& version) {
    if (structure_script.empty()) {
        throw std::runtime_error("this program was built without its pages; run scripts/bundle-web and build it again");
    }
    std::string title;
    for (const PageStructure& page : structures) {
        title += (title.empty() ? "" : ", ") + io::printable(page.name);
    }
    const auto [data, arrays] = page_content(structures, version);
    return html_page(title + " – coagula", "<div id=\"page\"><p class=\"soft\">Loading " + escaped(title) + " …</p></div>\n" +
                                               page_data(data, arrays) + page_script(structure_script));
}

}  // namespace coagula::report
