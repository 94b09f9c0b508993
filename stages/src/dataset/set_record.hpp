// SPDX-License-Identifier: GPL-3.0-or-later
// What the index of a set says about one structure, and the columns that many of them make.
#pragma once

#include <coagula/stages/dataset.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

struct SetValue {
    double value = unset;
    bool whole = false;
    std::string unit = {};
    std::string description = {};
};

struct SetRecord {
    std::string id;
    bool done = false;                                           ///< else it failed
    std::string message = {};                                    ///< why it failed
    std::string version = {};                                    ///< of the program that computed it
    std::string sha256 = {};                                     ///< of the structure
    std::vector<std::pair<std::string, SetValue>> results = {};  ///< by the name of their column
};

/// Appends the single numbers of a stage as columns: those of a generator begin with "generation.", those of shear have the names
/// of its JSON object, with "shear." in front where a measure has that name.
void append_results(SetRecord& record, const Findings& found);

std::string record_text(const SetRecord& record);
/// Nothing for a text that is none.
std::optional<SetRecord> record_from(const std::string& text);

/// The records in an index, by their ids.
std::map<std::string, SetRecord> records_in(const io::SetHead& set);

/// The columns of the index: id, status, message, the options that vary, results, version and checksum.
std::vector<io::SetColumn> index_of(const std::vector<SetRow>& rows, const std::map<std::string, SetRecord>& records);

/// All of a set but its structures. @param records one for each row.
io::SetHead head_of(const Sweep& sweep, const std::map<std::string, SetRecord>& records);

}  // namespace coagula::stages
