// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include <coagula/io/printable.hpp>

#include <algorithm>
#include <iostream>
#include <stdexcept>

namespace coagula::tools {

namespace {

/// Objects are indented, arrays stay on one line.
void print(std::ostream& stream, const Json& json, const std::string& indent) {
    if (!json.is_object() || json.empty()) {
        stream << json.dump();
        return;
    }
    const char* separator = "{\n";
    for (const auto& [key, value] : json.items()) {
        stream << separator << indent << "  " << Json(key).dump() << ": ";
        print(stream, value, indent + "  ");
        separator = ",\n";
    }
    stream << '\n' << indent << '}';
}

/// Letters of a text in UTF-8.
std::size_t letters_in(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

}  // namespace

void flush_output() {
    std::cout.flush();
    if (!std::cout) {
        throw std::runtime_error("standard output cannot be written");
    }
}

Json box_lengths(const Cell& cell) {
    const Eigen::Vector3d lengths = cell.edge_lengths();
    return {lengths.x(), lengths.y(), lengths.z()};
}

Json box_edges(const Cell& cell) {
    Json rows = Json::array();
    for (const auto& edge : cell.edges().colwise()) {
        rows.push_back({edge.x(), edge.y(), edge.z()});
    }
    return rows;
}

void report(const Arguments& arguments, const Json& json, const Table& table) {
    if (arguments.flag("json")) {
        print(std::cout, json, "");
        std::cout << '\n';
    } else if (!arguments.flag("quiet")) {
        std::size_t width = 0;
        for (const auto& [label, text] : table) {
            width = std::max(width, letters_in(label));
        }
        for (const auto& [label, text] : table) {
            std::cout << label << std::string(width + 3 - letters_in(label), ' ') << io::printable(text) << '\n';
        }
    }
    flush_output();
}

}  // namespace coagula::tools
