// SPDX-License-Identifier: GPL-3.0-or-later
// Results that replace others of the same group, and the conditions that tell whether they are the same measurement again.
#pragma once

#include <coagula/common/dataset.hpp>

#include <string>
#include <vector>

namespace coagula::io {

/// Throws ExistsAlready, with the conditions that differ, when the file holds results in `group` that were found under other
/// conditions than `results`: other data sets below GROUP/conditions, or none at all. Results without conditions may replace any.
void check_conditions(const std::string& path, const std::string& group, const std::vector<Dataset>& results);

}  // namespace coagula::io
