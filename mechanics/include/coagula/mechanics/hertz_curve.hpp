// SPDX-License-Identifier: GPL-3.0-or-later
// Resistance of Hertz contacts with a load at rest to a growing strain.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <vector>

namespace coagula::mechanics {

/// Stress over strain of a network of Hertz contacts in equilibrium, over that of the linear springs that LinearOptions has by
/// default; mean over the three planes and both directions of the strain. In one direction alone a small structure stiffens or
/// softens at first, as chance will have it; over an oscillation that cancels.
///
/// @param contact Hertz contacts that are as stiff as those springs at the overlap `preload`.
/// @param preload overlap of every contact at rest over the mean radius.
/// @param loads strains over `preload`, growing: nothing else counts.
std::vector<double> hertz_curve(const Packing& packing, const ContactNetwork& bonds, const ContactModel& contact, double preload,
                                const std::vector<double>& loads, const Progress& progress = {});

}  // namespace coagula::mechanics
