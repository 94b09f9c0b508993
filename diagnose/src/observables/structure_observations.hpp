// SPDX-License-Identifier: GPL-3.0-or-later
// Tables show the structure by neighbours in shells, by how images of the same particles differ, and by pores. All of these need
// the particle radius.
#pragma once

#include "observations.hpp"

#include <cstddef>
#include <vector>

namespace coagula::diagnose {

/// Throws InputError when no particles of this radius could be at the coordinates.
std::vector<Observation> seen_in_images(const Experiment& experiment, std::size_t number);

/// Lists the observations that images of the same particles, so many centres each, would give: their values are still to be
/// measured.
std::vector<Observation> planned_images(std::size_t measurement, double centres);

/// The rows of a table of kind pore-curve with a probability between 0.01 and 1, ends excluded: at r = 0 all structures agree, and
/// beyond 0.01 one largest pore decides. Standard errors that are not stated are those of a curve sampled in a hundred thousand
/// points.
std::vector<Observation> pores_in(const Experiment& experiment, std::size_t number);

}  // namespace coagula::diagnose
