// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `coagula report` for a data set: its index as a table and as figures of any two columns, in one file that needs no
// other.
#pragma once

#include <coagula/io/set_file.hpp>

#include <string>

namespace coagula::report {

/// A data set as its page shows it.
struct PageSet {
    std::string name;  ///< as the page calls it, such as the name of its file
    io::SetHead head;
    bool holds_structures = true;  ///< not only their index
};

/// HTML. Throws std::runtime_error when the program was built without the scripts of the pages (scripts/bundle-web).
std::string set_page(const PageSet& set, const std::string& version);

}  // namespace coagula::report
