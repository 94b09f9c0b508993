#include <algorithm>
#include <map>
#include <utility>

#include "atom_styles.hpp"
#include "text_reader.hpp"

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
    if (words.size() == 4 && (words[3] == "avec" || words[3] == "bvec" || words[3] == "cvec")) {
        file.fail("the box is a general triclinic one, which coagula does not read");
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
