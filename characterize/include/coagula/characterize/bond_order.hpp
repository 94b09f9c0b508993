// SPDX-License-Identifier: GPL-3.0-or-later
// Bond-orientational order of the cells: Steinhardt's q4 and q6 with the Voronoi facets as weights.
#pragma once

#include <coagula/characterize/voronoi_cells.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::characterize {

/// q_l = sqrt(4 pi / (2 l + 1) sum_m |sum_f A_f / A Y_lm(n_f)|^2) over the facets f of a particle's Voronoi (power) cell, with area
/// A_f and normal n_f: the Minkowski structure metrics of Mickel et al., J. Chem. Phys. 138 (2013) 044501, which change
/// continuously with the positions and need no choice of neighbours. fcc: q4 = 0.1909, q6 = 0.5745.
struct BondOrder {
    Eigen::VectorXd q4, q6;                          ///< N; NaN for particles of an open packing that are not inner ones
    double q4_mean = unset, q4_mean_stderr = unset;  ///< over the inner particles; from blocks of space (blocks.hpp)
    double q6_mean = unset, q6_mean_stderr = unset;
    double q4_spread = unset, q6_spread = unset;  ///< standard deviations
    double facets = unset;                        ///< mean number of facets with more than a millionth of the cell's surface
    double facets_stderr = unset;
};

/// Throws std::invalid_argument for an open packing without inner particles.
BondOrder measure_bond_order(const Packing& packing);

/// Bond order from faces that are known already (voronoi_cells.hpp). @param inner N flags (inner_particles.hpp).
BondOrder measure_bond_order(const Packing& packing, const VoronoiFaces& faces, const std::vector<bool>& inner);

}  // namespace coagula::characterize
