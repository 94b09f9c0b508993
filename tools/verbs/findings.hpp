// Results of a verb.
#pragma once

#include "cli/report.hpp"

#include <coagula/io/structure_file.hpp>

#include <string>
#include <vector>

namespace coagula::tools {

/// Results of a verb for the file, for programs and for people.
struct Findings {
    std::string group;  ///< in the file
    Results results;
    std::vector<io::ParticleField> fields = {};
    Table table = {};
    Results bond_results = {};  ///< one value per bond each: for the file only
    std::vector<io::BondField> bond_fields = {};
    std::vector<std::string> notes = {};  ///< sentences that a user should know
};

/// The groups of a file that these results take the place of: of a characterization those of what was measured, otherwise all of
/// it.
std::vector<std::string> replaced_groups(const Findings& found);

}  // namespace coagula::tools
