#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "text_reader.hpp"

namespace coagula::io {

namespace {

/// Columns of the section Atoms for one atom style (LAMMPS manual, read_data).
struct Layout {
    std::size_t position;
    std::optional<std::size_t> diameter;
    std::size_t width;  ///< without image flags
};

Layout layout_of(const LineReader& file, const std::string& style) {
    static const std::map<std::string, Layout> layouts{
        {"atomic", {2, std::nullopt, 5}}, {"bond", {3, std::nullopt, 6}},    {"sphere", {4, 2, 7}},
        {"hybrid sphere", {2, 5, 7}},     {"hybrid sphere bond", {2, 5, 8}}, {"hybrid bond sphere", {2, 6, 8}},
    };
    const auto found = layouts.find(style);
    if (found == layouts.end()) {
        file.fail("the atom style '" + style + "' is not one of sphere, atomic, bond, hybrid sphere, hybrid sphere bond");
    }
    return found->second;
}

std::string style_by_width(const LineReader& file, std::size_t width) {
    for (const auto& [style, columns] : {std::pair{"atomic", 5U}, {"bond", 6U}, {"sphere", 7U}}) {
        if (width == columns || width == columns + 3) {
            return style;
        }
    }
    file.fail("the section Atoms names no atom style (\"Atoms # sphere\")");
}

/// The text behind "key = " in the first line, up to a comma.
std::string value_in_title(const std::string& title, const std::string& key) {
    const std::size_t begin = title.find(key + " = ");
    if (begin == std::string::npos) {
        return "";
    }
    const std::size_t value = begin + key.size() + 3;
    return std::string(trim(std::string_view(title).substr(value, title.find(',', value) - value)));
}

struct Header {
    std::string title;
    std::optional<std::size_t> atoms;
    Eigen::Vector3d lower = Eigen::Vector3d::Constant(unset);
    Eigen::Vector3d upper = Eigen::Vector3d::Constant(unset);
};

std::string_view without_comment(std::string_view line) {
    return trim(line.substr(0, line.find('#')));
}

void read_header_line(const LineReader& file, Header& header) {
    const auto words = split_words(without_comment(file.line()));
    if (words.size() == 2 && words[1] == "atoms") {
        header.atoms = file.count_in(words[0], "the number of atoms");
    }
    for (int axis = 0; axis < 3 && words.size() == 4; ++axis) {
        if (words[2] == std::string(1, "xyz"[axis]) + "lo") {
            header.lower[axis] = file.number_in(words[0], words[2]);
            header.upper[axis] = file.number_in(words[1], words[3]);
        }
    }
    if (words.size() == 6 && words[3] == "xy") {
        for (std::size_t i = 0; i < 3; ++i) {
            if (file.number_in(words[i], "the tilt") != 0) {
                file.fail("this is a sheared box, which coagula does not read");
            }
        }
    }
}

/// Up to the line "Atoms"; sections before it are passed over.
Header read_header(LineReader& file) {
    Header header;
    if (file.next()) {
        header.title = file.line();
    }
    while (file.next()) {
        if (without_comment(file.line()) == "Atoms") {
            return header;
        }
        read_header_line(file, header);
    }
    file.fail("the file has no section Atoms");
}

std::optional<Cell> cell_of(const LineReader& file, const Header& header, double divisor) {
    const Eigen::Vector3d lengths = (header.upper - header.lower) / divisor;
    if (!lengths.allFinite()) {
        return std::nullopt;
    }
    if ((lengths.array() <= 0).any()) {
        throw InputError(file.path() + ": the box has an edge that is not positive");
    }
    return Cell::open(header.lower / divisor, lengths);
}

void read_atoms(LineReader& file, const Header& header, std::string style, double divisor, RawPacking& raw) {
    std::vector<std::size_t> numbers;
    std::optional<Layout> layout;
    while (numbers.size() < header.atoms.value_or(0)) {
        if (!file.next_filled()) {
            file.fail("the file ends after " + std::to_string(numbers.size()) + " of " + std::to_string(*header.atoms) + " atoms");
        }
        const auto words = split_words(without_comment(file.line()));
        if (!layout) {
            style = style.empty() ? style_by_width(file, words.size()) : style;
            layout = layout_of(file, style);
        }
        if (words.size() != layout->width && words.size() != layout->width + 3) {
            file.fail("there are " + std::to_string(words.size()) + " columns, but atom style " + style + " has " +
                      std::to_string(layout->width) + " (and three image flags)");
        }
        numbers.push_back(file.count_in(words[0], "the number of the atom"));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            raw.coordinates.push_back(file.number_in(words[layout->position + axis], "a coordinate") / divisor);
        }
        if (layout->diameter) {
            raw.radii.push_back(0.5 * file.number_in(words[*layout->diameter], "the diameter") / divisor);
        }
        raw.lines.push_back(file.number());
    }
    sort_by_number(file.path(), numbers, raw);
}

}  // namespace

std::string length_unit_of(const std::string& lammps_units) {
    static const std::map<std::string, std::string> lengths{{"si", "m"},           {"cgs", "cm"},   {"real", "angstrom"},
                                                            {"metal", "angstrom"}, {"micro", "um"}, {"nano", "nm"}};
    const auto found = lengths.find(lammps_units);
    return found == lengths.end() ? "" : found->second;
}

std::vector<RawPacking> read_lammps_data(LineReader& file, const ImportOptions& options) {
    const Header header = read_header(file);
    if (!header.atoms) {
        throw InputError(file.path() + ": the header names no number of atoms");
    }
    const std::string_view line = file.line();
    const std::size_t hash = line.find('#');
    std::string style = hash == std::string_view::npos ? "" : std::string(trim(line.substr(hash + 1)));
    if (style == "hybrid") {
        style = value_in_title(header.title, "atom_style");
    }
    const double divisor = per_metre(file, "the file", length_unit_of(value_in_title(header.title, "units")), options);
    RawPacking raw;
    raw.cell = cell_of(file, header, divisor);
    read_atoms(file, header, style, divisor, raw);
    const bool periodic = value_in_title(header.title, "boundary") != "f f f";
    if (raw.cell && periodic && !options.open) {
        for (std::size_t i = 0; i < raw.coordinates.size(); ++i) {
            raw.coordinates[i] -= raw.cell->origin()[static_cast<Index>(i % 3)];
        }
        raw.cell = Cell::periodic(raw.cell->lengths());
    }
    return {std::move(raw)};
}

}  // namespace coagula::io
