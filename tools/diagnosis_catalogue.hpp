// The causes that a diagnosis knows, as a table.
#pragma once

#include "cli/arguments.hpp"

namespace coagula::tools {

/// Prints the catalogue as a table in Markdown, or with --json as an array of objects.
void print_catalogue(const Arguments& arguments);

}  // namespace coagula::tools
