// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges in logarithmic steps on the command line.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace coagula::stages {

/// "0.1Hz:1kHz:20": from the first to the second in so many logarithmic steps, ends included.
/// @param value reads one end, > 0. @param example of such a text.
/// Throws InputError for a text of another form.
std::vector<double> parse_logarithmic_sweep(const std::string& text, const std::function<double(const std::string&)>& value,
                                            const std::string& example);

}  // namespace coagula::stages
