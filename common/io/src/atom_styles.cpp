// SPDX-License-Identifier: GPL-3.0-or-later
#include "atom_styles.hpp"

#include <algorithm>
#include <array>

#include "text_reader.hpp"

namespace coagula::io {

namespace {

struct TableRow {
    std::string_view name;
    std::string_view columns;
    std::string_view shape = {};
    bool usual = false;
};

/// "mol" is the number of a molecule, "flag" says that more about the particle stands in another section.
constexpr std::array table = {
    TableRow{"amoeba", "id mol type q x y z"},
    TableRow{"angle", "id mol type x y z", "", true},
    TableRow{"atomic", "id type x y z", "", true},
    TableRow{"body", "id type flag density x y z", "bodies", true},
    TableRow{"bond", "id mol type x y z", "", true},
    TableRow{"bpm/sphere", "id mol type diameter density x y z", "", true},
    TableRow{"charge", "id type q x y z", "", true},
    TableRow{"dielectric", "id type q x y z", "patches of a surface"},
    TableRow{"dipole", "id type q x y z mux muy muz", "", true},
    TableRow{"dpd", "id type theta x y z"},
    TableRow{"edpd", "id type temperature capacity x y z"},
    TableRow{"electron", "id type q spin eradius x y z", "electrons"},
    TableRow{"ellipsoid", "id type flag density x y z", "ellipsoids", true},
    TableRow{"full", "id mol type q x y z", "", true},
    TableRow{"granular", "id type diameter density x y z"},  // LIGGGHTS
    TableRow{"line", "id mol type flag density x y z", "lines", true},
    TableRow{"mdpd", "id type rho x y z"},
    TableRow{"meso", "id type rho esph cv x y z"},  // older name of sph
    TableRow{"mesont", "id mol type bond mass mradius mlength buckling x y z", "segments of nanotubes"},
    TableRow{"molecular", "id mol type x y z", "", true},
    TableRow{"oxdna", "id type x y z", "nucleotides"},
    TableRow{"peri", "id type volume density x y z"},
    TableRow{"rheo", "id type status rho x y z"},
    TableRow{"rheo/thermal", "id type status rho energy x y z"},
    TableRow{"smd", "id type mol volume mass kradius cradius x0 y0 z0 x y z", "parts of deforming bodies"},
    TableRow{"sph", "id type rho esph cv x y z"},
    TableRow{"sphere", "id type diameter density x y z", "", true},
    TableRow{"spin", "id type x y z spx spy spz sp"},
    TableRow{"tdpd", "id type x y z ..."},  // as many concentrations as there are species
    TableRow{"template", "id type mol index atom x y z"},
    TableRow{"tri", "id mol type flag density x y z", "triangles", true},
    TableRow{"wavepacket", "id type q spin eradius etag re im x y z", "electrons"},
};

std::vector<std::string> words_of(std::string_view text) {
    const auto words = split_words(text);
    return {words.begin(), words.end()};
}

AtomStyle style_of(const TableRow& row) {
    return {std::string(row.name), words_of(row.columns), std::string(row.shape)};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The columns of a hybrid style: number, type, centre, then what each sub-style adds and none before it has.
std::optional<AtomStyle> hybrid_style(const std::string& name, const std::vector<std::string>& parts) {
    std::vector<std::string> columns = words_of("id type x y z");
    std::string shape;
    for (const std::string& part : parts) {
        const std::optional<AtomStyle> style = find_atom_style(part);
        if (!style || part == "hybrid" || style->is_open_ended()) {
            return std::nullopt;
        }
        shape = style->shape().empty() ? shape : style->shape();
        for (const std::string& column : style->columns()) {
            if (!contains(columns, column)) {
                columns.push_back(column);
            }
        }
    }
    return AtomStyle(name, columns, shape);
}

/// Tells whether a word can stand in the column of this name in files that LAMMPS reads. Types may have labels.
bool can_hold(const std::string& column, std::string_view word) {
    if (column == "id" || column == "mol") {
        return is_whole_number(word);
    }
    if (column == "flag") {
        return word == "0" || word == "1";
    }
    if (column == "type") {
        const std::optional<double> label = read_number(word);
        return !label || (is_whole_number(word) && *label >= 1);
    }
    const std::optional<double> value = read_number(word);
    if (column == "diameter") {
        return value && *value >= 0;  // a point particle has none
    }
    return value && (*value > 0 || (column != "density" && column != "volume"));
}

}  // namespace

AtomStyle::AtomStyle(std::string name, std::vector<std::string> columns, std::string shape)
    : name_(std::move(name)), shape_(std::move(shape)), columns_(std::move(columns)) {
    if (columns_.back() == "...") {
        open_ended_ = true;
        columns_.pop_back();
    }
    const auto place_of = [&](const char* column) {
        return std::find(columns_.begin(), columns_.end(), column) - columns_.begin();
    };
    position_ = static_cast<std::size_t>(place_of("x"));
    if (contains(columns_, "diameter")) {
        diameter_ = static_cast<std::size_t>(place_of("diameter"));
    }
}

bool AtomStyle::has_width(std::size_t words) const {
    return open_ended_ ? words >= columns_.size() : words == columns_.size() || words == columns_.size() + 3;
}

std::optional<std::size_t> AtomStyle::contradicted(const std::vector<std::string_view>& words) const {
    for (std::size_t k = 0; k < words.size(); ++k) {
        const bool beyond = k >= columns_.size();
        if (beyond ? !open_ended_ && !is_whole_number(words[k]) : !can_hold(columns_[k], words[k])) {
            return k;
        }
    }
    return std::nullopt;
}

bool AtomStyle::reads_like(const AtomStyle& other) const {
    return position_ == other.position_ && diameter_ == other.diameter_ && shape_ == other.shape_;
}

std::optional<AtomStyle> find_atom_style(std::string_view name) {
    std::vector<std::string> words = words_of(name);
    for (std::string& word : words) {
        if (word.ends_with("/kk")) {
            word.erase(word.size() - 3);  // the same style on an accelerator
        }
    }
    if (words.size() > 1 && words[0] == "hybrid") {
        return hybrid_style(std::string(name), {words.begin() + 1, words.end()});
    }
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const TableRow& row) { return words.size() == 1 && row.name == words[0]; });
    return found == table.end() ? std::nullopt : std::optional(style_of(*found));
}

std::vector<AtomStyle> usual_atom_styles() {
    std::vector<AtomStyle> styles;
    for (const TableRow& row : table) {
        if (row.usual) {
            styles.push_back(style_of(row));
        }
    }
    return styles;
}

}  // namespace coagula::io
