// SPDX-License-Identifier: GPL-3.0-or-later
// The part of space that a packing samples: all of a periodic cell, or the convex hull of the centres of an open packing. Internal.
#pragma once

#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::characterize {

struct HalfSpace {
    Eigen::Vector3d normal;  ///< unit vector outward
    double offset = 0;       ///< of the plane along it
};

struct SampleWindow {
    Eigen::VectorXd depth;  ///< N: distance of each centre from the surface of the window [m]; infinite if periodic
    double density = 0;     ///< centres per volume [1/m^3]; of an open packing those that are no corner of the hull over the volume
                            ///< of the hull, which is unbiased (Baldin and Reiss, Stoch. Process. Appl. 126 (2016) 3716)
    double pair_density = 0;  ///< other centres per volume that an ideal gas would have around a particle: (N - 1) / V if periodic
    double volume = 0;        ///< of the window [m^3]
    Eigen::Vector3d centre;   ///< of the largest known ball in the window; of the box, if periodic
    double ball_radius = 0;   ///< of that ball [m]; infinite if periodic
    std::vector<HalfSpace> planes = {};  ///< of which the window is the intersection; none if periodic

    /// Distance of a point from the surface of the window [m]; negative outside, infinite if periodic.
    double depth_at(const Eigen::Vector3d& point) const;
};

/// Throws std::invalid_argument if an open packing has fewer than five particles or lies in a plane.
SampleWindow sample_window(const Packing& packing);

}  // namespace coagula::characterize
