// SPDX-License-Identifier: GPL-3.0-or-later
// Results as data sets of a file, as a JSON object and as a short table for people.
#pragma once

#include <coagula/common/readable.hpp>
#include <coagula/io/structure_file.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace coagula::report {

using Json = nlohmann::ordered_json;
using Results = std::vector<io::Dataset>;

/// The values of one data set: a number, a text, or (nested) arrays; what is not a finite number becomes null.
Json to_json(const io::Dataset& dataset);

/// Data sets below `group` as nested objects: "/characterization/doh/a" is {"doh": {"a": ...}}.
Json to_json(const Results& results, const std::string& group);

/// To be asked before anything is written: throws std::runtime_error for a number that is not finite, unless the description of its
/// data set says what "NaN" means there.
void check_finite(const Results& results);

/// The same of results that are printed only. What may be missing is null in `json` already.
void check_finite(const Json& json);

using coagula::describe;
using coagula::Table;
using coagula::with_unit;

}  // namespace coagula::report
