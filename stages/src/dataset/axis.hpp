// SPDX-License-Identifier: GPL-3.0-or-later
// The values that an option of a sweep takes.
#pragma once

#include <coagula/stages/arguments.hpp>

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

/// A range between whose ends a space-filling design chooses.
struct OpenRange {
    double from = 0;
    double to = 1;
    bool logarithmic = false;
    bool whole = false;

    /// The value at a place between 0 and 1.
    Given at(double place) const;
};

/// An option with several values: a list, or a range.
struct Axis {
    std::string option;
    std::vector<Given> values = {};       ///< of a list, or of a range in steps
    std::optional<OpenRange> range = {};  ///< of a range without steps

    /// The value at a place between 0 and 1; a list is divided into equal parts.
    Given at(double place) const;
};

/// Throws InputError ("WHERE, key 'OPTION': rule") for what is neither a value, nor a list, nor a range.
/// @param where names the file and its table. @param stepped whether a range needs its number of steps.
Axis read_axis(const toml::node& node, const Option& option, const std::string& where, bool stepped);

}  // namespace coagula::stages
