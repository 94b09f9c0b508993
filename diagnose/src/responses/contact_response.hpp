// SPDX-License-Identifier: GPL-3.0-or-later
// Amplitude response of Hertz contacts that are loaded at rest, between the nodes of a grid of strains.
#pragma once

#include "response.hpp"

namespace coagula::diagnose {

/// G' / G at amplitude gamma_0, G that of linear springs: equilibrium under the strain by secant stiffnesses, which depends on
/// strain over overlap at rest alone. What unloading loses by micro-slip is not in it.
double contact_response(Simulator& simulator, const Settings& settings, double amplitude);

/// The same for the stress over the strain at a momentary strain.
double contact_secant(Simulator& simulator, const Settings& settings, double strain);

/// Tells how contact_response changes, relative to itself, with one standard error of each independent error (hertz_scatter.hpp).
Eigen::RowVectorXd contact_errors(Simulator& simulator, const Settings& settings, double amplitude);
/// Degrees of freedom from which their common scale is known.
double contact_degrees(Simulator& simulator);

Response hertz_contacts();

}  // namespace coagula::diagnose
