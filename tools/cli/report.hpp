// SPDX-License-Identifier: GPL-3.0-or-later
// Output of a verb: one JSON object, or a short table. Both are made from the data sets that go into the file.
#pragma once

#include "stages.hpp"

#include <coagula/common/cell.hpp>

namespace coagula::tools {

/// Throws std::runtime_error when standard output takes no more.
void flush_output();

/// The lengths of the edges of a box [m], and their vectors, one per row.
Json box_lengths(const Cell& cell);
Json box_edges(const Cell& cell);

/// Prints the JSON object (--json), nothing (--quiet) or the table. Throws std::runtime_error when standard output takes no more.
void report(const Arguments& arguments, const Json& json, const Table& table);

}  // namespace coagula::tools
