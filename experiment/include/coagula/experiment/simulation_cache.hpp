// SPDX-License-Identifier: GPL-3.0-or-later
// What was simulated before, as a text file: one line per result, key, tab, numbers, tab, checksum of what stands before.
#pragma once

#include <coagula/diagnose/simulator.hpp>

#include <filesystem>
#include <string>

namespace coagula::experiment {

/// Empty when there is no such file. Throws InputError when a line does not have the checksum with which it was written: a number
/// that is not the one that was simulated changes a diagnosis.
diagnose::SimulationCache read_cache(const std::filesystem::path& path);
/// The text of such a file. Results that are not finite are left out, so that they are simulated again.
std::string cache_text(const diagnose::SimulationCache& cache);

}  // namespace coagula::experiment
