// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `coagula report`: structures in three dimensions and every result of their files, in one file that needs no other.
#pragma once

#include <coagula/characterize/largest_pores.hpp>
#include <coagula/io/structure_file.hpp>

#include <string>
#include <vector>

namespace coagula::report {

/// One structure of the page.
struct PageStructure {
    std::string name;  ///< as the page calls it, such as the name of its file
    io::Structure structure;
    bool bonds_in_file = true;              ///< false: `structure.bonds` are contacts found for the page
    std::vector<io::Dataset> fields;        ///< one value or vector for each particle
    std::vector<io::Dataset> results;       ///< below /characterization and /mechanics
    std::vector<io::Provenance> history;    ///< oldest first
    characterize::LargestPores pores = {};  ///< drawn as translucent spheres; may be empty
};

/// HTML. Numbers for each particle and bond go in with single precision. Throws std::runtime_error when the program was built
/// without the scripts of the pages (scripts/bundle-web).
std::string structure_page(const std::vector<PageStructure>& structures, const std::string& version);

}  // namespace coagula::report
