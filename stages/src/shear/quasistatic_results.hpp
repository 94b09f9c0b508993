// SPDX-License-Identifier: GPL-3.0-or-later
// What quasi-static tests write and print: sweeps and ramps of shear below /mechanics/quasistatic, uniaxial compression below
// /mechanics/compression.
#pragma once

#include "quasistatic_checkpoint.hpp"

#include <coagula/stages/findings.hpp>

#include <vector>

namespace coagula::stages {

/// @param amplitudes asked for; what was not reached because the network failed is NaN.
void append_sweeps(Results& results, const std::vector<QuasistaticTest>& tests, const std::vector<double>& amplitudes);

void append_ramps(Results& results, const std::vector<QuasistaticTest>& tests);

/// Signs of soil mechanics: compression and pressure are positive.
void count_compression_positive(QuasistaticTest& test);

/// Ramps of uniaxial strain, compression positive. @param volume_fraction before the compression.
void append_compressions(Results& results, const std::vector<QuasistaticTest>& tests, double volume_fraction);

/// A row for each amplitude, or for the end of each ramp.
Table table_of_tests(const std::vector<QuasistaticTest>& tests, bool sweep);

}  // namespace coagula::stages
