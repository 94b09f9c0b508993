// SPDX-License-Identifier: GPL-3.0-or-later
// Conduction through faces of voxels: conjugate gradients with a multigrid preconditioner. Internal.
#pragma once

#include "voxel_pores.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::characterize {

/// Conductances between the voxels of a periodic grid and the next along each axis. In single precision: the open fractions that
/// they follow from are far less certain, and memory is what the solver waits for.
struct FaceConductances {
    Eigen::Array3i count;
    std::array<Eigen::ArrayXf, 3> of_face;
};

/// Conductances of voxels with open faces, for a liquid of unit conductivity.
FaceConductances face_conductances(const VoxelGrid& grid, const OpenFaces& faces);

class ConductionSolver {
public:
    explicit ConductionSolver(FaceConductances conductances);

    /// The periodic part u of the potential x + u under a unit gradient along one axis.
    /// @param spacing of the voxels along that axis. @param tolerance of the potential in the norm of the power, relative: that of
    /// the power itself is its square.
    Eigen::ArrayXf solve(int axis, double spacing, double tolerance) const;

    /// Power sum g (drop)^2 under that potential.
    static double power(const FaceConductances& conductances, const Eigen::ArrayXf& potential, int axis, double spacing);

private:
    /// One grid of the hierarchy; the next has voxels twice as large.
    struct Level {
        FaceConductances conductances;
        Eigen::ArrayXf inverse_diagonal;  ///< 0 for voxels without an open face
    };

    Eigen::ArrayXf precondition(std::size_t level, const Eigen::ArrayXf& residual) const;

    std::vector<Level> levels_;
};

}  // namespace coagula::characterize
