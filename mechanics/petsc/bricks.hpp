// SPDX-License-Identifier: GPL-3.0-or-later
// Which process owns which part of the cell.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <array>

namespace coagula::mechanics {

/// Equal bricks of the cell, one for each process, cut so that their faces are small.
class Bricks {
public:
    /// @param lengths edge lengths of the cell, any unit.
    Bricks(const Eigen::Vector3d& lengths, int processes);

    /// The process that owns a place in the cell. @param fraction its coordinates, in [0, 1).
    int owner(const Eigen::Vector3d& fraction) const;
    const std::array<int, 3>& count() const { return count_; }

private:
    std::array<int, 3> count_{};
};

}  // namespace coagula::mechanics
