// SPDX-License-Identifier: GPL-3.0-or-later
// The text dump of LAMMPS (LAMMPS manual, "dump" and "dump_modify"), with one frame or many.
#include <algorithm>
#include <array>
#include <tuple>

#include "triclinic.hpp"

namespace coagula::io {

namespace {

/// What stands above the atoms of a frame.
struct FrameHeader {
    std::optional<std::size_t> atoms;
    double time = unset;
    std::optional<Cell> box;  // in the units of the file
};

/// Places of the quantities among the words of an atom's line.
struct Columns {
    std::array<std::size_t, 3> position{};
    std::optional<std::size_t> number;
    std::optional<std::size_t> radius;
    bool is_diameter = false;
    bool scaled = false;
    std::size_t width = 0;
};

void next_line(LineReader& file, const char* what) {
    if (!file.next()) {
        file.fail(std::string("the file ends where ") + what + " should stand");
    }
}

/// One flag for each axis, such as "pp ff fs"; without any the box is periodic.
std::array<bool, 3> parse_periodicity(const LineReader& file, const std::vector<std::string_view>& flags) {
    if (flags.empty()) {
        return {true, true, true};
    }
    if (flags.size() != 3) {
        file.fail("the box needs one boundary for each axis, such as 'pp pp ff'");
    }
    return {flags[0] == "pp", flags[1] == "pp", flags[2] == "pp"};
}

std::vector<double> numbers_of_line(LineReader& file, std::size_t count) {
    next_line(file, "the bounds of the box");
    const auto words = split_words(file.line());
    if (words.size() != count) {
        file.fail("the bounds of the box must be " + std::to_string(count) + " numbers");
    }
    std::vector<double> numbers;
    for (const std::string_view word : words) {
        numbers.push_back(file.number_in(word, "a bound of the box"));
    }
    return numbers;
}

/// Three lines: an edge vector and a coordinate of the origin in each.
Cell general_box(LineReader& file, const std::array<bool, 3>& periodic) {
    Eigen::Vector3d origin;
    Eigen::Matrix3d edges;
    for (int edge = 0; edge < 3; ++edge) {
        const std::vector<double> numbers = numbers_of_line(file, 4);
        edges.col(edge) = Eigen::Vector3d::Map(numbers.data());
        origin[edge] = numbers[3];
    }
    return box_of_edges(file, origin, edges, periodic);
}

/// Three lines: lower and upper bound along an axis, and the tilt xy, xz or yz of a tilted box, whose bounds are those of the
/// rectangular box around it.
Cell restricted_box(LineReader& file, bool tilted, const std::array<bool, 3>& periodic) {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    Eigen::Vector3d tilt = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double> numbers = numbers_of_line(file, tilted ? 3 : 2);
        lower[axis] = numbers[0];
        upper[axis] = numbers[1];
        tilt[axis] = tilted ? numbers[2] : 0.0;
    }
    const auto [xy, xz, yz] = std::tuple(tilt[0], tilt[1], tilt[2]);
    lower -= Eigen::Vector3d(std::min({0.0, xy, xz, xy + xz}), std::min(0.0, yz), 0.0);
    upper -= Eigen::Vector3d(std::max({0.0, xy, xz, xy + xz}), std::max(0.0, yz), 0.0);
    return box_of_edges(file, lower, triclinic_edges(upper - lower, tilt), periodic);
}

void read_bounds(LineReader& file, std::vector<std::string_view> flags, FrameHeader& header) {
    const bool general = flags.size() >= 2 && flags[0] == "abc" && flags[1] == "origin";
    const bool tilted = flags.size() >= 3 && flags[0] == "xy" && flags[1] == "xz" && flags[2] == "yz";
    flags.erase(flags.begin(), flags.begin() + (general ? 2 : (tilted ? 3 : 0)));
    const std::array<bool, 3> periodic = parse_periodicity(file, flags);
    header.box = general ? general_box(file, periodic) : restricted_box(file, tilted, periodic);
}

Columns parse_columns(const LineReader& file, const std::vector<std::string_view>& names) {
    const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
        const auto found = std::find(names.begin(), names.end(), name);
        return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
    };
    Columns columns;
    columns.width = names.size();
    columns.number = find("id");
    columns.radius = find("radius");
    if (!columns.radius) {
        columns.radius = find("diameter");
        columns.is_diameter = columns.radius.has_value();
    }
    for (const char* ending : {"", "u", "s", "su"}) {
        const auto x = find(std::string("x") + ending);
        const auto y = find(std::string("y") + ending);
        const auto z = find(std::string("z") + ending);
        if (x && y && z) {
            columns.position = {*x, *y, *z};
            columns.scaled = ending[0] == 's';
            return columns;
        }
    }
    file.fail("the atoms have no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu");
}

