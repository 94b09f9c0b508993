// SPDX-License-Identifier: GPL-3.0-or-later
// Data sets: many structures made, measured and sheared as one sweep file says (docs/reference/sweep-file.md).
#pragma once

#include <coagula/common/progress.hpp>
#include <coagula/io/set_file.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/findings.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace coagula::stages {

/// One structure of a set: the options of its stages, checked.
struct SetRow {
    std::string id;                         ///< follows from the options alone
    std::string made_of;                    ///< equal for rows that share a generated structure
    std::string trajectory;                 ///< equal for rows whose structures lie on one trajectory
    double stop;                            ///< where on it; 0 on none
    Arguments generate;                     ///< of a generator
    std::optional<Arguments> characterize;  ///< none: the structure is not measured
    std::optional<Arguments> shear;         ///< none: it is not sheared
    bool whole = true;                      ///< its file holds what the stages found, else the particles alone
};

struct Sweep {
    std::string path = {};
    std::string text = {};                                       ///< of the file
    std::vector<std::pair<std::string, std::string>> card = {};  ///< title, authors and what else the file says of the set
    std::vector<SetRow> rows = {};
    bool characterized = false;
    bool sheared = false;
};

/// Reads a sweep file and checks every option of every structure. Throws InputError with a sentence that names file, key and rule.
Sweep read_sweep(const std::string& path);
/// Reads a sweep from its text. @param path names the file in messages; files in the sweep are named from its folder.
Sweep parse_sweep(const std::string& text, const std::string& path);

struct SetRun {
    std::string output;
    int jobs = 0;                 ///< processes at a time; 0: as many as processors
    double memory = 0;            ///< budget of all of them together [byte]; 0: no limit
    bool keep_structures = true;  ///< else the set has an index only
    bool retry = false;           ///< structures that failed before are tried again
    bool drop = false;            ///< structures of an existing set that the sweep does not name are left out of the new one
    std::optional<std::pair<std::size_t, std::size_t>> chunk = {};  ///< number (from 1) and count: only this part of the rows
};

Verb dataset_run_verb();
SetRun set_run(const Arguments& arguments);
/// Computes what is missing and writes the set. Its bytes follow from the sweep and the version of the program alone.
Printed run_sweep(const Sweep& whole, const SetRun& run, const Progress& progress);

Verb dataset_plan_verb();
/// How many structures a sweep has, and what they take; a few structures of each generator are computed to tell.
Printed plan_sweep(const Sweep& sweep, const SetRun& run, const Progress& progress);

Verb dataset_table_verb();
/// The index as rows of a table, units in the headings.
std::vector<std::vector<std::string>> table_of_set(const io::SetHead& set);

Verb dataset_verify_verb();
/// Compares the checksums of all structures, and computes some of them again. Throws InputError where one differs.
/// @param sample how many are computed again.
Printed verify_set(const std::string& path, std::int64_t sample, const Progress& progress);

Verb dataset_join_verb();
/// Joins sets of the same sweep into one.
Printed join_sets(const std::vector<std::string>& paths, const std::string& output, bool overwrite);

Verb dataset_workflow_verb();
/// Writes a workflow of Snakemake that makes the set in chunks. @param folder where it goes. @param chunks at least 1.
Printed write_workflow(const Sweep& sweep, const std::string& folder, std::int64_t chunks, bool overwrite);

}  // namespace coagula::stages
