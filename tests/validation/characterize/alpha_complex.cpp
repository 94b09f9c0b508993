// SPDX-License-Identifier: GPL-3.0-or-later
// Euler characteristic of a union of balls against the simplices of CGAL's alpha shape.
#include "unit/characterize/test_packings.hpp"

#include <coagula/characterize/minkowski.hpp>

#include <CGAL/Alpha_shape_3.h>
#include <CGAL/Alpha_shape_cell_base_3.h>
#include <CGAL/Alpha_shape_vertex_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>

#include <gtest/gtest.h>

#include <iterator>
#include <set>

namespace coagula::characterize {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Alpha_shape_vertex_base_3<Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using TetrahedronBase = CGAL::Alpha_shape_cell_base_3<Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Regular = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, TetrahedronBase>>;
using Shape = CGAL::Alpha_shape_3<Regular>;

/// Vertices - edges + facets - cells that belong to the shape of balls with these radii.
int count_simplices(const Packing& packing, double growth) {
    std::vector<Regular::Weighted_point> balls;
    for (Index i = 0; i < packing.size(); ++i) {
        const double radius = packing.radii[i] + growth;
        balls.emplace_back(Kernel::Point_3(packing.positions(0, i), packing.positions(1, i), packing.positions(2, i)),
                           radius * radius);
    }
    const Shape shape(balls.begin(), balls.end(), 0, Shape::GENERAL);
    int sum = 0;
    for (const auto kind : {Shape::SINGULAR, Shape::REGULAR, Shape::INTERIOR}) {
        std::vector<Shape::Vertex_handle> vertices;
        std::vector<Shape::Edge> edges;
        std::vector<Shape::Facet> facets;
        std::vector<Shape::Cell_handle> cells;
        shape.get_alpha_shape_vertices(std::back_inserter(vertices), kind);
        shape.get_alpha_shape_edges(std::back_inserter(edges), kind);
        shape.get_alpha_shape_facets(std::back_inserter(facets), kind);
        if (kind == Shape::INTERIOR) {
            shape.get_alpha_shape_cells(std::back_inserter(cells), kind);
        }
        sum += static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(facets.size()) -
               static_cast<int>(cells.size());
    }
    return sum;
}

TEST(AlphaComplex, HasTheEulerCharacteristicOfTheUnion) {
    // A cluster in a box so large that no image of it is near.
    for (const double spread : {0.0, 0.5}) {
        Packing packing = test::random_spheres(120, {6, 6, 6}, 0.7 - spread / 2, 0.7 + spread / 2, 4);
        packing.cell = Cell::periodic({15, 15, 15});
        const Minkowski found = measure_minkowski(packing, {.dilations = 60});
        std::set<long> values;
        for (Index k = 0; k < 60 && found.dilation[k] < 2; ++k) {
            const double euler = found.euler_characteristic[k] * packing.cell.volume();
            EXPECT_NEAR(euler, count_simplices(packing, found.dilation[k]), 1e-6) << spread << ' ' << found.dilation[k];
            values.insert(std::lround(euler));
        }
        EXPECT_GT(values.size(), 2U);
    }
}

}  // namespace
}  // namespace coagula::characterize
