// SPDX-License-Identifier: GPL-3.0-or-later
// Check of the base model of the sample against the rest of the experiment.
#pragma once

#include <coagula/diagnose/measurement.hpp>

namespace coagula::diagnose {

/// Throws InputError when something in the experiment needs another material.
void check_material(const Experiment& experiment);

}  // namespace coagula::diagnose
