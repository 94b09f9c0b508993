// SPDX-License-Identifier: GPL-3.0-or-later
// The causes that a diagnosis knows.
#pragma once

#include <coagula/report/results.hpp>

#include <string>

namespace coagula::report {

/// The catalogue as a table in Markdown.
std::string catalogue_table();

/// The same as an array of objects.
Json catalogue_json();

}  // namespace coagula::report
