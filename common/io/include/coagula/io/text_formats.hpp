// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates in text formats: CSV with a header, extended XYZ, LAMMPS data, LAMMPS dump.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/io/structure_file.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coagula::io {

enum class TextFormat { csv, extended_xyz, lammps_data, lammps_dump };

/// From the ending of the name: .csv; .xyz, .extxyz; .data, .lmp, .lammps; .dump, .lammpstrj. Throws InputError for others.
TextFormat format_from_name(const std::string& path);

/// Which frames of a trajectory are wanted.
struct FrameChoice {
    enum class Kind { last, first, number, all };
    Kind kind = Kind::last;
    std::int64_t number = 0;  ///< value in the column frame of a CSV file; in other formats counted from 0
};

struct ImportOptions {
    std::optional<double> radius;                      ///< of every particle [m]; otherwise a column of the file
    std::optional<Eigen::Matrix3d> box;                ///< columns are the edges of the periodic cell [m]; otherwise from the file
    std::optional<std::array<bool, 3>> periodic = {};  ///< along each edge, in place of what the file says
    bool open = false;                                 ///< the set has a free surface: no periodicity
    std::optional<double> length_unit;                 ///< metres per unit of columns that name none
    /// The same of the coordinates of a CSV file, one per axis, such as anisotropic voxels; `length_unit` then is that of the
    /// radius.
    std::optional<Eigen::Vector3d> axis_units = {};
    std::map<std::string, std::string> columns =
        {};                                 ///< of a CSV file: its heading for "x", "y", "z", "radius", "diameter", "frame"
    std::optional<FrameChoice> frame = {};  ///< the last when not given
    std::string atom_style = {};            ///< of LAMMPS data that do not name theirs, such as "full" or "hybrid sphere bond"
    bool wrap = false;                      ///< bring positions outside the box back in; otherwise they are an error
};

/// Reads a packing; errors name file, line and rule (InputError).
///
/// CSV: a header with columns x, y, z and optionally radius (or r, rad) or diameter, each with its unit in brackets ("x [um]");
/// other columns are ignored. Extended XYZ: Lattice, pbc, Origin, Properties with pos and optionally radius or diameter. LAMMPS
/// data: Atoms of a style that the file or the options name, or that the columns leave no doubt about. LAMMPS dump: x y z,
/// unwrapped or scaled, and optionally radius or diameter.
///
/// Of several frames the last one is taken unless the options say otherwise; a CSV file with a column frame that holds several is
/// refused unless they do. With all frames the last one is the packing and the others are `earlier`; they must have the same box
/// and the same radii.
Structure read_frames(const std::string& path, TextFormat format, const ImportOptions& options);

/// The packing of read_frames.
Packing read_text(const std::string& path, TextFormat format, const ImportOptions& options);

/// Writes a packing (and the bonds, where the format has them: LAMMPS data) through a temporary file and a rename.
/// CSV carries units in the header (m); extended XYZ is in m with a comment; LAMMPS data is in SI units, atom_style hybrid sphere
/// bond (or sphere); LAMMPS dump is in SI units, which it names, with the times, by `dump_units` only: not all programs that read
/// dumps know these lines. Earlier frames come first; LAMMPS data cannot hold them (InputError).
void write_text(const std::string& path, TextFormat format, const Structure& structure, bool overwrite, bool dump_units = false);

}  // namespace coagula::io
