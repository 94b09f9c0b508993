// SPDX-License-Identifier: GPL-3.0-or-later
// The frequencies of --frequency and --frequency-sweep.
#pragma once

#include <coagula/stages/arguments.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// "1Hz,10Hz,2kHz" in Hz. Throws InputError for a frequency that is none or not positive.
std::vector<double> parse_frequency_list(const std::string& text);

/// "0.1Hz:1kHz:20": from the first to the second in so many logarithmic steps, ends included.
std::vector<double> parse_frequency_sweep(const std::string& text);

/// Frequencies asked for [Hz]; empty when neither option was given.
std::vector<double> frequencies_of(const Arguments& arguments);

}  // namespace coagula::stages
