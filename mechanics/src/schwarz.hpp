// SPDX-License-Identifier: GPL-3.0-or-later
// Two-level additive Schwarz preconditioner for networks too large for one factor: overlapping boxes of particles, each with
// a Cholesky factor of its own, and a coarse continuous motion on a regular grid.
#pragma once

#include "stiffness.hpp"

#include <coagula/common/cholesky_factor.hpp>
#include <coagula/common/progress.hpp>

#include <array>
#include <memory>
#include <vector>

namespace coagula::mechanics {

struct SchwarzOptions {
    double particles_per_box = 300;  ///< before the overlap
    int overlap = 2;                 ///< layers of bonded neighbours added to each box
    double shift = 1e-8;             ///< on the diagonal of every local matrix, in contact stiffnesses
};

class SchwarzPreconditioner {
public:
    /// @param fraction 3 x n, positions of the load-bearing particles in the cell, each coordinate in [0, 1).
    /// @param lengths edge lengths of the cell, any unit.
    SchwarzPreconditioner(const BlockMatrix& upper, const BlockMatrix& full, const Eigen::Matrix3Xd& fraction,
                          const Eigen::Vector3d& lengths, const SchwarzOptions& options, const Progress& progress);
    ~SchwarzPreconditioner();
    SchwarzPreconditioner(const SchwarzPreconditioner&) = delete;
    SchwarzPreconditioner& operator=(const SchwarzPreconditioner&) = delete;

    /// z = M^-1 r; the same bits for any number of threads.
    void solve(const Loads& r, Loads& z) const;

private:
    struct Box;
    struct Coarse;

    void list_copies(Index particles);
    void factorise_boxes(const BlockMatrix& upper, const SchwarzOptions& options, const Progress& progress);

    std::vector<std::unique_ptr<Box>> boxes_;
    std::vector<Index> copy_start_;           ///< per particle: range in `copy_`
    std::vector<std::array<Index, 2>> copy_;  ///< (box, place in the box) of every copy of a particle
    std::unique_ptr<Coarse> coarse_;
};

}  // namespace coagula::mechanics
