// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: transport through the pores.
#include <coagula/characterize/transport.hpp>

#include "optional_results.hpp"

namespace coagula::characterize {

Measure transport_measure();

namespace {

void add_value(const DirectionalValue& value, const std::string& name, const std::string& meaning, MeasureResult& result) {
    result.add("transport/" + name + "/mean", value.mean, "1", meaning + ", mean of the three axes", value.axis_stderr);
    result.add_vector("transport/" + name + "/by_axis", value.by_axis, "1", meaning + ", along x, y, z");
    result.add("transport/" + name + "/grid_error", value.grid_error, "1", "error of the mean by the finite size of the voxels");
}

std::string with_grid_error(const DirectionalValue& value, const std::string& bound) {
    return with_error(value.mean, value.grid_error) +
           (value.at_bound ? "   (the grid is too coarse to tell it from " + bound + ": give more --voxels-per-radius)" : "");
}

MeasureResult run_transport(const MeasureInput& input) {
    const Transport found = if_applicable([&] {
        return measure_transport(
            input.packing(), {.voxels_per_radius = input.number("voxels-per-radius"), .most_voxels = input.number("most-voxels")},
            input.progress());
    });
    MeasureResult result;
    add_value(found.formation_factor, "formation_factor", "conductivity of the liquid over that of the packing", result);
    add_value(found.tortuosity, "tortuosity", "geodesic tortuosity: shortest path through the pores over its period", result);
    result.add("transport/diffusive_tortuosity", found.diffusive_tortuosity, "1", "formation factor times void fraction",
               found.diffusive_tortuosity_stderr);
    result.add("transport/pore_length", found.pore_length, "m", "Johnson's Lambda = 2 / (d ln F / d r)", found.pore_length_stderr);
    result.add("transport/permeability", found.permeability, "m2", "estimate Lambda^2 / (8 F)", found.permeability_stderr);
    result.add("transport/permeability_kozeny_carman", found.permeability_kozeny_carman, "m2", "estimate phi^3 / (5 s^2)",
               found.permeability_kozeny_carman_stderr);
    result.add("transport/voxels_per_radius", found.voxels_per_radius, "1",
               "mean radius over the edge of a voxel of the finer grid");
    result.add_line("formation factor", with_grid_error(found.formation_factor, "1 over the void fraction"));
    result.add_line("geodesic tortuosity", with_grid_error(found.tortuosity, "1"));
    result.add_line("permeability", with_unit(found.permeability, "m2") + " estimated from the formation factor, " +
                                        with_unit(found.permeability_kozeny_carman, "m2") + " by Kozeny and Carman");
    return result;
}

}  // namespace

Measure transport_measure() {
    return {.name = "transport",
            .summary = "formation factor, geodesic tortuosity and permeability of the pores, on a grid of voxels",
            .run = run_transport,
            .options = {{"voxels-per-radius", "1", "voxels per mean radius of the grid for transport", 3, 1, 100},
                        {"most-voxels", "1", "largest number of voxels for transport; larger packings get coarser voxels", 2e6, 1e3,
                         1e9}},
            .by_default = false};
}

}  // namespace coagula::characterize
