// SPDX-License-Identifier: GPL-3.0-or-later
// Structures from and for other programs, and figures, pages and tables of result files.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/findings.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

Verb import_verb();
/// A structure from a file of another program as the options say.
io::Structure import_structure(const Arguments& arguments);

Verb export_verb();
/// Writes a structure for other programs, in the format that the ending of the name says. Throws InputError for others.
void export_structure(const std::string& path, const io::Structure& structure, bool overwrite);
/// Writes the structure of a file as the options say.
Printed export_file(const Arguments& arguments);

Verb plot_verb();
/// Draws the figure, or those of the paper, into the file or folder that the options name.
Printed plot_files(const Arguments& arguments);

Verb report_verb();
/// Writes the page of the structures.
Printed report_files(const Arguments& arguments);

/// The table of `coagula info --csv`: the headings with their units, and one row for each file.
std::vector<std::vector<std::string>> table_of_files(const std::vector<std::string>& paths);

}  // namespace coagula::stages
