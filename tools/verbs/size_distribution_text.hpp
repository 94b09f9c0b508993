// The option --size-distribution: "monodisperse", "normal:0.1", "lognormal:0.2" or the name of a table.
#pragma once

#include <coagula/generators/size_distribution.hpp>

#include <optional>
#include <string>

namespace coagula::tools {

/// A table is CSV with the columns "radius [unit]" and "fraction" (share of the particles, any scale).
/// @param mean_radius of the particles [m]; not used with a table.
/// Throws InputError that names the option, or the file and line of a table.
generators::SizeDistribution parse_size_distribution(const std::string& text, std::optional<double> mean_radius);

}  // namespace coagula::tools
