// SPDX-License-Identifier: GPL-3.0-or-later
// coagula info --csv: one row per file.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/io/structure_file.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// Rows of a table whose columns are the recipe and all scalar results that any of its files has, with the unit in the heading.
/// Options of the generator have their own names ("target-coordination"), which no result has: those are joined by underscores.
class InfoRows {
public:
    void add(const std::string& path, const io::Contents& contents);

    /// The header and one row per file; a field is empty where a file has no such result or no number in it.
    std::vector<std::vector<std::string>> with_header() const;

private:
    void put_recipe(const std::string& path, const io::Contents& contents);
    void put(const std::string& heading, const std::string& unit, const std::string& text);

    std::vector<std::string> headings_;  ///< in the order of their first file
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace coagula::stages
