#include "free_surface.hpp"

#include <coagula/characterize/inner_particles.hpp>
#include <coagula/characterize/pore_sizes.hpp>

namespace coagula::tools {

void hold_surface(const Packing& packing, mechanics::LinearOptions& options) {
    options.held = characterize::inner_particles(packing);
    options.held.flip();
    options.volume = characterize::measure_pores(packing, {.radii = 4}).volume;
}

}  // namespace coagula::tools
