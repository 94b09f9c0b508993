// SPDX-License-Identifier: GPL-3.0-or-later
// Statements of a [[measurement]] about the run: sample, order and times, plates, what is between them.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/io/measured_file.hpp>

#include "toml_keys.hpp"

#include <cstddef>

namespace coagula::experiment {

/// A table without columns that says what all tables of one [[measurement]] share. Throws InputError.
diagnose::Measurement read_setting(TomlKeys& keys, std::size_t number);

/// A table in this setting: its kind, its name and its cells.
diagnose::Measurement in_setting(diagnose::Measurement setting, diagnose::Measurement table);

/// Order and start of a table that was chosen as one of a range: it follows the first of them, which alone begins at the start
/// that is stated. Where no time is stated, each begins at the date that its export says, unless rows before it are not meant.
void place_in_range(diagnose::Measurement& measurement, const io::PlainTable& chosen, const io::PlainTable& first,
                    bool from_first_row);

}  // namespace coagula::experiment
