// SPDX-License-Identifier: GPL-3.0-or-later
// The triangulation behind a power diagram, from CGAL. Internal.
#pragma once

#include "power_diagram.hpp"

#include <memory>

namespace coagula::characterize {

/// Delaunay triangulation of the sites, or the regular one of unequal spheres. Sites can be added, which costs less than to begin
/// again.
class Triangulation {
public:
    explicit Triangulation(bool equal_radii);
    ~Triangulation();
    Triangulation(const Triangulation&) = delete;
    Triangulation& operator=(const Triangulation&) = delete;

    /// Adds those sites of the diagram that are not in yet.
    void insert(const PowerDiagram& diagram);
    /// The vertices of the counted cells and the hull.
    void find_vertices(PowerDiagram& diagram);
    /// The bounded edges of the counted cells, after find_vertices.
    void find_edges(PowerDiagram& diagram) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace coagula::characterize
