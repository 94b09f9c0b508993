// Results of `coagula shear --method dem` as data sets and a table.
#pragma once

#include "cli/report.hpp"

#include <coagula/mechanics/rheometer.hpp>

namespace coagula::tools {

/// Moduli, oscillations, samples and broken bonds below /mechanics/dem.
Results datasets_of(const mechanics::RheometerResult& result, const mechanics::RheometerOptions& options, double bond_tolerance);

Table table_of(const mechanics::RheometerResult& result, const mechanics::RheometerOptions& options);

}  // namespace coagula::tools
