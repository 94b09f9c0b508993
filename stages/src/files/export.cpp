// SPDX-License-Identifier: GPL-3.0-or-later
// export: coordinates (and bonds) for other programs.
#include <coagula/io/gsd_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>
#include <coagula/io/trajectory_file.hpp>
#include <coagula/io/vtk_file.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/output_file.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

namespace coagula::stages {

namespace {

struct Format {
    std::string name;
    std::vector<std::string> endings;  ///< the first is given to a file without a name of its own
    void (*write)(const std::string& path, const io::Structure& structure, bool overwrite);
    bool many_frames = true;
};

template <io::TextFormat format>
void write_as(const std::string& path, const io::Structure& structure, bool overwrite) {
    io::write_text(path, format, structure, overwrite);
}

const std::array formats = {Format{"extxyz", {".extxyz", ".xyz"}, write_as<io::TextFormat::extended_xyz>},
                            Format{"lammps", {".data", ".lmp", ".lammps"}, write_as<io::TextFormat::lammps_data>, false},
                            Format{"dump", {".dump", ".lammpstrj"}, write_as<io::TextFormat::lammps_dump>},
                            Format{"csv", {".csv"}, write_as<io::TextFormat::csv>},
                            Format{"gsd", {".gsd"}, io::write_gsd},
                            Format{"vtk", {".vtp"}, io::write_vtk, false}};

std::vector<std::string> format_names(bool with_frames_only) {
    std::vector<std::string> names;
    for (const Format& format : formats) {
        if (format.many_frames || !with_frames_only) {
            names.push_back(format.name);
        }
    }
    return names;
}

const Format& format_of(const std::string& path) {
    const std::string ending = std::filesystem::path(path).extension().string();
    std::vector<std::string> known;
    for (const Format& format : formats) {
        if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end()) {
            return format;
        }
        known.insert(known.end(), format.endings.begin(), format.endings.end());
    }
    throw InputError(path + " has no ending that names a format: " + list_of(known));
}

/// The format that --format names, or that the ending of the output names.
const Format& chosen_format(const Arguments& arguments) {
    const std::string name = arguments.text("format", "");
    if (!name.empty()) {
        return *std::find_if(formats.begin(), formats.end(), [&](const Format& entry) { return entry.name == name; });
    }
    if (!arguments.has("output")) {
        throw InputError("the format is missing: give " + arguments.spelled("format") + ", or " + arguments.spelled("output") +
                         " with an ending that names it");
    }
    return format_of(arguments.text("output"));
}

/// The words of `coagula import` that give the box back.
std::string box_words(const Cell& cell) {
    const Eigen::Matrix3d& edges = cell.edges();
    std::vector<double> lengths = {edges(0, 0), edges(1, 1), edges(2, 2)};
    if (edges(0, 1) != 0 || edges(0, 2) != 0 || edges(1, 2) != 0) {
        lengths.insert(lengths.end(), {edges(0, 1), edges(0, 2), edges(1, 2)});
    }
    std::string box;
    for (const double length : lengths) {
        box += (box.empty() ? "" : ",") + to_text(length) + "m";
    }
    std::string axes;
    for (int axis = 0; axis < 3; ++axis) {
        axes += cell.is_periodic(axis) ? std::string(axes.empty() ? "" : ",") + "xyz"[axis] : "";
    }
    return "--box " + box + (cell.is_periodic() ? "" : " --periodic " + axes);
}

}  // namespace

Printed export_file(const Arguments& arguments) {
    const Format& format = chosen_format(arguments);
    const bool all_frames = arguments.flag("trajectory");
    if (all_frames && !format.many_frames) {
        throw InputError(arguments.spelled("trajectory") + ": the format " + format.name + " holds one frame; many go into " +
                         list_of(format_names(true)));
    }
    if (arguments.flag("dump-units") && format.name != "dump") {
        throw InputError(arguments.spelled("dump-units") + ": the format " + format.name + " is no LAMMPS dump");
    }
    const std::string beside = std::filesystem::path(arguments.input()).replace_extension(format.endings.front()).string();
    const std::string output = arguments.text("output", beside);
    const io::Structure structure = all_frames ? io::read_trajectory(arguments.input()) : io::read_structure(arguments.input());
    const bool force = arguments.flag("force");
    check_output(arguments, output);
    if (arguments.flag("dump-units")) {
        io::write_text(output, io::TextFormat::lammps_dump, structure, force, true);
    } else {
        format.write(output, structure, force);
    }
    const std::size_t frames = structure.earlier.size() + 1;
    Json json = {{"output", output}, {"format", format.name}, {"particles", structure.packing.size()}, {"frames", frames}};
    Table table = {{"particles", std::to_string(structure.packing.size())}, {"written to", output}};
    if (all_frames) {
        table.insert(table.begin() + 1, {"frames", std::to_string(frames)});
    }
    const Cell& cell = structure.packing.cell;
    if (format.name == "csv" && (cell.is_periodic(0) || cell.is_periodic(1) || cell.is_periodic(2))) {
        const std::string note = "a CSV file has no box; coagula import takes it from " + box_words(cell);
        json["notes"] = Json::array({note});
        table.emplace_back("note", note);
    }
    return {std::move(json), std::move(table)};
}

void export_structure(const std::string& path, const io::Structure& structure, bool overwrite) {
    format_of(path).write(path, structure, overwrite);
}

Verb export_verb() {
    return {
        .name = "export",
        .summary = "write the coordinates as extended XYZ, LAMMPS data or dump, CSV, GSD or VTK",
        .input = "FILE.h5",
        .options = {choice("format", format_names(false),
                           "format; by the ending of --output when not given; vtk is PolyData with the bonds, lammps is a data "
                           "file with the bonds",
                           ""),
                    flag("trajectory", "write all frames of the file, oldest first, instead of the last one"),
                    flag("dump-units",
                         "name units and times in a LAMMPS dump, as dump_modify units yes time yes does; MDAnalysis cannot read "
                         "these"),
                    output("file to write; by default beside the input"), flag("force", "replace an existing file")}};
}

}  // namespace coagula::stages
