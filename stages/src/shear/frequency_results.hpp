// SPDX-License-Identifier: GPL-3.0-or-later
// Results of `coagula shear --frequency` as data sets and a table.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/mechanics/frequency.hpp>

namespace coagula::stages {

/// Arrays over the frequencies below /mechanics/frequency.
Results datasets_of(const mechanics::FrequencyResponse& response, double bond_tolerance, const ContactModel& model);

Table table_of(const mechanics::FrequencyResponse& response);

}  // namespace coagula::stages
