// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in which the stress is set and the strain follows.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <vector>

namespace coagula::diagnose {

/// Whether a table says so or, without a word, whether in most of its steps from row to row the stress stays as it is while the
/// strain does not. The stress is that of a column, else the torque, else strain times |G*|.
bool is_stress_controlled(const Measurement& table);

/// What is set in each row, as a strain: the strain itself or, where the stress is set, that over the middle ratio of stress and
/// strain of the table. The strain of an amplitude sweep is its axis in any case. NaN where it is not known.
std::vector<double> set_strains(const Measurement& table);

}  // namespace coagula::diagnose
