// SPDX-License-Identifier: GPL-3.0-or-later
// Atom styles of LAMMPS: what stands in which column of the section Atoms of a data file (LAMMPS manual, "read_data").
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::io {

/// The columns of an atom style, and where the centre and the diameter of a sphere stand among them.
class AtomStyle {
public:
    /// @param columns names such as "id type diameter density x y z".
    AtomStyle(std::string name, std::vector<std::string> columns, std::string shape = {});

    const std::string& name() const { return name_; }
    const std::vector<std::string>& columns() const { return columns_; }
    /// The particles, such as "ellipsoids", where they are no spheres with a centre; empty otherwise.
    const std::string& shape() const { return shape_; }
    std::size_t position() const { return position_; }
    std::optional<std::size_t> diameter() const { return diameter_; }
    /// Whether more columns may follow, as many as the input script of LAMMPS says.
    bool is_open_ended() const { return open_ended_; }
    /// Whether a line of so many words has all columns and, if it has more, three image flags.
    bool has_width(std::size_t words) const;
    /// The first column that the words of a line contradict, such as a type that is not whole; nothing when all hold.
    std::optional<std::size_t> contradicted(const std::vector<std::string_view>& words) const;
    /// Whether coagula takes the same numbers from a line.
    bool reads_like(const AtomStyle& other) const;

private:
    std::string name_;
    std::string shape_;
    std::vector<std::string> columns_;
    std::size_t position_ = 0;
    std::optional<std::size_t> diameter_;
    bool open_ended_ = false;
};

/// The style of a name such as "full", "atomic/kk" or "hybrid sphere bond"; nothing when LAMMPS has none of this name.
std::optional<AtomStyle> find_atom_style(std::string_view name);

/// Styles that a file may have which does not name its style. The others are so special that only their name tells them.
std::vector<AtomStyle> usual_atom_styles();

}  // namespace coagula::io
