// Cache of simulations as a text file: one line per result, with key, tab and numbers.
#pragma once

#include <coagula/diagnose/simulator.hpp>

#include <filesystem>
#include <string>

namespace coagula::experiment {

/// Empty when there is no such file. Throws InputError when a line is not whole: what is lost of a number changes a diagnosis.
diagnose::SimulationCache read_cache(const std::filesystem::path& path);
/// The text of such a file. Results that are not finite are left out, so that they are simulated again.
std::string cache_text(const diagnose::SimulationCache& cache);

}  // namespace coagula::experiment
