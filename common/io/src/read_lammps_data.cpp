// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "atom_styles.hpp"
#include "triclinic.hpp"

namespace coagula::io {

namespace {

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
    Eigen::Vector3d tilt = Eigen::Vector3d::Zero();            // xy, xz, yz
    Eigen::Matrix3d edges = Eigen::Matrix3d::Constant(unset);  // of a general triclinic box
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();          // of it
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
    const auto three_numbers = [&](const std::string& object) {
        return Eigen::Vector3d(file.number_in(words[0], object), file.number_in(words[1], object),
                               file.number_in(words[2], object));
    };
    for (int edge = 0; edge < 3 && words.size() == 4; ++edge) {
        if (words[3] == std::string(1, "abc"[edge]) + "vec") {
            header.edges.col(edge) = three_numbers("an edge of the box");
        }
    }
    if (words.size() == 5 && words[3] == "abc" && words[4] == "origin") {
        header.origin = three_numbers("the origin of the box");
    }
    if (words.size() == 6 && words[3] == "xy" && words[4] == "xz" && words[5] == "yz") {
        header.tilt = three_numbers("the tilt");
    }
}

/// Reads up to the line "Atoms". Sections before it are passed over.
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

/// The title of files that coagula writes says where the box is periodic; LAMMPS itself does not.
std::array<bool, 3> periodicity_of(const Header& header) {
    const std::string boundary = value_in_title(header.title, "boundary");
    const auto flags = split_words(boundary);
    std::array<bool, 3> periodic = {true, true, true};
    for (std::size_t axis = 0; axis < 3 && flags.size() == 3; ++axis) {
        periodic[axis] = flags[axis] == "p";
    }
    return periodic;
}

std::optional<Cell> cell_of(const LineReader& file, const Header& header, double divisor) {
    const std::array<bool, 3> periodic = periodicity_of(header);
    if (header.edges.allFinite()) {
        return box_of_edges(file, header.origin / divisor, header.edges / divisor, periodic);
    }
    const Eigen::Vector3d lengths = header.upper - header.lower;
    if (!lengths.allFinite()) {
        return std::nullopt;
    }
    return box_of_edges(file, header.lower / divisor, triclinic_edges(lengths, header.tilt) / divisor, periodic);
}

/// The words of the next atom, of `atoms` in all.
std::vector<std::string_view> next_atom(LineReader& file, std::size_t atom, std::size_t atoms) {
    if (!file.next_filled()) {
        file.fail("the file ends after " + std::to_string(atom) + " of " + std::to_string(atoms) + " atoms");
    }
    return split_words(without_comment(file.line()));
}

/// The style that the user or the file names; for neither an empty text.
std::string named_style(const LineReader& file, const Header& header, const std::string& chosen) {
    const std::string_view line = file.line();
    const std::size_t hash = line.find('#');
    std::string found(hash == std::string_view::npos ? "" : trim(line.substr(hash + 1)));
    if (found == "hybrid") {
        const std::string in_title = value_in_title(header.title, "atom_style");
        found = in_title.empty() ? found : in_title;
    }
    const auto in_file = find_atom_style(found);
    const auto in_call = find_atom_style(chosen);
    const bool differ =
        in_file ? in_call && in_call->columns() != in_file->columns() : found == "hybrid" && !chosen.starts_with(found);
    if (!chosen.empty() && differ) {
        file.fail("the section Atoms has the style '" + found + "', but --atom-style says '" + chosen + "'");
    }
    return chosen.empty() ? found : chosen;
}

AtomStyle style_of_name(const LineReader& file, const std::string& name) {
    if (name == "hybrid") {
        file.fail("the style hybrid needs the names of its sub-styles: give them as in --atom-style 'hybrid sphere bond'");
    }
    const std::optional<AtomStyle> style = find_atom_style(name);
    if (!style) {
        file.fail("the atom style '" + name + "' is none that coagula knows; if it is not that of the file, give --atom-style");
    }
    return *style;
}

std::string names_of(const std::vector<AtomStyle>& styles) {
    std::vector<std::string> names;
    for (const AtomStyle& style : styles) {
        names.push_back(style.name());
    }
    return list_of(names);
}

/// The usual style whose columns hold in all lines; the reader is where it was then. All that hold must give the same spheres.
AtomStyle style_of_columns(LineReader& file, std::size_t atoms) {
    const LineReader::Place begin = file.place();
    std::vector<AtomStyle> styles = usual_atom_styles();
    const std::string usual = names_of(styles);
    for (std::size_t atom = 0; atom < atoms; ++atom) {
        const auto words = next_atom(file, atom, atoms);
        std::erase_if(styles, [&](const AtomStyle& style) { return !style.has_width(words.size()) || style.contradicted(words); });
        if (styles.empty()) {
            file.fail("the section Atoms names no atom style, and its columns are those of none of " + usual +
                      ": give --atom-style");
        }
    }
    file.return_to(begin);
    if (atoms > 0 &&
        !std::all_of(styles.begin(), styles.end(), [&](const AtomStyle& style) { return style.reads_like(styles[0]); })) {
        file.fail("the section Atoms names no atom style, and its columns can be those of " + names_of(styles) +
                  ": give --atom-style");
    }
    return styles[0];
}

void require_columns(const LineReader& file, const AtomStyle& style, const std::vector<std::string_view>& words) {
    if (!style.has_width(words.size())) {
        file.fail("there are " + std::to_string(words.size()) + " columns, but atom style " + style.name() + " has " +
                  std::to_string(style.columns().size()) + " (and three image flags)");
    }
    if (const auto column = style.contradicted(words)) {
        const bool is_flag = *column >= style.columns().size();
        file.fail("'" + std::string(words[*column]) + "' cannot be " + (is_flag ? "an image flag" : style.columns()[*column]) +
                  " of an atom of style " + style.name());
    }
}

void read_atoms(LineReader& file, std::size_t atoms, const AtomStyle& style, double divisor, RawPacking& raw) {
    std::vector<std::size_t> numbers;
    for (std::size_t atom = 0; atom < atoms; ++atom) {
        const auto words = next_atom(file, atom, atoms);
        require_columns(file, style, words);
        numbers.push_back(file.count_in(words[0], "the number of the atom"));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            raw.coordinates.push_back(file.number_in(words[style.position() + axis], "a coordinate") / divisor);
        }
        if (style.diameter()) {
            raw.radii.push_back(0.5 * file.number_in(words[*style.diameter()], "the diameter") / divisor);
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
    const std::string name = named_style(file, header, options.atom_style);
    const double divisor = per_metre(file, "the file", length_unit_of(value_in_title(header.title, "units")), options);
    const AtomStyle style = name.empty() ? style_of_columns(file, *header.atoms) : style_of_name(file, name);
    if (!style.shape().empty()) {
        file.fail("atoms of the style '" + style.name() + "' are " + style.shape() + ", but coagula reads spheres");
    }
    RawPacking raw;
    raw.cell = cell_of(file, header, divisor);
    read_atoms(file, *header.atoms, style, divisor, raw);
    return {std::move(raw)};
}

}  // namespace coagula::io
