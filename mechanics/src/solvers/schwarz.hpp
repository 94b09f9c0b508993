// SPDX-License-Identifier: GPL-3.0-or-later
// Two-level additive Schwarz preconditioner for networks too large for one factor: overlapping boxes of particles, each with
// a Cholesky factor of its own, and a coarse continuous motion on a regular grid.
#pragma once

#include "stiffness.hpp"

#include <coagula/common/cholesky_factor.hpp>
#include <coagula/common/progress.hpp>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace coagula::mechanics {

struct SchwarzOptions {
    double particles_per_box = 300;  ///< before the overlap
    int overlap = 2;                 ///< layers of bonded neighbours added to each box
    double shift = 1e-8;             ///< on the diagonal of every local matrix, in contact stiffnesses
};

/// The part of a network that this process has, where several share it.
struct SharedPart {
    Index own = 0;  ///< the first so many particles are its own; the others are their neighbours, of other processes
    Index all = 0;  ///< particles of all processes
    std::function<void(double*, Index)> sum;  ///< adds up so many numbers over the processes
};

class SchwarzPreconditioner {
public:
    /// @param fraction 3 x n, positions of the load-bearing particles in the cell, each coordinate in [0, 1).
    /// @param lengths edge lengths of the cell, any unit.
    SchwarzPreconditioner(const BlockMatrix& upper, const BlockMatrix& full, const Eigen::Matrix3Xd& fraction,
                          const Eigen::Vector3d& lengths, const SchwarzOptions& options, const Progress& progress);
    /// Preconditioner of the part of a network that one process has. `fraction` holds its neighbours too, as far as the boxes
    /// overlap.
    SchwarzPreconditioner(const BlockMatrix& upper, const BlockMatrix& full, const Eigen::Matrix3Xd& fraction,
                          const Eigen::Vector3d& lengths, const SchwarzOptions& options, const Progress& progress, SharedPart part);
    ~SchwarzPreconditioner();
    SchwarzPreconditioner(const SchwarzPreconditioner&) = delete;
    SchwarzPreconditioner& operator=(const SchwarzPreconditioner&) = delete;

    /// z = M^-1 r; the same bits for any number of threads. In a part: what this process adds to the z of its particles and their
    /// neighbours.
    void solve(const Loads& r, Loads& z) const;

private:
    struct Box;
    struct Coarse;

    void list_copies(Index particles);
    void factorise_boxes(const BlockMatrix& upper, const SchwarzOptions& options, const Progress& progress);

    SharedPart part_;
    std::vector<std::unique_ptr<Box>> boxes_;
    std::vector<Index> copy_start_;           ///< per particle: range in `copy_`
    std::vector<std::array<Index, 2>> copy_;  ///< (box, place in the box) of every copy of a particle
    std::unique_ptr<Coarse> coarse_;
};

}  // namespace coagula::mechanics
