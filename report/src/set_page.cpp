// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/set_page.hpp>

#include <coagula/io/printable.hpp>
#include <coagula/report/results.hpp>

#include "bundle.hpp"
#include "html.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <variant>

namespace coagula::report {

namespace {

/// Lines stay lines.
std::string printable_lines(const std::string& text) {
    std::istringstream lines(text);
    std::string all;
    for (std::string line; std::getline(lines, line);) {
        all += io::printable(line) + "\n";
    }
    return all;
}

Json cell_of(const std::string& text) {
    return io::printable(text);
}

Json cell_of(std::int64_t number) {
    return number;
}

Json cell_of(double number) {
    return std::isfinite(number) ? Json(number) : Json(nullptr);
}

Json column_json(const io::SetColumn& column) {
    Json values = Json::array();
    std::visit(
        [&](const auto& all) {
            for (const auto& value : all) {
                values.push_back(cell_of(value));
            }
        },
        column.values);
    return {{"name", io::printable(column.name)},
            {"unit", io::printable(column.unit)},
            {"description", io::printable(column.description)},
            {"values", std::move(values)}};
}

Json set_json(const PageSet& set, const std::string& version) {
    Json json = {{"version", version},    {"name", io::printable(set.name)},          {"holds", set.holds_structures},
                 {"card", Json::array()}, {"sweep", printable_lines(set.head.sweep)}, {"columns", Json::array()}};
    for (const auto& [name, text] : set.head.card) {
        json["card"].push_back({{"name", io::printable(name)}, {"text", io::printable(text)}});
    }
    for (const io::SetColumn& column : set.head.index) {
        json["columns"].push_back(column_json(column));
    }
    return json;
}

}  // namespace

std::string set_page(const PageSet& set, const std::string& version) {
    if (set_script.empty()) {
        throw std::runtime_error("this program was built without its pages; run scripts/bundle-web and build it again");
    }
    const std::string title = escaped(io::printable(set.name));
    return html_page(io::printable(set.name) + " – coagula", "<div id=\"page\"><p class=\"soft\">Loading " + title +
                                                                 " …</p></div>\n" + page_data(set_json(set, version), "") +
                                                                 page_script(set_script));
}

}  // namespace coagula::report
