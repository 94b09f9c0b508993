// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/text_formats.hpp>

#include <coagula/io/structure_file.hpp>

#include <filesystem>

#include <coagula/io/atomic_file.hpp>
#include "text_reader.hpp"
#include "triclinic.hpp"

namespace coagula::io {

namespace {

/// Three numbers with a separator, each the shortest text that reads back as the same number.
std::string triple(const Eigen::Vector3d& values, char separator = ' ') {
    return to_text(values[0]) + separator + to_text(values[1]) + separator + to_text(values[2]);
}

/// The frames of a trajectory, the packing last.
struct Trajectory {
    const Packing& packing;
    const std::vector<Frame>& earlier;
    double time;

    std::size_t frames() const { return earlier.size() + 1; }
    const Eigen::Matrix3Xd& positions(std::size_t frame) const {
        return frame < earlier.size() ? earlier[frame].positions : packing.positions;
    }
    double time_of(std::size_t frame) const { return frame < earlier.size() ? earlier[frame].time : time; }
};

/// A single packing has no column of frames, so that it is read back as it is.
std::string csv_text(const Trajectory& run) {
    const bool many = run.frames() > 1;
    std::string out = many ? "frame,time [s],x [m],y [m],z [m],radius [m]\n" : "x [m],y [m],z [m],radius [m]\n";
    for (std::size_t frame = 0; frame < run.frames(); ++frame) {
        const std::string begin = many ? std::to_string(frame) + ',' + to_text(run.time_of(frame)) + ',' : std::string{};
        for (Index particle = 0; particle < run.packing.size(); ++particle) {
            out += begin + triple(run.positions(frame).col(particle), ',');
            out += ',' + to_text(run.packing.radii[particle]) + '\n';
        }
    }
    return out;
}

/// Whether the box is periodic along each edge, by words with a blank between.
std::string flags_of(const Cell& cell, const std::string& periodic, const std::string& open) {
    std::string flags;
    for (int axis = 0; axis < 3; ++axis) {
        flags += (axis > 0 ? " " : "") + (cell.is_periodic(axis) ? periodic : open);
    }
    return flags;
}

std::string extended_xyz_text(const Trajectory& run) {
    const Packing& packing = run.packing;
    const Eigen::Matrix3d edges = packing.cell.edges();
    const std::string comment = "Lattice=\"" + triple(edges.col(0)) + ' ' + triple(edges.col(1)) + ' ' + triple(edges.col(2)) +
                                "\" Origin=\"" + triple(packing.cell.origin()) + "\" pbc=\"" + flags_of(packing.cell, "T", "F") +
                                "\" Properties=species:S:1:pos:R:3:radius:R:1 length_unit=m";
    std::string out;
    for (std::size_t frame = 0; frame < run.frames(); ++frame) {
        out += std::to_string(packing.size()) + '\n' + comment;
        out += run.frames() > 1 ? " Time=" + to_text(run.time_of(frame)) + '\n' : "\n";
        for (Index particle = 0; particle < packing.size(); ++particle) {
            out += "X " + triple(run.positions(frame).col(particle)) + ' ' + to_text(packing.radii[particle]) + '\n';
        }
    }
    return out;
}

/// @param with_units the lines of `dump_modify units yes time yes`, which not all programs that read dumps know.
std::string dump_text(const Trajectory& run, bool with_units) {
    const Packing& packing = run.packing;
    const Cell& cell = packing.cell;
    const Cell bounds = cell.bounds();
    const Eigen::Vector3d upper = bounds.origin() + bounds.lengths();
    const Eigen::Vector3d tilt(cell.edges()(0, 1), cell.edges()(0, 2), cell.edges()(1, 2));
    std::string box =
        std::string("ITEM: BOX BOUNDS ") + (cell.is_rectangular() ? "" : "xy xz yz ") + flags_of(cell, "pp", "ff") + '\n';
    for (int axis = 0; axis < 3; ++axis) {
        box += to_text(bounds.origin()[axis]) + ' ' + to_text(upper[axis]);
        box += cell.is_rectangular() ? "\n" : ' ' + to_text(tilt[axis]) + '\n';
    }
    std::string out;
    for (std::size_t frame = 0; frame < run.frames(); ++frame) {
        if (with_units) {
            out += (frame == 0 ? "ITEM: UNITS\nsi\n" : "") + std::string("ITEM: TIME\n") + to_text(run.time_of(frame)) + '\n';
        }
        out += "ITEM: TIMESTEP\n" + std::to_string(frame) + "\nITEM: NUMBER OF ATOMS\n" + std::to_string(packing.size()) + '\n' +
               box + "ITEM: ATOMS id type x y z radius\n";
        for (Index particle = 0; particle < packing.size(); ++particle) {
            out += std::to_string(particle + 1) + " 1 " + triple(run.positions(frame).col(particle)) + ' ' +
                   to_text(packing.radii[particle]) + '\n';
        }
    }
    return out;
}

/// LAMMPS refuses a density of zero; a packing has none, so this stands in until `set group all density` is given.
constexpr const char* placeholder_density = "1000";

std::string lammps_header(const Packing& packing, const std::optional<ContactNetwork>& bonds) {
    const Eigen::Vector3d lower = packing.cell.origin();
    const Eigen::Matrix3d& edges = packing.cell.edges();
    const Eigen::Vector3d upper = lower + edges.diagonal();
    std::string out = "coagula packing, units = si, boundary = ";
    out += flags_of(packing.cell, "p", "f");
    out += bonds ? ", atom_style = hybrid sphere bond" : ", atom_style = sphere";
    out += ", the density is a placeholder\n\n" + std::to_string(packing.size()) + " atoms\n1 atom types\n";
    if (bonds) {
        out += std::to_string(bonds->size()) + " bonds\n1 bond types\n";
    }
    out += '\n';
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        out += to_text(lower[axis]) + ' ' + to_text(upper[axis]) + ' ' + name + "lo " + name + "hi\n";
    }
    if (!packing.cell.is_rectangular()) {
        out += triple({edges(0, 1), edges(0, 2), edges(1, 2)}) + " xy xz yz\n";
    }
    return out;
}

std::string lammps_text(const Packing& packing, const std::optional<ContactNetwork>& bonds) {
    std::string out = lammps_header(packing, bonds) + (bonds ? "\nAtoms # hybrid\n\n" : "\nAtoms # sphere\n\n");
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const std::string diameter = to_text(2 * packing.radii[particle]) + ' ' + placeholder_density;
        const std::string position = triple(packing.positions.col(particle));
        out += std::to_string(particle + 1) + " 1 " + (bonds ? position + ' ' + diameter + " 1" : diameter + ' ' + position) + '\n';
    }
    if (bonds && bonds->size() > 0) {
        out += "\nBonds\n\n";
        for (Index bond = 0; bond < bonds->size(); ++bond) {
            out += std::to_string(bond + 1) + " 1 " + std::to_string(bonds->ends(0, bond) + 1) + ' ' +
                   std::to_string(bonds->ends(1, bond) + 1) + '\n';
        }
    }
    return out;
}

}  // namespace

