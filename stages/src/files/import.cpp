// SPDX-License-Identifier: GPL-3.0-or-later
// import: coordinates that somebody measured or made with another program.
#include <coagula/common/spelling.hpp>
#include <coagula/io/gsd_file.hpp>
#include <coagula/io/h5md_file.hpp>
#include <coagula/io/text_formats.hpp>
#include <coagula/stages/files.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace coagula::stages {

namespace {

/// The name of the format, or the ending of the file that stands for it.
io::Structure read_any_format(const Arguments& arguments, const io::ImportOptions& options) {
    const std::string& path = arguments.input();
    const std::string name = arguments.text("format", "");
    const std::string ending = name.empty() ? std::filesystem::path(path).extension().string() : "";
    if (name == "gsd" || ending == ".gsd") {
        return io::read_gsd(path, options);
    }
    if (name == "h5md" || ending == ".h5md" || ending == ".h5" || ending == ".hdf5") {
        return io::read_h5md(path, options);
    }
    static const std::map<std::string, io::TextFormat> text_formats = {{"csv", io::TextFormat::csv},
                                                                       {"extxyz", io::TextFormat::extended_xyz},
                                                                       {"lammps", io::TextFormat::lammps_data},
                                                                       {"dump", io::TextFormat::lammps_dump}};
    return io::read_frames(path, name.empty() ? io::format_from_name(path) : text_formats.at(name), options);
}

/// "U" for all lengths, "UX,UY,UZ" for the axes, "UX,UY,UZ,UR" with that of the radius, each with its unit.
void parse_length_units(const std::string& text, io::ImportOptions& options) {
    const std::set<std::string> of_images = {"px", "pixel", "pixels", "vx", "voxel", "voxels"};
    std::vector<double> units;
    for (const std::string& part : split(text)) {
        if (of_images.contains(part)) {
            throw InputError("a length in " + part +
                             " has no size of its own: give the edge of one, such as 0.1um, or those of the axes, "
                             "such as 0.1um,0.1um,0.3um");
        }
        units.push_back(parse_quantity(part, "m", physical::length));
    }
    if (units.size() == 1) {
        options.length_unit = units[0];
        return;
    }
    if (units.size() != 3 && units.size() != 4) {
        throw InputError("'" + text + "' must be one length, or three of the axes, UX,UY,UZ, or four with that of the radius");
    }
    options.axis_units = Eigen::Vector3d(units[0], units[1], units[2]);
    if (units.size() == 4) {
        options.length_unit = units[3];
    }
}

/// "x=HEADING,y=HEADING".
std::map<std::string, std::string> parse_columns(const std::string& text) {
    const std::vector<std::string> known = {"x", "y", "z", "radius", "diameter", "frame"};
    std::map<std::string, std::string> columns;
    for (const std::string& part : split(text)) {
        const std::size_t equals = part.find('=');
        const std::string name = part.substr(0, equals);
        if (equals == std::string::npos || equals + 1 == part.size()) {
            throw InputError("'" + part + "' is not of the form x=HEADING");
        }
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            throw InputError("'" + name + "' is not one of " + list_of(known) + did_you_mean(name, known));
        }
        if (!columns.emplace(name, part.substr(equals + 1)).second) {
            throw InputError("'" + name + "' is given twice");
        }
    }
    return columns;
}

io::FrameChoice parse_frame(const std::string& text) {
    using Kind = io::FrameChoice::Kind;
    for (const auto& [name, kind] : {std::pair{"last", Kind::last}, {"first", Kind::first}, {"all", Kind::all}}) {
        if (text == name) {
            return {kind};
        }
    }
    const double number = parse_quantity(text, "1", within(-1e15, 1e15));
    if (number != std::nearbyint(number)) {
        throw InputError("'" + text + "' is not a whole number, first, last or all");
    }
    return {Kind::number, static_cast<std::int64_t>(number)};
}

double parse_edge(const std::string& text) {
    return parse_quantity(text, "m", physical::length, 1.0);
}

/// "L" or "LX,LY,LZ", or "LX,LY,LZ,XY,XZ,YZ" of a tilted box, each with its unit.
Eigen::Matrix3d parse_box(const std::string& text) {
    const std::vector<std::string> parts = split(text);
    if (parts.size() == 1) {
        return Eigen::Matrix3d::Identity() * parse_edge(parts[0]);
    }
    if (parts.size() != 3 && parts.size() != 6) {
        throw InputError("'" + text + "' must be one edge length, three, LX,LY,LZ, or these and the tilts, LX,LY,LZ,XY,XZ,YZ");
    }
    Eigen::Matrix3d edges = Eigen::Vector3d(parse_edge(parts[0]), parse_edge(parts[1]), parse_edge(parts[2])).asDiagonal();
    if (parts.size() == 6) {
        const auto tilt = [&](std::size_t part) { return parse_quantity(parts[part], "m", within(-1.0, 1.0), 1.0); };
        edges(0, 1) = tilt(3);
        edges(0, 2) = tilt(4);
        edges(1, 2) = tilt(5);
    }
    return edges;
}

