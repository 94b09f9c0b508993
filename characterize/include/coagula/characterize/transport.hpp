// SPDX-License-Identifier: GPL-3.0-or-later
// Transport through the pore space on a grid of voxels: formation factor, permeability, geodesic tortuosity.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct TransportOptions {
    double voxels_per_radius = 3;  ///< of the mean radius, on the finer grid, 1 to 100
    double most_voxels = 2e6;      ///< coarser voxels are taken where there would be more, 1e3 to 1e9
};

/// A value by axis and its mean, extrapolated to voxels of no size from the fine grid and one about 1.5 times as coarse: the change
/// between them times 1 / (1.5^p - 1) is added, where p is the order of the method. The error of the grid is half of what is added.
/// A value that comes out below what any pores can have is set to that bound; the error of the grid then is no less than the step.
struct DirectionalValue {
    Eigen::Vector3d by_axis = Eigen::Vector3d::Constant(unset);
    double mean = unset;
    double grid_error = unset;
    bool at_bound = false;       ///< the grid is too coarse to tell the value along some axis from its bound
    double axis_stderr = unset;  ///< standard error of the mean from the spread of the three axes
};

/// The pores conduct, the spheres do not. Periodic packings.
struct Transport {
    DirectionalValue formation_factor;  ///< F = conductivity of the liquid / effective conductivity, from Laplace's equation on
                                        ///< finite volumes whose faces count as far as they lie open (p = 2); at least
                                        ///< 1 / void fraction
    DirectionalValue tortuosity;  ///< geodesic: mean over the open part of a plane across the box of the shortest path from the
                                  ///< plane one period before, over the period; first-order fast marching (p = 1); at least 1
    double diffusive_tortuosity = unset;  ///< F times void fraction: the square of the path stretch that would explain F
    double diffusive_tortuosity_stderr = unset;
    double pore_length = unset;         ///< Johnson's Lambda = 2 / (d ln F / d r) for spheres that all grow by dr [m]
    double pore_length_stderr = unset;  ///< from the spread of the three axes
    double permeability = unset;        ///< estimate Lambda^2 / (8 F) (Johnson et al., Phys. Rev. Lett. 57 (1986) 2564) [m^2]
    double permeability_stderr = unset;
    double permeability_kozeny_carman = unset;  ///< estimate phi^3 / (5 s^2), s: surface over volume of the sample [m^2]
    double permeability_kozeny_carman_stderr = unset;
    double void_fraction = unset;                    ///< exact
    Eigen::Array3i voxels = Eigen::Array3i::Zero();  ///< of the fine grid
    double voxels_per_radius = unset;                ///< smallest over the axes
};

/// @throws std::invalid_argument if the packing is open, if the spheres leave no path, if a voxel would be larger than a radius, or
/// if the voxels are too coarse for a pore length.
Transport measure_transport(const Packing& packing, const TransportOptions& options = {}, const Progress& progress = {});

}  // namespace coagula::characterize
