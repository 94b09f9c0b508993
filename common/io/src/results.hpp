// SPDX-License-Identifier: GPL-3.0-or-later
// Results and history as datasets of a structure file.
#pragma once

#include <coagula/io/structure_file.hpp>

#include "hdf5_file.hpp"

namespace coagula::io {

/// The values of all datasets below a group, sorted by path, without units and descriptions.
std::vector<Dataset> values_in(const hdf5::File& file, const std::string& group);

/// All datasets below a group, sorted by path.
std::vector<Dataset> results_in(const hdf5::File& file, const std::string& group);

/// The history, oldest first, from the datasets below /provenance.
std::vector<Provenance> history_of(const std::vector<Dataset>& datasets);

/// Writes a dataset, replacing one of the same path. Throws std::invalid_argument when the shape does not fit the values.
void write_dataset(hdf5::File& file, const Dataset& dataset);

/// Appends an entry to /provenance.
void write_provenance(hdf5::File& file, const Provenance& entry);

}  // namespace coagula::io
