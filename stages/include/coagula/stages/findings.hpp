// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a stage.
#pragma once

#include <coagula/io/structure_file.hpp>
#include <coagula/report/results.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

using report::check_finite;
using report::describe;
using report::Json;
using report::Results;
using report::Table;
using report::to_json;
using report::with_unit;

/// Results of a stage for the file, for programs and for people.
struct Findings {
    std::string group;  ///< in the file
    Results results;
    std::vector<io::ParticleField> fields = {};
    Table table = {};
    Results bond_results = {};  ///< one value per bond each: for the file only
    std::vector<io::BondField> bond_fields = {};
    std::string engine = {};              ///< another program that computed them, with its version; empty: none
    std::vector<std::string> notes = {};  ///< sentences that a user should know
};

/// What is printed about a call.
struct Printed {
    Json json;
    Table table;
};

/// The groups of a file that these results take the place of: of a characterization those of what was measured, otherwise all of
/// it.
std::vector<std::string> replaced_groups(const Findings& found);

/// What a stage adds to the file of a structure. @param bonds that the stage took.
io::Addition addition_of(const Findings& found, const std::optional<ContactNetwork>& bonds, const io::Provenance& provenance);

}  // namespace coagula::stages
