// coagula export: coordinates (and bonds) as text for other programs.
#include "cli/output_file.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

#include <filesystem>

namespace coagula::tools {

namespace {

struct Format {
    io::TextFormat format;
    std::string ending;
};

Format format_named(const std::string& name) {
    if (name == "csv") {
        return {io::TextFormat::csv, ".csv"};
    }
    if (name == "extxyz") {
        return {io::TextFormat::extended_xyz, ".extxyz"};
    }
    return {io::TextFormat::lammps_data, ".data"};
}

void run(const Arguments& arguments) {
    const Format format = format_named(arguments.text("format"));
    const std::string beside = std::filesystem::path(arguments.input()).replace_extension(format.ending).string();
    const std::string output = arguments.text("output", beside);
    const io::Structure structure = io::read_structure(arguments.input());
    check_output(output, arguments.flag("force"));
    io::write_text(output, format.format, structure.packing, structure.bonds, arguments.flag("force"));
    const Json json = {{"output", output}, {"format", arguments.text("format")}, {"particles", structure.packing.size()}};
    report(arguments, json, {{"particles", std::to_string(structure.packing.size())}, {"written to", output}});
}

}  // namespace

Verb export_verb() {
    return {.name = "export",
            .summary = "write the coordinates as extended XYZ, LAMMPS data or CSV",
            .input = "FILE.h5",
            .options = {required(choice("format", {"extxyz", "lammps", "csv"}, "format of the text file", "")),
                        output("file to write; beside the input when not given"), flag("force", "replace an existing file")},
            .run = run};
}

}  // namespace coagula::tools
