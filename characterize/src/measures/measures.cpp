// SPDX-License-Identifier: GPL-3.0-or-later
// The table of measures. A measure is one file in measures/ and one line in each of the two lists here.
#include <coagula/characterize/measure.hpp>

namespace coagula::characterize {

Measure coordination_measure();
Measure doh_measure();
Measure pores_measure();
Measure voronoi_measure();
Measure density_fluctuations_measure();
Measure gelb_gubbins_measure();
Measure delaunay_pores_measure();
Measure free_spheres_measure();
Measure overlap_measure();
Measure fabric_measure();
Measure rigidity_central_measure();
Measure betweenness_measure();
Measure coordination_percolation_measure();
Measure dense_clusters_measure();
Measure rigidity_measure();
Measure rings_measure();
Measure sampled_check_measure();
Measure topology_measure();
Measure pair_correlation_measure();
Measure structure_factor_measure();
Measure bond_angles_measure();
Measure common_neighbours_measure();
Measure neighbour_distances_measure();
Measure bond_order_measure();
Measure minkowski_measure();
Measure chord_lengths_measure();
Measure transport_measure();

const std::vector<Measure>& measures() {
    static const std::vector<Measure> table = {
        coordination_measure(),
        doh_measure(),
        pores_measure(),
        voronoi_measure(),
        density_fluctuations_measure(),
        gelb_gubbins_measure(),
        delaunay_pores_measure(),
        free_spheres_measure(),
        overlap_measure(),
        topology_measure(),
        coordination_percolation_measure(),
        dense_clusters_measure(),
        rings_measure(),
        betweenness_measure(),
        fabric_measure(),
        rigidity_measure(),
        rigidity_central_measure(),
        pair_correlation_measure(),
        structure_factor_measure(),
        bond_angles_measure(),
        common_neighbours_measure(),
        neighbour_distances_measure(),
        bond_order_measure(),
        minkowski_measure(),
        chord_lengths_measure(),
        transport_measure(),
        sampled_check_measure(),
    };
    return table;
}

}  // namespace coagula::characterize
