// SPDX-License-Identifier: GPL-3.0-or-later
// What images of the centres of particles show: neighbours in shells, and how images of the same particles differ.
#pragma once

#include "observations.hpp"

#include <cstddef>
#include <vector>

namespace coagula::diagnose {

/// Needs the particle radius. Throws InputError when no particles of this radius could be at the coordinates.
std::vector<Observation> seen_in_images(const Experiment& experiment, std::size_t number);

/// What images of the same particles, so many centres each, would show: the values are still to be measured.
std::vector<Observation> planned_images(std::size_t measurement, double centres);

}  // namespace coagula::diagnose