RawPacking read_atoms(LineReader& file, const FrameHeader& header, const Columns& columns, double divisor) {
    RawPacking raw;
    raw.time = header.time;
    if (header.box) {
        raw.cell = box_of_edges(file, header.box->origin() / divisor, header.box->edges() / divisor, header.box->periodicity());
    } else if (columns.scaled) {
        file.fail("the positions are scaled by a box that the frame does not have");
    }
    std::vector<std::size_t> numbers;
    for (std::size_t atom = 0; atom < header.atoms.value_or(0); ++atom) {
        if (!file.next()) {
            file.fail("the file ends after " + std::to_string(atom) + " of " + std::to_string(*header.atoms) + " atoms");
        }
        const auto words = split_words(file.line());
        if (words.size() != columns.width) {
            file.fail("there are " + std::to_string(words.size()) + " columns, but " + std::to_string(columns.width) +
                      " are expected");
        }
        Eigen::Vector3d position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[static_cast<Index>(axis)] = file.number_in(words[columns.position[axis]], "a coordinate");
        }
        position = columns.scaled ? raw.cell->place(position) : (position / divisor).eval();
        raw.coordinates.insert(raw.coordinates.end(), position.begin(), position.end());
        if (columns.radius) {
            raw.radii.push_back((columns.is_diameter ? 0.5 : 1.0) * file.number_in(words[*columns.radius], "the radius") / divisor);
        }
        numbers.push_back(columns.number ? file.count_in(words[*columns.number], "the number of the atom") : atom);
        raw.lines.push_back(file.number());
    }
    sort_by_number(file.path(), numbers, raw);
    return raw;
}

}  // namespace

std::vector<RawPacking> read_lammps_dump(LineReader& file, const ImportOptions& options) {
    FrameCollector collector(options);
    std::string units;  // LAMMPS names them in the first frame only
    FrameHeader header;
    std::int64_t frame = 0;
    while (file.next_filled()) {
        const std::string line(file.line());
        if (!line.starts_with("ITEM: ")) {
            file.fail("'ITEM: ...' is expected; this is not a text dump of LAMMPS");
        }
        const std::string_view item = std::string_view(line).substr(6);
        if (item == "UNITS") {
            next_line(file, "the units");
            units = trim(file.line());
        } else if (item == "TIME") {
            next_line(file, "the time");
            const double time = file.number_in(file.line(), "the time");
            header.time = units == "si" || units == "cgs" ? time : unset;  // seconds in these
        } else if (item == "TIMESTEP") {
            next_line(file, "the time step");
        } else if (item == "NUMBER OF ATOMS") {
            next_line(file, "the number of atoms");
            header.atoms = file.count_in(trim(file.line()), "the number of atoms");
        } else if (item.starts_with("BOX BOUNDS")) {
            read_bounds(file, split_words(item.substr(10)), header);
        } else if (item.starts_with("ATOMS")) {
            if (!header.atoms) {
                file.fail("the frame names no number of atoms");
            }
            const double divisor = per_metre(file, "the file", length_unit_of(units), options);
            collector.add(read_atoms(file, header, parse_columns(file, split_words(item.substr(5))), divisor), frame++);
            header = {};
        } else {
            file.fail("'" + line + "' is not part of a dump of atoms");
        }
    }
    return collector.take(file.path());
}

}  // namespace coagula::io
