// SPDX-License-Identifier: GPL-3.0-or-later
// The grid of contacts and bonding distances at whose nodes the linear solver runs.
#pragma once

#include "interpolation.hpp"

#include <coagula/diagnose/settings.hpp>

namespace coagula::diagnose {

/// Nodes, uniform in the logarithm. Bending below its lowest node is off.
constexpr NodeAxis ratio_axis{0.02, 2.0, 9};
constexpr NodeAxis bending_axis{1e-6, 0.2, 12};
constexpr NodeAxis tolerance_axis{5e-4, 0.08, 12};

/// A positive quantity of the network at these settings, between the nodes.
/// @param at the quantity at a node, which has a stiffness ratio, a bending ratio and a bond tolerance of its own.
template <class At>
double between_nodes(const Settings& settings, const At& at) {
    Settings node;
    const auto over_tolerance = [&] {
        return settings.bond_tolerance == Settings{}.bond_tolerance
                   ? at(node)
                   : interpolate(tolerance_axis, settings.bond_tolerance, [&](double tolerance) {
                         node.bond_tolerance = tolerance;
                         return at(node);
                     });
    };
    const auto over_bending = [&] {
        node.bending_ratio = 0;
        return settings.bending_ratio < bending_axis.low ? over_tolerance()
                                                         : interpolate(bending_axis, settings.bending_ratio, [&](double bending) {
                                                               node.bending_ratio = bending;
                                                               return over_tolerance();
                                                           });
    };
    return settings.stiffness_ratio == node.stiffness_ratio ? over_bending()
                                                            : interpolate(ratio_axis, settings.stiffness_ratio, [&](double ratio) {
                                                                  node.stiffness_ratio = ratio;
                                                                  return over_bending();
                                                              });
}

}  // namespace coagula::diagnose
