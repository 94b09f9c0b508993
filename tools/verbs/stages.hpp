// The computations of the verbs without their files, for the verbs themselves and for the Python module.
#pragma once

#include "cli/arguments.hpp"
#include "findings.hpp"

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>
#include <coagula/mechanics/power_law.hpp>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace coagula::tools {

/// A structure that a generator made, and what is known of it.
struct Generated {
    io::Structure structure;
    Findings findings;
};

/// @param radii N radii [m] instead of those that the options say; empty: none.
Generated generate_vem(const Arguments& arguments, const Eigen::VectorXd& radii, const Progress& progress);

/// @param start go on from this packing instead of a suspension. @param radii as above.
Generated generate_brownian(const Arguments& arguments, const std::optional<Packing>& start, const Eigen::VectorXd& radii,
                            const Progress& progress);

Findings characterize_packing(const Arguments& arguments, const Packing& packing, const Progress& progress);

/// The object that `coagula characterize --compare` prints, without its time.
Json compare_packings(const Arguments& arguments, const std::array<std::string, 2>& names, const std::array<Packing, 2>& packings,
                      const Progress& progress);

/// Response of the network that is bonded as the options say, and that network.
struct Sheared {
    ContactNetwork bonds;
    Findings findings;
};
Sheared shear_packing(const Arguments& arguments, const Packing& packing, const Progress& progress);

/// The object that `coagula calibrate` prints. @param names of the structures, one each.
Json calibrate_packings(const Arguments& arguments, const std::vector<std::string>& names, const std::vector<Packing>& packings,
                        const Progress& progress);

/// The object that `coagula fit power-law` prints.
Json fit_power_law(const Arguments& arguments, const mechanics::PowerLawData& data, const Progress& progress);

/// A structure from a file of another program as the options say.
io::Structure import_structure(const Arguments& arguments);

/// Writes a structure for other programs, in the format that the ending of the name says. Throws InputError for others.
void export_structure(const std::string& path, const io::Structure& structure, bool overwrite);

/// Output of `coagula plot` and `coagula report` about the file that they wrote.
struct Printed {
    Json json;
    Table table;
};
/// Draws the figure, or those of the paper, into the file or folder that the options name.
Printed plot_files(const Arguments& arguments);
/// Writes the page of the structures.
Printed report_files(const Arguments& arguments);

/// The table of `coagula info --csv`: the headings with their units, and one row for each file.
std::vector<std::vector<std::string>> table_of_files(const std::vector<std::string>& paths);

/// The object of diagnosis.json. @param folder where everything goes that `coagula diagnose` writes; empty: nothing is written.
Json diagnose_experiment(const Arguments& arguments, const std::string& folder, const Progress& progress);

}  // namespace coagula::tools
