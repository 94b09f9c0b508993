// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/inner_particles.hpp>

#include "geometry/voronoi_of_diagram.hpp"

namespace coagula::characterize {

std::vector<bool> inner_particles(const Packing& packing) {
    check(packing);
    const auto particles = static_cast<std::size_t>(packing.size());
    std::vector<char> inner(particles, 1);
    if (!packing.cell.is_periodic()) {
        inner = inner_sites(packing, power_diagram(packing, packing.radii));
        inner.resize(particles);
    }
    return {inner.begin(), inner.end()};
}

FreeSurface free_surface(const Packing& packing) {
    check(packing);
    const ReducedDiagram reduced = reduced_diagram(packing);
    require_inner(reduced);
    FreeSurface surface{reduced.inner(), measure_voronoi_cells(reduced).volumes.sum()};
    surface.outer.flip();
    return surface;
}

}  // namespace coagula::characterize
