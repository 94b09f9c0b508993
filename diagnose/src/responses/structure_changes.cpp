// SPDX-License-Identifier: GPL-3.0-or-later
// Causes that change the structures themselves: the same simulation with structures made again.
#include "structure_changes.hpp"

#include "interpolation.hpp"

namespace coagula::diagnose {

namespace {

/// Where structures are made again; between these values what is measured of them is interpolated.
constexpr NodeAxis size_axis{0.03, 0.4, 7};  // at 0.03 no shell of neighbours notices
/// Below 11 mV particles of 0.25 um in water have no barrier, and coagulation hardly knows the potential.
constexpr LinearAxis potential_axis{0.011, 0.015, 5};
constexpr NodeAxis ions_axis{1, 4, 6};               // its first is the structure as it is
constexpr LinearAxis fraction_axis{-0.15, 0.15, 5};  // its middle is the structure as it is
constexpr LinearAxis coordination_axis{4.3, 5.1, 5};
constexpr NodeAxis voids_axis{0.125, 1, 4};

/// What is asked of structures with these changes, between the nodes of each; several changes add up.
template <class Value>
Value asked_over_changes(Simulator& simulator, const StructureChange& change, const std::function<Value(Simulator&)>& asked) {
    const Value stated = asked(simulator);
    Value value = stated;
    const auto add = [&](const auto& axis, double StructureChange::*changed) {
        if (change.*changed == StructureChange{}.*changed) {
            return;
        }
        value -= stated - interpolate_nodes(axis, change.*changed, [&](int k) {
                     StructureChange node;
                     node.*changed = axis.node(k);
                     return asked(simulator.remade(node));
                 });
    };
    add(size_axis, &StructureChange::size_deviation);
    add(potential_axis, &StructureChange::surface_potential);
    add(ions_axis, &StructureChange::ionic_strength);
    add(fraction_axis, &StructureChange::volume_fraction);
    add(coordination_axis, &StructureChange::coordination);
    add(voids_axis, &StructureChange::voids);
    return value;
}

}  // namespace

double over_changes(Simulator& simulator, const StructureChange& change, const std::function<double(Simulator&)>& asked) {
    return asked_over_changes(simulator, change, asked);
}

Eigen::MatrixXd over_changes(Simulator& simulator, const StructureChange& change,
                             const std::function<Eigen::MatrixXd(Simulator&)>& asked) {
    return asked_over_changes(simulator, change, asked);
}

}  // namespace coagula::diagnose
