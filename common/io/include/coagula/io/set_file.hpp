// SPDX-License-Identifier: GPL-3.0-or-later
// A data set of many structures in one file: an index of columns, the structures in the layout of single files, and its card.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/io/structure_file.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace coagula::io {

/// A column of the index, with one value for each structure.
struct SetColumn {
    using Values = std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

    std::string name;
    std::string unit = "1";
    std::string description = {};
    Values values = {};

    std::size_t size() const;
};

/// Where a structure of a set lies while the set is put together: a file of its own, or a group of a set.
struct SetStructure {
    std::string id;
    std::string file;
    std::string group = "/";
};

struct SetHead {
    std::vector<std::pair<std::string, std::string>> card = {};        ///< attributes of the file: title, authors, licence ...
    std::string sweep = {};                                            ///< text of the sweep file
    std::vector<std::pair<std::string, std::string>> provenance = {};  ///< name and text of each entry
    std::vector<SetColumn> index = {};                                 ///< equally long

    /// The column of this name; null where there is none.
    const SetColumn* column(const std::string& name) const;
};

/// Writes the set beside and renames it. Its data sets follow from the arguments alone; its bytes also from where structures are
/// copied from.
void write_set(const std::string& path, const SetHead& head, const std::vector<SetStructure>& structures, bool overwrite);

/// Whether a file is a data set of many structures. Throws InputError for a file that is not there or is no HDF5.
bool is_set(const std::string& path);

/// Throws InputError for a file that is no data set.
SetHead read_set(const std::string& path);

/// The ids of the structures that the set holds, sorted; fewer than rows of its index where it was written without them.
std::vector<std::string> structures_in_set(const std::string& path);

/// Writes one structure of a set as a file of its own. Throws InputError where the set does not hold it.
void extract_structure(const std::string& set, const std::string& id, const std::string& path, bool overwrite);

/// Writes the file of one structure, from which a set is put together, as write_structure does; over one of its name.
/// @return SHA-256 of all its data sets in the order of their paths, the history left out (hexadecimal).
std::string write_part(const std::string& path, const Structure& structure, const std::vector<Dataset>& results,
                       const Provenance& provenance, const std::vector<Addition>& later);

/// The SHA-256 of all structures of a set, as write_part gives it, by their ids.
std::vector<std::pair<std::string, std::string>> structure_sums(const std::string& set);

/// The packing as it is read again after it was written: lengths go through nanometres.
Packing packing_as_stored(const Packing& packing);

/// The group of a structure in a set.
std::string group_of_structure(const std::string& id);

}  // namespace coagula::io
