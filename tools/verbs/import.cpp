// coagula import: coordinates that somebody measured or made with another program.
#include "cli/output_file.hpp"
#include "cli/progress_bar.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"
#include "stages.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

namespace coagula::tools {

namespace {

io::TextFormat chosen_format(const Arguments& arguments) {
    const std::string name = arguments.text("format", "");
    if (name.empty()) {
        return io::format_from_name(arguments.input());
    }
    return name == "csv" ? io::TextFormat::csv : (name == "extxyz" ? io::TextFormat::extended_xyz : io::TextFormat::lammps_data);
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
    options.length_unit = arguments.optional_quantity("length-unit");
    options.open = arguments.flag("open");
    options.wrap = arguments.flag("wrap");
    if (arguments.has("box")) {
        options.box = parse_box(arguments.text("box"));
    }
    if (options.open && (options.box || options.wrap)) {
        throw InputError("--open goes without --box and --wrap: a set with a free surface has no periodic box");
    }
    return options;
}

void run(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    const std::string output = arguments.text("output");
    const bool force = arguments.flag("force");
    chosen_format(arguments);
    import_options(arguments);
    check_output(output, force);
    const Packing packing = import_packing(arguments);
    progress.update("writing", 1.0);
    io::write_structure(output, {packing, std::nullopt}, {}, {}, describe_call(arguments, nullptr, clock), force);

    const Eigen::Vector3d box = packing.cell.lengths();
    const Json json = {{"particles", packing.size()},
                       {"box", {box.x(), box.y(), box.z()}},
                       {"periodic", packing.cell.is_periodic()},
                       {"volume_fraction", volume_fraction(packing)},
                       {"radius_mean", mean_radius(packing)},
                       {"output", output}};
    report(arguments, json,
           {{"particles", std::to_string(packing.size())},
            {"box", describe(packing.cell)},
            {"mean radius", with_unit(mean_radius(packing), "m")},
            {"written to", output}});
}

}  // namespace

Packing import_packing(const Arguments& arguments) {
    const io::TextFormat format = chosen_format(arguments);
    Packing packing = io::read_text(arguments.input(), format, import_options(arguments));
    check(packing, arguments.input());
    return packing;
}

Verb import_verb() {
    return {
        .name = "import",
        .summary = "take over coordinates from CSV, extended XYZ or LAMMPS data",
        .input = "FILE",
        .options = {required(output("HDF5 file to write")), flag("force", "replace an existing file"),
                    choice("format", {"csv", "extxyz", "lammps"}, "format of the file; by its ending when not given", ""),
                    particle_radius("radius of every particle; a column of the file when not given"),
                    text("box", "L|LX,LY,LZ", "edge lengths of the periodic box [unit m; range " + physical::length.text() + "]"),
                    flag("open", "the set has a free surface: no periodic box"),
                    quantity("length-unit", "m", "length of one unit of columns that name no unit", "", physical::length),
                    flag("wrap", "bring particles outside the periodic box back in; otherwise they are an error")},
        .run = run};
}

}  // namespace coagula::tools