/// "x,y": the edges along which the box is periodic.
std::array<bool, 3> parse_periodic(const std::string& text) {
    std::array<bool, 3> periodic = {false, false, false};
    for (const std::string& axis : split(text)) {
        const std::size_t place = std::string("xyz").find(axis);
        if (axis.size() != 1 || place == std::string::npos) {
            throw InputError("'" + axis + "' is none of the axes x, y, z");
        }
        periodic[place] = true;
    }
    return periodic;
}

io::ImportOptions import_options(const Arguments& arguments) {
    io::ImportOptions options;
    options.radius = arguments.optional_quantity("radius");
    if (arguments.has("length-unit")) {
        arguments.parsed("length-unit", [&](const std::string& text) { parse_length_units(text, options); });
    }
    if (arguments.has("columns")) {
        options.columns = arguments.parsed("columns", parse_columns);
    }
    if (arguments.has("frame")) {
        options.frame = arguments.parsed("frame", parse_frame);
    }
    options.atom_style = arguments.text("atom-style", "");
    options.open = arguments.flag("open");
    options.wrap = arguments.flag("wrap");
    if (arguments.has("box")) {
        options.box = arguments.parsed("box", parse_box);
    }
    if (arguments.has("periodic")) {
        options.periodic = arguments.parsed("periodic", parse_periodic);
    }
    if (options.open && options.periodic) {
        throw InputError(arguments.spelled("open") + " excludes " + arguments.spelled("periodic"));
    }
    if (options.open && (options.box || options.wrap)) {
        throw InputError(arguments.spelled("open") + " excludes " + arguments.spelled("box") + " and " + arguments.spelled("wrap") +
                         ": a set with a free surface has no periodic box");
    }
    return options;
}

/// Whether all centres lie in a plane in which the spheres do not meet their own images across it, as those of a crystal do that is
/// one layer thick.
bool is_flat(const Packing& packing) {
    constexpr Index fewest = 10;  // spheres; a few may lie in a plane anywhere
    if (packing.size() < fewest) {
        return false;
    }
    const Eigen::Matrix3Xd places = packing.positions.colwise() - packing.positions.rowwise().mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(places * places.transpose());
    const Eigen::RowVector3d normal = axes.eigenvectors().col(0).transpose();
    const double thickness = (normal * places).cwiseAbs().maxCoeff();
    const double radius = packing.radii.maxCoeff();
    bool meets_images = false;
    for (int edge = 0; edge < 3; ++edge) {
        const double apart = std::abs(normal.dot(packing.cell.edges().col(edge).transpose()));
        meets_images = meets_images || (packing.cell.is_periodic(edge) && apart > 0.5 * radius && apart < 3 * radius);
    }
    return thickness < 1e-3 * radius && !meets_images;
}

}  // namespace

io::Structure import_structure(const Arguments& arguments) {
    const io::ImportOptions options = import_options(arguments);
    io::Structure structure = read_any_format(arguments, options);
    check(structure.packing, arguments.input());
    if (is_flat(structure.packing)) {
        throw InputError(arguments.input() + ": all " + std::to_string(structure.packing.size()) +
                         " centres lie in a plane: the packing has two dimensions, but coagula treats packings in three");
    }
    return structure;
}

Verb import_verb() {
    return {.name = "import",
            .summary = "take over coordinates from CSV, extended XYZ, LAMMPS data or dump, GSD or H5MD",
            .input = "FILE",
            .options = {
                required(output("HDF5 file to write")), flag("force", "replace an existing file"),
                choice("format", {"csv", "extxyz", "lammps", "dump", "gsd", "h5md"},
                       "format of the file; by its ending when not given", ""),
                particle_radius("radius of every particle; a column of the file when not given"),
                text("box", "L|LX,LY,LZ[,XY,XZ,YZ]",
                     "edge lengths of the periodic box, and the tilts of one that is not rectangular [unit m; range " +
                         physical::length.text() + "]"),
                text("periodic", "AXES", "edges along which the box is periodic, such as x,y; what the file says when not given"),
                flag("open", "the set has a free surface: no periodic box"),
                text("length-unit", "U|UX,UY,UZ[,UR]",
                     "length that 1 stands for in columns without a unit or in pixels: one for all, or one for each axis and the "
                     "radius, such as 0.1um,0.1um,0.3um [unit m; range " +
                         physical::length.text() + "]"),
                text("columns", "NAME=HEADING,...", "columns of a CSV file: x, y, z, radius, diameter, frame"),
                text("atom-style", "STYLE",
                     "atom style of LAMMPS data that name none, such as full, or 'hybrid sphere bond' where they name hybrid only"),
                text("frame", "N|first|last|all",
                     "frame of a trajectory: the value in the column frame of a CSV file, which has no default; otherwise counted "
                     "from 0, the last when not given; all: the whole trajectory"),
                flag("wrap", "move particles outside the periodic box back into it; otherwise they are an error")}};
}

}  // namespace coagula::stages
