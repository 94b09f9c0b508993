// SPDX-License-Identifier: GPL-3.0-or-later
// Minkowski functionals of the union of the spheres, as all spheres grow: volume, surface, mean curvature, Euler characteristic.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct MinkowskiOptions {
    Index dilations = 0;  ///< equally spaced from 0 to the largest pore, >= 2; 0: 60 for equal spheres, 20 for others
};

/// Densities: functional over the volume measured. Exact: surfaces and circles of the spheres inside their Voronoi (power) cells;
/// the Euler characteristic is the alternating number of simplices of the alpha complex (Edelsbrunner, Discrete Comput. Geom. 13
/// (1995) 415). Each simplex is shared out equally to its particles, so that in an open packing the cells of the inner particles
/// are measured. Equal spheres need one diagram; others one for each dilation, because the power cells move.
struct Minkowski {
    Eigen::VectorXd dilation;         ///< added to all radii [m]
    Eigen::VectorXd volume_fraction;  ///< of the union
    Eigen::VectorXd surface;          ///< area of the union's surface over volume [1/m]
    Eigen::VectorXd mean_curvature;   ///< integral of (k1 + k2) / 2 over the surface, over volume [1/m^2]; a sphere has 4 pi r. The
                                      ///< circles where spheres meet count with minus half the angle between the normals
    Eigen::VectorXd euler_characteristic;  ///< of the union over volume [1/m^3]: parts - tunnels + cavities
    Index inner_particles = 0;             ///< whose cells were measured (all, if periodic)
    double volume = unset;                 ///< measured, at dilation 0 [m^3]
    double percolation_dilation = unset;   ///< where the Euler characteristic first passes zero, by linear interpolation [m]: near
                                           ///< it spheres that grow begin to span the sample (Mecke and Wagner, J. Stat. Phys. 64
                                           ///< (1991) 843). 0 if it is not positive at first
    double percolation_dilation_stderr = unset;
    double surface_stderr = unset;  ///< of the undilated functionals: from blocks of space (blocks.hpp)
    double mean_curvature_stderr = unset;
    double euler_characteristic_stderr = unset;
    double volume_fraction_stderr = unset;
};

/// Throws std::invalid_argument if the spheres cover all space or, for open packings, if there are no inner particles.
Minkowski measure_minkowski(const Packing& packing, const MinkowskiOptions& options = {}, const Progress& progress = {});

}  // namespace coagula::characterize
