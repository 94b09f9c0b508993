// SPDX-License-Identifier: GPL-3.0-or-later
// The finished orientations of `coagula shear --method quasistatic`, from which a killed run goes on.
#pragma once

#include <coagula/mechanics/quasistatic.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// A ramp or a sweep in one orientation; the other one is empty.
struct QuasistaticTest {
    mechanics::ShearOrientation orientation;
    mechanics::RampResponse ramp;
    mechanics::SweepResponse sweep;
};

/// Writes what the results are made of by temporary file and rename; not the loops of a sweep and the effort of the solver.
/// @param signature text that tells runs apart: options and structure.
void write_quasistatic_checkpoint(const std::string& path, const std::string& signature,
                                  const std::vector<QuasistaticTest>& finished);

/// Throws InputError when the file is no checkpoint, is damaged or belongs to another run.
std::vector<QuasistaticTest> read_quasistatic_checkpoint(const std::string& path, const std::string& signature);

}  // namespace coagula::stages
