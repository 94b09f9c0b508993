// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a sample is a liquid, whatever stands for it.
#pragma once

#include <coagula/diagnose/measurement.hpp>

namespace coagula::experiment {

/// A frequency sweep over half a decade or more in which G'' is ten times |G'| or more in most rows and grows in proportion to the
/// frequency, to a tenth of the exponent.
bool looks_newtonian(const diagnose::Measurement& table);

}  // namespace coagula::experiment
