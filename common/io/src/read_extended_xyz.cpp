// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>

#include "triclinic.hpp"

namespace coagula::io {

namespace {

/// A value of the comment line from `begin` on: in quotes of either kind, in brackets, or up to a blank. `begin` moves behind it.
std::string take_value(const LineReader& file, std::string_view line, std::size_t& begin) {
    const char first = begin < line.size() ? line[begin] : ' ';
    std::string value;
    if (first == '"' || first == '\'') {
        for (++begin; begin < line.size() && line[begin] != first; ++begin) {
            begin += line[begin] == '\\' && begin + 1 < line.size() ? 1 : 0;  // what follows is meant as it stands
            value += line[begin];
        }
        if (begin++ >= line.size()) {
            file.fail(std::string("the comment line has a quotation mark ") + first + " that does not end");
        }
        return value;
    }
    int depth = 0;
    for (; begin < line.size() && (depth > 0 || (line[begin] != ' ' && line[begin] != '\t')); ++begin) {
        depth += line[begin] == '[' || line[begin] == '{' ? 1 : 0;
        depth -= line[begin] == ']' || line[begin] == '}' ? 1 : 0;
        value += line[begin];
    }
    if (depth > 0) {
        file.fail("the comment line has a bracket that does not end");
    }
    return value;
}

/// The pairs of the comment line, key=value with blanks around the sign or without; keys in lower case.
std::map<std::string, std::string> parse_comment(const LineReader& file) {
    const std::string_view line = file.line();
    const auto behind_blanks = [&](std::size_t place) { return std::min(line.find_first_not_of(" \t", place), line.size()); };
    std::map<std::string, std::string> pairs;
    std::size_t place = behind_blanks(0);
    while (place < line.size()) {
        const std::size_t end = std::min(line.find_first_of("= \t", place), line.size());
        const std::size_t sign = behind_blanks(end);
        if (sign == line.size() || line[sign] != '=') {
            place = sign;  // a word without a value
            continue;
        }
        const std::string key = lower_case(line.substr(place, end - place));
        place = behind_blanks(sign + 1);
        pairs[key] = take_value(file, line, place);
        place = behind_blanks(place);
    }
    return pairs;
}

/// The entries of an array: "T T T", "[T, T, T]", "{1 0 0}", "[[8, 0, 0], [0, 9, 0], [0, 0, 10]]".
std::vector<std::string_view> entries_of(std::string& array) {
    std::replace_if(
        array.begin(), array.end(), [](char c) { return std::string_view("[]{},").find(c) != std::string_view::npos; }, ' ');
    return split_words(array);
}

std::string value_of(const std::map<std::string, std::string>& pairs, const std::string& key) {
    const auto found = pairs.find(key);
    return found == pairs.end() ? "" : found->second;
}

/// Which words of a particle's line are the position and the radius.
struct Layout {
    std::optional<std::size_t> position;
    std::optional<std::size_t> radius;
    bool is_diameter = false;
    std::size_t width = 0;
};

constexpr std::size_t most_columns = 1000;  ///< of a property

/// Properties=species:S:1:pos:R:3:radius:R:1; plain XYZ is species and position.
Layout parse_properties(const LineReader& file, const std::string& properties) {
    if (properties.empty()) {
        return {1, std::nullopt, false, 4};
    }
    std::vector<std::string> parts(1);
    for (const char c : properties) {
        if (c == ':') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    if (parts.size() % 3 != 0) {
        file.fail("Properties must be triples name:type:columns");
    }
    Layout layout;
    for (std::size_t i = 0; i < parts.size(); i += 3) {
        const std::string name = lower_case(parts[i]);
        const std::size_t columns = file.count_in(parts[i + 2], "the number of columns of " + parts[i]);
        if (columns > most_columns) {
            file.fail("the number of columns of " + parts[i] + " is " + parts[i + 2] + ", but must be at most " +
                      std::to_string(most_columns));
        }
        if (name == "pos" && columns == 3) {
            layout.position = layout.width;
        } else if ((name == "radius" || name == "radii") && columns == 1) {
            layout.radius = layout.width;
            layout.is_diameter = false;
        } else if (name == "diameter" && columns == 1 && !layout.radius) {
            layout.radius = layout.width;
            layout.is_diameter = true;
        }
        layout.width += columns;
    }
    if (!layout.position) {
        file.fail("Properties name no pos:R:3");
    }
    return layout;
}

std::optional<bool> truth_of(std::string_view flag) {
    const std::string word = lower_case(flag);
    const bool is_true = word == "t" || word == "true" || word == "1";
    const bool is_false = word == "f" || word == "false" || word == "0";
    return is_true || is_false ? std::optional(is_true) : std::nullopt;
}

/// One flag for all axes or one for each.
std::array<bool, 3> parse_periodicity(const LineReader& file, std::string text) {
    const auto flags = entries_of(text);
    std::array<bool, 3> periodic = {true, true, true};
    for (std::size_t axis = 0; axis < 3 && !flags.empty(); ++axis) {
        const std::optional<bool> truth = truth_of(flags[flags.size() == 1 ? 0 : std::min(axis, flags.size() - 1)]);
        if ((flags.size() != 3 && flags.size() != 1) || !truth) {
            file.fail("pbc must be one flag for each edge of the box, such as \"T T F\"");
        }
        periodic[axis] = *truth;
    }
    return periodic;
}

/// The edges of the box, whose entries Lattice has one after the other.
Eigen::Matrix3d parse_edges(const LineReader& file, const std::vector<std::string_view>& entries, double divisor) {
    if (entries.size() != 9) {
        file.fail("Lattice must have nine numbers");
    }
    Eigen::Matrix3d edges;
    for (int i = 0; i < 9; ++i) {
        edges(i % 3, i / 3) = file.number_in(entries[static_cast<std::size_t>(i)], "an entry of Lattice") / divisor;
    }
    return edges;
}

/// The lower corner of the box.
Eigen::Vector3d parse_origin(const LineReader& file, std::string text, double divisor) {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const auto coordinates = entries_of(text);
    if (!coordinates.empty() && coordinates.size() != 3) {
        file.fail("Origin must have three numbers");
    }
    for (std::size_t axis = 0; axis < coordinates.size(); ++axis) {
        origin[static_cast<Index>(axis)] = file.number_in(coordinates[axis], "Origin") / divisor;
    }
    return origin;
}

/// The box as it stands in the file, periodic or not.
std::optional<Cell> parse_box(const LineReader& file, const std::map<std::string, std::string>& pairs, double divisor) {
    std::string lattice = value_of(pairs, "lattice");
    const auto entries = entries_of(lattice);
    if (entries.empty()) {
        return {};
    }
    return box_of_edges(file, parse_origin(file, value_of(pairs, "origin"), divisor), parse_edges(file, entries, divisor),
                        parse_periodicity(file, value_of(pairs, "pbc")));
}

void read_particle(const LineReader& file, const Layout& layout, double divisor, RawPacking& raw) {
    const auto words = split_words(file.line());
    if (words.size() < layout.width) {
        file.fail("there are " + std::to_string(words.size()) + " columns, but " + std::to_string(layout.width) + " are expected");
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        raw.coordinates.push_back(file.number_in(words[*layout.position + axis], "a coordinate") / divisor);
    }
    if (layout.radius) {
        raw.radii.push_back((layout.is_diameter ? 0.5 : 1.0) * file.number_in(words[*layout.radius], "the radius") / divisor);
    }
    raw.lines.push_back(file.number());
}

RawPacking read_frame(LineReader& file, const ImportOptions& options) {
    const std::size_t particles = file.count_in(trim(file.line()), "the number of particles");
    if (!file.next()) {
        file.fail("the comment line is missing");
    }
    const auto pairs = parse_comment(file);
    const double divisor = per_metre(file, "the comment line", value_of(pairs, "length_unit"), options);
    const Layout layout = parse_properties(file, value_of(pairs, "properties"));
    RawPacking raw;
    raw.cell = parse_box(file, pairs, divisor);
    if (const std::string time = value_of(pairs, "time"); !time.empty()) {
        raw.time = file.number_in(time, "Time");
    }
    for (std::size_t particle = 0; particle < particles; ++particle) {
        if (!file.next()) {
            file.fail("the file ends after " + std::to_string(particle) + " of " + std::to_string(particles) + " particles");
        }
        read_particle(file, layout, divisor, raw);
    }
    return raw;
}

}  // namespace

std::vector<RawPacking> read_extended_xyz(LineReader& file, const ImportOptions& options) {
    FrameCollector collector(options);
    for (std::int64_t frame = 0; file.next_filled(); ++frame) {
        collector.add(read_frame(file, options), frame);
    }
    return collector.take(file.path());
}

}  // namespace coagula::io
