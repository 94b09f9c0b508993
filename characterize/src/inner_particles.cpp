#include <coagula/characterize/inner_particles.hpp>

#include "power_diagram.hpp"

namespace coagula::characterize {

std::vector<bool> inner_particles(const Packing& packing) {
    check(packing);
    const auto particles = static_cast<std::size_t>(packing.size());
    if (packing.cell.is_periodic()) {
        return std::vector<bool>(particles, true);
    }
    const std::vector<char> inner = inner_sites(open_diagram(packing, packing.radii, std::vector<char>(particles, 1)));
    return {inner.begin(), inner.end()};
}

}  // namespace coagula::characterize
