// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes and surfaces of all cells against voro++, a different algorithm (cells cut plane by plane).
#include "unit/characterize/test_packings.hpp"

#include <coagula/characterize/voronoi_cells.hpp>

#include <gtest/gtest.h>
#include <voro++/voro++.hh>

namespace coagula::characterize {
namespace {

/// Volumes and surfaces of the cells, N each.
struct Cells {
    Eigen::VectorXd volumes, surfaces;
};

template <class Container>
Cells cells_by_voropp(const Packing& packing) {
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
    Cells cells{Eigen::VectorXd::Zero(packing.size()), Eigen::VectorXd::Zero(packing.size())};
    voro::c_loop_all loop(container);
    voro::voronoicell cell;
    if (loop.start()) {
        do {
            if (container.compute_cell(cell, loop)) {
                cells.volumes[loop.pid()] = cell.volume();
                cells.surfaces[loop.pid()] = cell.surface_area();
            }
        } while (loop.inc());
    }
    return cells;
}

Eigen::VectorXd surfaces_of(const Packing& packing) {
    const VoronoiFaces faces = measure_voronoi_faces(packing);
    Eigen::VectorXd surfaces = Eigen::VectorXd::Zero(packing.size());
    for (Index face = 0; face < faces.areas.size(); ++face) {
        surfaces[faces.neighbours.ends(0, face)] += faces.areas[face];
        surfaces[faces.neighbours.ends(1, face)] += faces.areas[face];
    }
    return surfaces;
}

/// Each to 1e-9 of itself. Slivers smaller than a millionth of the mean are compared with the mean.
void expect_equal(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
    const Eigen::ArrayXd scale = expected.array().max(1e-6 * expected.mean());
    EXPECT_LT(((found - expected).array() / scale).abs().maxCoeff(), 1e-9);
}

template <class Container>
void expect_cells_of_voropp(const Packing& packing) {
    const Cells expected = cells_by_voropp<Container>(packing);
    expect_equal(measure_voronoi_cells(packing).volumes, expected.volumes);
    expect_equal(surfaces_of(packing), expected.surfaces);
}

/// voro++ has restricted triclinic boxes: the first edge along x, the second in the plane of x and y.
template <class Container>
Cells cells_of_tilted_box(const Packing& packing) {
    const Eigen::Matrix3d& edges = packing.cell.edges();
    Container container(edges(0, 0), edges(0, 1), edges(1, 1), edges(0, 2), edges(1, 2), edges(2, 2), 5, 5, 5, 8);
    for (int i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d centre = packing.positions.col(i);
        if constexpr (std::is_same_v<Container, voro::container_periodic_poly>) {
            container.put(i, centre[0], centre[1], centre[2], packing.radii[i]);
        } else {
            container.put(i, centre[0], centre[1], centre[2]);
        }
    }
    Cells cells{Eigen::VectorXd::Zero(packing.size()), Eigen::VectorXd::Zero(packing.size())};
    voro::c_loop_all_periodic loop(container);
    voro::voronoicell cell;
    if (loop.start()) {
        do {
            if (container.compute_cell(cell, loop)) {
                cells.volumes[loop.pid()] = cell.volume();
                cells.surfaces[loop.pid()] = cell.surface_area();
            }
        } while (loop.inc());
    }
    return cells;
}

template <class Container>
void expect_cells_in_tilted_boxes(double smallest, double largest) {
    for (const double tilt : {0.3, 0.5, 0.9}) {
        Packing packing = test::random_spheres(1000, {1, 1, 1}, smallest, largest, 4);
        const Eigen::Matrix3d edges = (Eigen::Matrix3d() << 10, 10 * tilt, -8 * tilt, 0, 12, 9 * tilt, 0, 0, 8).finished();
        packing.cell = Cell::of_edges(Eigen::Vector3d::Zero(), edges, {true, true, true});
        packing.positions = edges * packing.positions;
        const Cells expected = cells_of_tilted_box<Container>(packing);
        expect_equal(measure_voronoi_cells(packing).volumes, expected.volumes);
        expect_equal(surfaces_of(packing), expected.surfaces);
    }
}

TEST(VoronoiCells, InTiltedBoxes) {
    expect_cells_in_tilted_boxes<voro::container_periodic>(0.5, 0.5);
}

TEST(VoronoiCells, OfUnequalSpheresInTiltedBoxes) {
    expect_cells_in_tilted_boxes<voro::container_periodic_poly>(0.1, 0.9);
}

TEST(VoronoiCells, OfRandomPoints) {
    expect_cells_of_voropp<voro::container>(test::random_spheres(2000, {10, 12, 17}, 0.5, 0.5, 4));
}

TEST(VoronoiCells, OfUnequalSpheres) {
    const Packing packing = test::random_spheres(2000, {10, 12, 17}, 0.1, 0.9, 5);
    const VoronoiCells cells = measure_voronoi_cells(packing);
    EXPECT_GT((cells.volumes.array() == 0).count(), 0) << "no particle is swallowed: the test misses that case";
    expect_cells_of_voropp<voro::container_poly>(packing);
}

TEST(VoronoiCells, OfCrystals) {
    expect_cells_of_voropp<voro::container>(test::simple_cubic({5, 4, 6}, 0.5));
    expect_cells_of_voropp<voro::container>(test::face_centred({4, 3, 5}, 0.5));
    expect_cells_of_voropp<voro::container>(test::body_centred({4, 5, 3}, 0.5));
}

TEST(VoronoiCells, OfGels) {
    for (const char* name : {"vem_1-8", "brownian_15mV"}) {
        Packing packing = test::reference_structure(name);
        packing.cell = Cell::periodic(1e6 * packing.cell.lengths());  // voro++ takes lengths near 1
        packing.positions *= 1e6;
        packing.radii *= 1e6;
        expect_cells_of_voropp<voro::container>(packing);
    }
}

}  // namespace
}  // namespace coagula::characterize
