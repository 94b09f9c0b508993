// Cell volumes against voro++, a different algorithm (cells cut plane by plane).
#include "power_diagram.hpp"
#include "unit/characterize/test_packings.hpp"

#include <gtest/gtest.h>
#include <voro++/voro++.hh>

namespace coagula::characterize {
namespace {

Eigen::VectorXd volumes_by_orthoschemes(const Packing& packing) {
    const PowerDiagram diagram = periodic_diagram(packing, packing.radii);
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(packing.size());
    for (const DiagramEdge& edge : diagram.edges) {
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        const double height = geometry.height[0] + geometry.height[1];
        for (const EdgeSide& side : geometry.sides) {
            for (const auto& [corner, a] : {std::pair{side.first, side.first_distance}, {side.second, side.second_distance}}) {
                const int site = edge.around[static_cast<std::size_t>(corner)];
                if (site < packing.size()) {
                    volumes[site] += a * side.foot_distance * height / 6;
                }
            }
        }
    }
    return volumes;
}

template <class Container>
Eigen::VectorXd volumes_by_voropp(const Packing& packing) {
    const Eigen::Vector3d lengths = packing.cell.lengths();
    Container container(0, lengths[0], 0, lengths[1], 0, lengths[2], 5, 5, 5, true, true, true, 8);
    for (int i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d centre = packing.positions.col(i);
        if constexpr (std::is_same_v<Container, voro::container_poly>) {
            container.put(i, centre[0], centre[1], centre[2], packing.radii[i]);
        } else {
            container.put(i, centre[0], centre[1], centre[2]);
        }
    }
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(packing.size());
    voro::c_loop_all loop(container);
    voro::voronoicell cell;
    if (loop.start()) {
        do {
            volumes[loop.pid()] = container.compute_cell(cell, loop) ? cell.volume() : 0.0;
        } while (loop.inc());
    }
    return volumes;
}

TEST(VoronoiVolumes, EqualSpheres) {
    const Packing packing = test::random_spheres(2000, {10, 12, 17}, 0.5, 0.5, 4);
    const Eigen::VectorXd expected = volumes_by_voropp<voro::container>(packing);
    EXPECT_LT((volumes_by_orthoschemes(packing) - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.mean());
}

TEST(VoronoiVolumes, PowerCellsOfUnequalSpheres) {
    const Packing packing = test::random_spheres(2000, {10, 12, 17}, 0.1, 0.9, 5);
    const Eigen::VectorXd expected = volumes_by_voropp<voro::container_poly>(packing);
    EXPECT_GT((expected.array() == 0).count(), 0) << "no particle is swallowed: the test misses that case";
    EXPECT_LT((volumes_by_orthoschemes(packing) - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.mean());
}

}  // namespace
}  // namespace coagula::characterize
