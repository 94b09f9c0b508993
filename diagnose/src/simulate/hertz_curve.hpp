// Resistance of Hertz contacts with a load at rest to a growing strain.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include "interpolation.hpp"

#include <vector>

namespace coagula::diagnose {

/// Strain over the overlap at rest (over r0); the curve dips at 2 and then rises, which nodes half a decade apart would miss by 1
/// %.
constexpr Axis hertz_axis{0.177827941, 100, 12};

/// Stress over strain of a network of Hertz contacts in equilibrium, over that of linear springs of the base model that are as
/// stiff as the contacts at rest; mean over the three planes and both directions of the strain. In one direction alone a small
/// structure stiffens or softens at first, as chance will have it; over an oscillation that cancels.
///
/// @param loads strains over the overlap at rest (over the mean radius), growing: nothing else counts.
std::vector<double> hertz_curve(const Packing& packing, const ContactNetwork& bonds, const std::vector<double>& loads,
                                const Progress& progress = {});

}  // namespace coagula::diagnose
