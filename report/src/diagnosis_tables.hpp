// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of a diagnosis report about a table, beside its figures.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>

#include <string>

namespace coagula::report {

/// Kind, sample and what was special about it: "amplitude-sweep · sample A · under a cone of 1°".
std::string conditions_of(const diagnose::Measurement& table);

/// Differences between images of the same particles, measured and by both models, as HTML; empty where the table has one image.
/// @param cause name of the best cause; empty: there is none, and the base model stands alone.
std::string image_table(const diagnose::Diagnosis& diagnosis, std::size_t number, const std::string& cause);

}  // namespace coagula::report
