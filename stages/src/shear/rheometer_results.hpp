// SPDX-License-Identifier: GPL-3.0-or-later
// Results of `coagula shear --method dem` as data sets and a table.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/mechanics/rheometer.hpp>

namespace coagula::stages {

/// Moduli, oscillations, samples and broken bonds below /mechanics/dem.
Results datasets_of(const mechanics::RheometerResult& result, const mechanics::RheometerOptions& options, double bond_tolerance);

Table table_of(const mechanics::RheometerResult& result, const mechanics::RheometerOptions& options);

}  // namespace coagula::stages
