// coagula import: coordinates that somebody measured or made with another program.
#include "cli/output_file.hpp"
#include "cli/progress_bar.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"
#include "stages.hpp"

#include <coagula/characterize/plausibility.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/gsd_file.hpp>
#include <coagula/io/h5md_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace coagula::tools {

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
    try {
        return parse_quantity(text, "m", physical::length, 1.0);
    } catch (const InputError& error) {
        throw InputError(std::string("--box: ") + error.what());
    }
}

/// "L" or "LX,LY,LZ", each with its unit.
Eigen::Vector3d parse_box(const std::string& text) {
    const std::vector<std::string> parts = split(text);
    if (parts.size() == 1) {
        return Eigen::Vector3d::Constant(parse_edge(parts[0]));
    }
    if (parts.size() != 3) {
        throw InputError("--box: '" + text + "' must be one edge length or three, LX,LY,LZ");
    }
    return {parse_edge(parts[0]), parse_edge(parts[1]), parse_edge(parts[2])};
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
        options.box = parse_box(arguments.text("box"));
    }
    if (options.open && (options.box || options.wrap)) {
        throw InputError("--open excludes --box and --wrap: a set with a free surface has no periodic box");
    }
    return options;
}

/// A single particle has no distance to another; JSON has no NaN.
Json json_of_distance(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// The values that show a wrong length unit, and a warning for each that no packing has.
Table plausibility_rows(const characterize::Plausibility& found) {
    Table rows = {{"volume fraction", with_unit(found.volume_fraction, "1")}};
    if (std::isfinite(found.smallest)) {
        rows.push_back(
            {"nearest centres", with_unit(found.smallest, "1") + " diameters apart, median " + with_unit(found.median, "1")});
    }
    rows.push_back({"contacts", std::to_string(found.contacts) + ", " + with_unit(found.coordination, "1") +
                                    " per particle   (within 1.01 diameters)"});
    for (const std::string& warning : found.warnings) {
        rows.push_back({"warning", warning});
    }
    return rows;
}

void report_import(const Arguments& arguments, const io::Structure& structure, const characterize::Plausibility& found) {
    const Packing& packing = structure.packing;
    const Eigen::Vector3d box = packing.cell.lengths();
    const std::size_t frames = structure.earlier.size() + 1;
    const std::string output = arguments.text("output");
    const Json json = {
        {"particles", packing.size()},
        {"frames", frames},
        {"box", {box.x(), box.y(), box.z()}},
        {"periodic", packing.cell.is_periodic()},
        {"volume_fraction", found.volume_fraction},
        {"radius_mean", mean_radius(packing)},
        {"contacts", found.contacts},
        {"coordination", found.coordination},
        {"nearest_distance", {{"smallest", json_of_distance(found.smallest)}, {"median", json_of_distance(found.median)}}},
        {"warnings", found.warnings},
        {"output", output}};
    Table table = {{"particles", std::to_string(packing.size())}};
    if (frames > 1) {
        table.emplace_back("frames", std::to_string(frames));
    }
    table.emplace_back("box", describe(packing.cell));
    table.emplace_back("mean radius", with_unit(mean_radius(packing), "m"));
    const Table rows = plausibility_rows(found);
    table.insert(table.end(), rows.begin(), rows.end());
    table.emplace_back("written to", output);
    report(arguments, json, table);
}

void run_import(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    const std::string output = arguments.text("output");
    const bool force = arguments.flag("force");
    check_output(arguments, output);
    const io::Structure structure = import_structure(arguments);
    const Packing& packing = structure.packing;
    progress.update("writing", 1.0);
    io::write_structure(output, structure, {}, {}, describe_call(arguments, nullptr, clock), force);

    report_import(arguments, structure, characterize::judge_plausibility(packing));
}

}  // namespace

io::Structure import_structure(const Arguments& arguments) {
    const io::ImportOptions options = import_options(arguments);
    io::Structure structure = read_any_format(arguments, options);
    check(structure.packing, arguments.input());
    return structure;
}

Verb import_verb() {
    return {
        .name = "import",
        .summary = "take over coordinates from CSV, extended XYZ, LAMMPS data or dump, GSD or H5MD",
        .input = "FILE",
        .options =
            {required(output("HDF5 file to write")), flag("force", "replace an existing file"),
             choice("format", {"csv", "extxyz", "lammps", "dump", "gsd", "h5md"},
                    "format of the file; by its ending when not given", ""),
             particle_radius("radius of every particle; a column of the file when not given"),
             text("box", "L|LX,LY,LZ", "edge lengths of the periodic box [unit m; range " + physical::length.text() + "]"),
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
             flag("wrap", "move particles outside the periodic box back into it; otherwise they are an error")},
        .run = run_import};
}

}  // namespace coagula::tools
