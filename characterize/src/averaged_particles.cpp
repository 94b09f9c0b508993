#include "averaged_particles.hpp"

namespace coagula::characterize {

std::vector<int> block_of_particles(const Packing& packing) {
    const bool periodic = packing.cell.is_periodic();
    const Eigen::Vector3d smallest = packing.positions.rowwise().minCoeff();
    const Eigen::Array3d lower = periodic ? packing.cell.origin() : smallest;
    const Eigen::Array3d extent = periodic ? packing.cell.lengths() : packing.positions.rowwise().maxCoeff() - smallest;
    std::vector<int> blocks;
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Array3d place = (packing.cell.wrap(packing.positions.col(i)).array() - lower) / extent.max(1e-300);
        const Eigen::Array3i box = (place * blocks_per_axis).cast<int>().max(0).min(blocks_per_axis - 1);
        blocks.push_back((box[2] * blocks_per_axis + box[1]) * blocks_per_axis + box[0]);
    }
    return blocks;
}

AveragedParticles::AveragedParticles(const Packing& packing) {
    const std::vector<bool> inner = inner_particles(packing);
    const bool all = std::find(inner.begin(), inner.end(), true) == inner.end();
    const std::vector<int> blocks = block_of_particles(packing);
    for (Index i = 0; i < packing.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (all || inner[k]) {
            particles.push_back(i);
            block.push_back(blocks[k]);
        }
    }
}

}  // namespace coagula::characterize
