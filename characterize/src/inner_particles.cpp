#include <coagula/characterize/inner_particles.hpp>

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

}  // namespace coagula::characterize
