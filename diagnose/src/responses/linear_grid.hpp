// The grid of contacts and bonding distances at whose nodes the linear solver runs.
#pragma once

#include "interpolation.hpp"

#include <coagula/diagnose/settings.hpp>

namespace coagula::diagnose {

/// Nodes, uniform in the logarithm. Bending below its lowest node is off.
constexpr Axis ratio_axis{0.02, 2.0, 9};
constexpr Axis bending_axis{1e-6, 0.2, 12};
constexpr Axis tolerance_axis{5e-4, 0.08, 12};

/// A positive quantity of the network at these settings, between the nodes.
/// @param at the quantity for a stiffness ratio, a bending ratio and a bond tolerance; called at nodes only.
template <class At>
double between_nodes(const Settings& settings, const At& at) {
    const Settings base;
    const auto over_tolerance = [&](double ratio, double bending) {
        if (settings.bond_tolerance == base.bond_tolerance) {
            return at(ratio, bending, base.bond_tolerance);
        }
        return interpolate(tolerance_axis, settings.bond_tolerance,
                           [&](double tolerance) { return at(ratio, bending, tolerance); });
    };
    const auto over_bending = [&](double ratio) {
        if (settings.bending_ratio < bending_axis.low) {
            return over_tolerance(ratio, 0);
        }
        return interpolate(bending_axis, settings.bending_ratio, [&](double bending) { return over_tolerance(ratio, bending); });
    };
    return settings.stiffness_ratio == base.stiffness_ratio ? over_bending(base.stiffness_ratio)
                                                            : interpolate(ratio_axis, settings.stiffness_ratio, over_bending);
}

}  // namespace coagula::diagnose