TextFormat format_from_name(const std::string& path) {
    const std::string ending = lower_case(std::filesystem::path(path).extension().string());
    if (ending == ".csv") {
        return TextFormat::csv;
    }
    if (ending == ".xyz" || ending == ".extxyz") {
        return TextFormat::extended_xyz;
    }
    if (ending == ".data" || ending == ".lmp" || ending == ".lammps") {
        return TextFormat::lammps_data;
    }
    if (ending == ".dump" || ending == ".lammpstrj") {
        return TextFormat::lammps_dump;
    }
    throw InputError(path +
                     " has no ending that names a format: .csv; .xyz, .extxyz; .data, .lmp, .lammps; .dump, .lammpstrj; .gsd; "
                     ".h5md, .h5, .hdf5");
}

Structure read_frames(const std::string& path, TextFormat format, const ImportOptions& options) {
    refuse_options_of_other_formats(path, options, format);
    LineReader file(path);
    try {
        switch (format) {
            case TextFormat::csv:
                return finish(path, read_csv(file, options), options);
            case TextFormat::extended_xyz:
                return finish(path, read_extended_xyz(file, options), options);
            case TextFormat::lammps_data:
                return finish(path, read_lammps_data(file, options), options);
            case TextFormat::lammps_dump:
                return finish(path, read_lammps_dump(file, options), options);
        }
    } catch (const std::invalid_argument& error) {
        const std::string sentence = error.what();
        throw InputError(sentence.starts_with(path) ? sentence : path + ": " + sentence);
    }
    throw std::invalid_argument("unknown text format");
}

Packing read_text(const std::string& path, TextFormat format, const ImportOptions& options) {
    return read_frames(path, format, options).packing;
}

void write_text(const std::string& path, TextFormat format, const Structure& structure, bool overwrite, bool dump_units) {
    const Packing& packing = structure.packing;
    check_output(path, overwrite);
    check(packing);
    if (format == TextFormat::lammps_data || format == TextFormat::lammps_dump) {
        require_restricted(path, packing.cell);
    }
    const Trajectory run{packing, structure.earlier, structure.time};
    switch (format) {
        case TextFormat::csv:
            return write_file(path, csv_text(run), overwrite);
        case TextFormat::extended_xyz:
            return write_file(path, extended_xyz_text(run), overwrite);
        case TextFormat::lammps_data:
            if (!structure.earlier.empty()) {
                throw InputError("LAMMPS data holds one frame: a trajectory goes into a LAMMPS dump, extended XYZ, GSD or CSV");
            }
            return write_file(path, lammps_text(packing, structure.bonds), overwrite);
        case TextFormat::lammps_dump:
            return write_file(path, dump_text(run, dump_units), overwrite);
    }
}

}  // namespace coagula::io
