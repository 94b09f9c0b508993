#include <coagula/characterize/inner_particles.hpp>
#include <coagula/characterize/pore_sizes.hpp>

#include "power_diagram.hpp"

namespace coagula::characterize {

std::vector<bool> inner_particles(const Packing& packing) {
    check(packing);
    const auto particles = static_cast<std::size_t>(packing.size());
    std::vector<char> inner(particles, 1);
    if (!packing.cell.is_periodic()) {
        inner = inner_sites(open_diagram(packing, packing.radii, inner));
    }
    return {inner.begin(), inner.end()};
}

FreeSurface free_surface(const Packing& packing) {
    FreeSurface surface{inner_particles(packing), measure_pores(packing, {.radii = 4}).volume};
    surface.outer.flip();
    return surface;
}

}  // namespace coagula::characterize
