// SPDX-License-Identifier: GPL-3.0-or-later
// Linear modulus under a tension in all contacts: the linear solver with the geometric stiffness, at the nodes of a grid.
#pragma once

#include "response.hpp"

namespace coagula::diagnose {

/// G under a tension in all contacts over G without it, at vanishing strain.
/// @param exact run the solver at the tension itself.
double prestress_response(Simulator& simulator, const Settings& settings, std::size_t group = 0, bool exact = false);

Response prestressed_contacts();

}  // namespace coagula::diagnose
