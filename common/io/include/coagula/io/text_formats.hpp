// Coordinates in text formats: CSV with a header, extended XYZ, LAMMPS data.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>

namespace coagula::io {

enum class TextFormat { csv, extended_xyz, lammps_data };

/// From the ending of the name: .csv; .xyz, .extxyz; .data, .lmp, .lammps. Throws InputError for others.
TextFormat format_from_name(const std::string& path);

struct ImportOptions {
    std::optional<double> radius;        ///< of every particle [m]; otherwise a column of the file
    std::optional<Eigen::Vector3d> box;  ///< edge lengths of the periodic cell [m]; otherwise from the file
    bool open = false;                   ///< the set has a free surface: no periodicity
    std::optional<double> length_unit;   ///< metres per unit of columns that name none
    bool wrap = false;                   ///< bring positions outside the box back in; otherwise they are an error
};

/// Reads a packing; errors name file, line and rule (InputError).
///
/// CSV: a header with columns x, y, z and optionally radius (or r, rad), each with its unit in brackets ("x [um]"); other columns
/// are ignored. Extended XYZ: Lattice (orthorhombic), Properties with pos and optionally radius. LAMMPS data: Atoms of style
/// sphere, atomic or bond.
Packing read_text(const std::string& path, TextFormat format, const ImportOptions& options);

/// Writes a packing (and the bonds, where the format has them: LAMMPS data) through a temporary file and a rename.
/// CSV carries units in the header (m); extended XYZ is in m with a comment; LAMMPS data is in SI units, atom_style hybrid sphere
/// bond (or sphere).
void write_text(const std::string& path, TextFormat format, const Packing& packing, const std::optional<ContactNetwork>& bonds,
                bool overwrite);

}  // namespace coagula::io
