#include "layout.hpp"

namespace coagula::io::layout {

Eigen::Matrix3Xd stored_positions(const Packing& packing) {
    const Cell& cell = packing.cell;
    if (!cell.is_periodic()) {
        return packing.positions * nanometres;
    }
    const Eigen::Vector3d lower = cell.origin() * nanometres;
    const Eigen::Vector3d upper = (cell.origin() + cell.lengths()) * nanometres;
    Eigen::Matrix3Xd stored(3, packing.size());
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d position = cell.wrap(packing.positions.col(particle)) * nanometres;
        stored.col(particle) = (position.array() < upper.array()).select(position, lower);
    }
    return stored;
}

}  // namespace coagula::io::layout
